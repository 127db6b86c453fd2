// SPDX-License-Identifier: Apache-2.0
#include "core/units.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/diagnostics.h"

namespace stroma {
namespace {

// SI value of a named unit: multiplier * 10^power.
struct NamedUnit {
  std::string_view name;
  Dimension dimension;
  double multiplier;
  int power;
  bool takesPrefix;
};

constexpr Dimension none{};
constexpr Dimension pressure{-1, 1, -2};
constexpr Dimension volume{3};
constexpr Dimension angle{0, 0, 0, 1};

constexpr std::array<NamedUnit, 22> namedUnits{{
    {"1", none, 1, 0, false},
    {"%", none, 1, -2, false},
    {"m", {1}, 1, 0, true},
    {"g", {0, 1}, 1, -3, true},
    {"t", {0, 1}, 1, 3, false},
    {"s", {0, 0, 1}, 1, 0, true},
    {"min", {0, 0, 1}, 60, 0, false},
    {"h", {0, 0, 1}, 3600, 0, false},
    {"rad", angle, 1, 0, true},
    {"deg", angle, std::numbers::pi / 180, 0, false},
    {"°", angle, std::numbers::pi / 180, 0, false},
    {"N", {1, 1, -2}, 1, 0, true},
    {"Pa", pressure, 1, 0, true},
    {"bar", pressure, 1, 5, true},
    {"mmHg", pressure, 133.322387415, 0, false},
    {"cmH2O", pressure, 98.0665, 0, false},
    {"J", {2, 1, -2}, 1, 0, true},
    {"W", {2, 1, -3}, 1, 0, true},
    {"Hz", {0, 0, -1}, 1, 0, true},
    {"l", volume, 1, -3, true},
    {"L", volume, 1, -3, true},
    {"dyn", {1, 1, -2}, 1, -5, false},
}};

// Both code points of the micro sign are in use: U+00B5 and the Greek letter U+03BC.
constexpr std::array<std::pair<std::string_view, int>, 13> prefixes{{
    {"p", -12},
    {"n", -9},
    {"u", -6},
    {"\u00B5", -6},
    {"\u03BC", -6},
    {"m", -3},
    {"c", -2},
    {"d", -1},
    {"h", 2},
    {"k", 3},
    {"M", 6},
    {"G", 9},
    {"T", 12},
}};

// Dimensions that have a name of their own, with the unit to show; the first of equals counts.
constexpr std::array<std::pair<Dimension, std::string_view>, 22> dimensionNames{{
    {none, "a number without unit"},
    {{1}, "length (m)"},
    {{2}, "area (m^2)"},
    {volume, "volume (m^3)"},
    {{0, 1}, "mass (kg)"},
    {{0, 0, 1}, "time (s)"},
    {{0, 0, -1}, "frequency (Hz)"},
    {{1, 0, -1}, "velocity (m/s)"},
    {{1, 0, -2}, "acceleration (m/s^2)"},
    {{-3, 1}, "density (kg/m^3)"},
    {{-2, 1}, "area density (kg/m^2)"},
    {{1, 1, -2}, "force (N)"},
    {pressure, "pressure (Pa)"},
    {{0, 1, -2}, "stiffness (N/m)"},
    {{0, 1, -1}, "damping (N s/m)"},
    {{-2, 1, -2}, "force per volume (N/m^3)"},
    {{2, 1, -2}, "energy (J)"},
    {{2, 1, -3}, "power (W)"},
    {{-1, 1, -1}, "viscosity (Pa s)"},
    {{1, 1, -1}, "momentum (N s)"},
    {angle, "angle (rad)"},
    {{0, 0, -1, 1}, "angular velocity (rad/s)"},
}};

// A unit while it is being read; powers of ten are kept apart so that they cancel exactly.
struct Product {
  Dimension dimension;
  double multiplier = 1;
  int power = 0;

  void multiply(const NamedUnit& unit, int prefix, int exponent) {
    dimension.length += exponent * unit.dimension.length;
    dimension.mass += exponent * unit.dimension.mass;
    dimension.time += exponent * unit.dimension.time;
    dimension.angle += exponent * unit.dimension.angle;
    power += exponent * (unit.power + prefix);
    for (int i = 0; i < exponent; ++i) multiplier *= unit.multiplier;
    for (int i = 0; i > exponent; --i) multiplier /= unit.multiplier;
  }

  [[nodiscard]] double factor() const {
    double ten = 1;  // exact up to 10^22
    for (int i = 0; i < std::abs(power); ++i) ten *= 10;
    return power < 0 ? multiplier / ten : multiplier * ten;
  }
};

bool multiplyByName(Product& product, std::string_view name, int exponent) {
  for (const NamedUnit& unit : namedUnits) {
    if (unit.name == name) return product.multiply(unit, 0, exponent), true;
  }
  for (const auto& [prefix, power] : prefixes) {
    if (!name.starts_with(prefix)) continue;
    for (const NamedUnit& unit : namedUnits) {
      if (unit.takesPrefix && unit.name == name.substr(prefix.size())) {
        return product.multiply(unit, power, exponent), true;
      }
    }
  }
  return false;
}

bool take(std::string_view& text, std::string_view token) {
  if (!text.starts_with(token)) return false;
  text.remove_prefix(token.size());
  return true;
}

// "^-2", "²", or nothing, which is the power 1; 0 if it cannot be read.
int takeExponent(std::string_view& text) {
  if (take(text, "²")) return 2;
  if (take(text, "³")) return 3;
  if (!take(text, "^")) return 1;
  int exponent = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  if (status != std::errc() || std::abs(exponent) > 9) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return exponent;
}

// What stands between two names: 1 for a product, -1 for a quotient, 0 for nothing of the kind.
int takeSeparator(std::string_view& text) {
  bool blank = false;
  while (take(text, " ") || take(text, "\t")) blank = true;
  int sign = blank ? 1 : 0;
  if (take(text, "*") || take(text, ".") || take(text, "·"))
    sign = 1;
  else if (take(text, "/"))
    sign = -1;
  while (take(text, " ") || take(text, "\t")) continue;
  return sign;
}

// Where the next name ends; "²", "³" and "·" share their first byte with "°" and "µ".
std::size_t nameLength(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size()) {
    const std::string_view rest = text.substr(length);
    if (std::string_view(" \t*./^").find(rest.front()) != std::string_view::npos) break;
    if (rest.starts_with("²") || rest.starts_with("³") || rest.starts_with("·")) break;
    ++length;
  }
  return length;
}

void appendPower(std::string& text, std::string_view name, int exponent) {
  if (exponent == 0) return;
  if (!text.empty()) text += ' ';
  text += name;
  if (exponent != 1) text += "^" + std::to_string(exponent);
}

// The whole number of which x is the reciprocal, or 0.
double wholeReciprocal(double x) {
  if (!(x > 0 && x < 1)) return 0;
  const double whole = std::round(1 / x);
  return 1 / whole == x ? whole : 0;
}

}  // namespace

std::optional<Unit> parseUnit(std::string_view text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  while (take(text, " ") || take(text, "\t")) continue;
  if (text.empty() || text.size() > mostUnitText) return std::nullopt;
  Product product;
  int sign = 1;
  while (!text.empty()) {
    const std::string_view name = text.substr(0, nameLength(text));
    text.remove_prefix(name.size());
    const int exponent = takeExponent(text);
    if (sign == 0 || exponent == 0) return std::nullopt;
    if (!multiplyByName(product, name, sign * exponent)) return std::nullopt;
    if (text.empty()) break;
    sign = takeSeparator(text);
    if (text.empty()) return std::nullopt;
  }
  const Unit unit{product.dimension, product.factor()};
  if (!std::isfinite(unit.factor) || unit.factor <= 0) return std::nullopt;
  return unit;
}

std::string unitHint(std::string_view wrong, const Dimension& wanted) {
  constexpr std::array common{
      "m",    "mm",    "um",   "cm",  "km",    "m^2",   "mm^2", "m^3",    "mm^3",   "ml",
      "kg",   "g",     "mg",   "s",   "ms",    "us",    "min",  "Hz",     "kHz",    "N",
      "mN",   "kN",    "Pa",   "kPa", "MPa",   "GPa",   "mmHg", "bar",    "N/m",    "kN/m",
      "N/mm", "N s/m", "Pa s", "J",   "mJ",    "J/m^2", "W",    "kg/m^3", "g/cm^3", "m/s",
      "mm/s", "m/s^2", "deg",  "rad", "rad/s", "deg/s", "%"};
  std::vector<std::string> fitting;
  for (const char* unit : common) {
    if (parseUnit(unit)->dimension == wanted) fitting.emplace_back(unit);
  }
  std::string hint = didYouMean(wrong, fitting);
  if (!hint.empty() || fitting.empty() || wanted == none) return hint;
  const std::string quantity = dimensionName(wanted);
  hint = "units of " + quantity.substr(0, quantity.find(" (")) + ": ";
  for (const std::string& unit : fitting) hint += (&unit == &fitting.front() ? "" : ", ") + unit;
  return hint;
}

std::string dimensionName(const Dimension& dimension) {
  for (const auto& [known, name] : dimensionNames) {
    if (known == dimension) return std::string(name);
  }
  std::string text;
  appendPower(text, "kg", dimension.mass);
  appendPower(text, "m", dimension.length);
  appendPower(text, "s", dimension.time);
  appendPower(text, "rad", dimension.angle);
  return text;
}

double scaled(double value, double factor) {
  if (factor == 1) return value;
  const double divisor = wholeReciprocal(factor);
  return divisor > 0 ? value / divisor : value * factor;
}

double UnitSystem::toSi(const Dimension& dimension) const {
  // whole factors only, above and below the line, so that "mm g s" gives exactly 1 for a pressure
  double above = 1, below = 1;
  const auto multiply = [&](double base, int exponent) {
    const double whole = wholeReciprocal(base);
    if (whole > 0) exponent = -exponent;
    for (int i = 0; i < std::abs(exponent); ++i)
      (exponent > 0 ? above : below) *= whole > 0 ? whole : base;
  };
  multiply(length, dimension.length);
  multiply(mass, dimension.mass);
  multiply(time, dimension.time);
  return above / below;
}

std::optional<UnitSystem> UnitSystem::parse(std::string_view text) {
  UnitSystem system;
  std::array<bool, 3> given{};
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end) {
    while (begin < text.size() && isBlank(text[begin])) ++begin;
    for (end = begin; end < text.size() && !isBlank(text[end]);) ++end;
    if (begin == end) break;
    const auto unit = parseUnit(text.substr(begin, end - begin));
    if (!unit) return std::nullopt;
    const Dimension& d = unit->dimension;
    const std::size_t which = d == Dimension{1}         ? 0
                              : d == Dimension{0, 1}    ? 1
                              : d == Dimension{0, 0, 1} ? 2
                                                        : 3;
    if (which == 3 || given[which]) return std::nullopt;
    given[which] = true;
    (which == 0 ? system.length : which == 1 ? system.mass : system.time) = unit->factor;
  }
  if (!given[0] || !given[1] || !given[2]) return std::nullopt;
  return system;
}

}  // namespace stroma
