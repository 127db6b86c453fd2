// SPDX-License-Identifier: Apache-2.0
#include "core/attribute.h"

#include "core/attribute_owner.h"

namespace stroma {

AttributeBase::AttributeBase(AttributeOwner* owner, std::string_view name, std::string_view doc,
                             const AttributeInfo& info)
    : owner_(owner), name_(name), doc_(doc), info_(info) {
  owner->attributes_.push_back(this);
}

bool answersTo(std::string_view wanted, std::string_view name, std::string_view aliases) {
  if (wanted == name) return true;
  while (!aliases.empty()) {
    const std::size_t end = aliases.find(' ');
    if (aliases.substr(0, end) == wanted) return true;
    if (end == std::string_view::npos) break;
    aliases.remove_prefix(end + 1);
  }
  return false;
}

bool AttributeBase::answersTo(std::string_view wanted) const {
  return stroma::answersTo(wanted, name_, info_.aliases);
}

std::optional<ParseError> AttributeBase::parse(std::string_view text, const UnitSystem& units) {
  return parseValue(text, {info_.unit, units});
}

std::optional<ParseError> AttributeBase::pull() {
  if (!source_) return std::nullopt;
  if (!copyFrom(*source_)) return parseValue(source_->print(), {info_.unit, UnitSystem{}});
  if (auto problem = rangeProblem()) return ParseError{0, 0, "value-range", *problem, ""};
  return std::nullopt;
}

std::optional<std::string> detail::outside(std::span<const double> numbers,
                                           const AttributeInfo& info) {
  for (const double number : numbers) {
    const bool low = info.exclusiveMin ? number <= info.min : number < info.min;
    const bool high = info.exclusiveMax ? number >= info.max : number > info.max;
    if (!low && !high) continue;
    const std::string unit = info.unit.empty() ? "" : " " + std::string(info.unit);
    const double bound = low ? info.min : info.max;
    const std::string relation = low ? (info.exclusiveMin ? "greater than " : "at least ")
                                     : (info.exclusiveMax ? "less than " : "at most ");
    return ValueTraits<double>::print(number) + unit + " is out of range: it must be " + relation +
           ValueTraits<double>::print(bound) + unit;
  }
  return std::nullopt;
}

}  // namespace stroma
