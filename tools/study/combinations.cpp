// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tools/study/names.h"
#include "tools/study/plan.h"

namespace stroma::study {
namespace {

bool isSkipped(const Question& question, const Variation& variation) {
  const auto nameOn = [&](const std::string& axis) {
    for (const auto& [name, point] : variation.points) {
      if (name == axis) return point;
    }
    return variation.method;
  };
  return std::ranges::any_of(question.skips, [&](const Skip& skip) {
    return std::ranges::all_of(
        skip.where, [&](const auto& where) { return fitsAny(nameOn(where.first), where.second); });
  });
}

}  // namespace

std::vector<Variation> combinations(const Question& question, std::size_t number) {
  std::vector<Variation> all;
  for (const Choice& method : question.methods) {
    std::vector<Variation> partial{{.question = number, .method = method.name}};
    for (const Axis& axis : question.axes) {
      std::vector<Variation> longer;
      for (const Variation& before : partial) {
        for (const Choice& point : axis.points) {
          Variation& next = longer.emplace_back(before);
          next.points.emplace_back(axis.name, point.name);
          if (point.h) next.h = point.h;
        }
      }
      partial = std::move(longer);
    }
    std::ranges::copy_if(partial, std::back_inserter(all),
                         [&](const Variation& v) { return !isSkipped(question, v); });
  }
  return all;
}

bool isOf(const Measure& measure, std::string_view method) {
  return measure.methods.empty() || fitsAny(method, measure.methods);
}

std::string labelOf(const Variation& variation) {
  if (variation.isReference) return "reference " + stroma::quoted(variation.method);
  std::string label = variation.method;
  for (const auto& [axis, point] : variation.points) label += ", " + axis + " " + point;
  return label;
}

}  // namespace stroma::study
