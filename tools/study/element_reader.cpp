// SPDX-License-Identifier: Apache-2.0
#include "tools/study/element_reader.h"

#include "core/number_list.h"

namespace stroma::study {

ElementReader::~ElementReader() {
  for (const SceneAttribute& a : element_.attributes) {
    if (std::ranges::find(known_, a.name) != known_.end()) continue;
    error(a.nameAt, "attr-unknown", "unknown attribute " + stroma::quoted(a.name),
          didYouMean(a.name, known_));
  }
}

void ElementReader::error(const SourceRange& at, std::string id, std::string message,
                          std::string hint) {
  diagnostics_.error(std::move(id), element_.tag + ": " + message, at, std::move(hint));
}

const SceneAttribute* ElementReader::find(std::string_view name) {
  known_.emplace_back(name);
  return element_.find(name);
}

std::string ElementReader::text(std::string_view name) {
  const SceneAttribute* a = find(name);
  return a ? std::string(trimmed(a->value)) : "";
}

std::string ElementReader::required(std::string_view name) {
  const SceneAttribute* a = find(name);
  if (a && !trimmed(a->value).empty()) return std::string(trimmed(a->value));
  error(a ? a->valueAt : element_.at, "attr-required", "'" + std::string(name) + "' is required");
  return "";
}

SourceRange ElementReader::placeOf(std::string_view name) {
  const SceneAttribute* a = find(name);
  return a ? a->valueAt : element_.at;
}

std::vector<std::string> ElementReader::names(std::string_view name) {
  std::vector<std::string> list;
  const std::string all = text(name);
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = std::min(all.find(';', begin), all.size());
    const std::string_view one = trimmed(std::string_view(all).substr(begin, end - begin));
    if (!one.empty()) list.emplace_back(one);
    begin = end + 1;
  }
  return list;
}

bool ElementReader::accept(const SceneAttribute& a, const std::optional<ParseError>& problem) {
  if (!problem) return true;
  SourceRange at = a.valueAt;
  if (problem->offset <= at.length) {
    at.offset += problem->offset;
    at.length = std::max<std::size_t>(1, std::min(problem->length, at.length - problem->offset));
  }
  error(at, problem->id, "'" + a.name + "': " + problem->message, problem->hint);
  return false;
}

bool ElementReader::quantity(std::string_view name, Quantity& out) {
  const SceneAttribute* a = find(name);
  return a && accept(*a, parseQuantity(a->value, out));
}

bool ElementReader::fraction(std::string_view name, double& out) {
  Quantity read;
  if (!quantity(name, read)) return false;
  if (read.dimension == Dimension{} && read.value > 0) {
    out = read.value;
    return true;
  }
  error(placeOf(name), "value-range",
        "'" + std::string(name) + "' is a share greater than 0, such as \"5 %\" or \"0.05\"");
  return false;
}

bool ElementReader::time(std::string_view name, double& out, bool bareIsMs) {
  double read = 0;
  if (!value(name, {"s", UnitSystem{1, 1, bareIsMs ? 1e-3 : 1}}, read)) return false;
  if (read > 0 && read < 1e300) {
    out = read;
    return true;
  }
  error(placeOf(name), "value-range", "'" + std::string(name) + "' is a time greater than 0");
  return false;
}

std::size_t ElementReader::choice(std::string_view name, std::span<const std::string_view> words) {
  std::size_t chosen = 0;
  if (const SceneAttribute* a = find(name)) (void)accept(*a, parseChoice(a->value, words, chosen));
  return chosen;
}

}  // namespace stroma::study
