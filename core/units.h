// SPDX-License-Identifier: Apache-2.0
// Physical dimensions, unit names with their factors to SI, and the units of a scene's bare
// numbers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stroma {

// Exponents of the base quantities. Angle is one of them, so that radians and degrees are not
// mistaken for pure numbers.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int angle = 0;

  friend bool operator==(const Dimension&, const Dimension&) = default;
};

struct Unit {
  Dimension dimension;
  double factor = 1.0;  // SI units (m, kg, s, rad) in one of this unit
};

// No unit text is longer than this many bytes.
inline constexpr std::size_t mostUnitText = 64;

// Units are written as "kPa", "N/m", "kg/m^3", "N s/m", "kg m^-1 s^-2", "1/s", "%": names with SI
// prefixes, powers '^n' (also "m²"), products by blank, '*' or '.', quotients by '/'; evaluated
// from left to right. Empty if a name is unknown or the text is not of this form. Powers of ten are
// combined before they are rounded, so "g/cm^3" is exactly 1000.
[[nodiscard]] std::optional<Unit> parseUnit(std::string_view text);

// "did you mean 'kPa'?" for the nearest common unit of the dimension that is wanted; where none is
// near, a few of them: "units of time: s, ms, us, min"; "" for dimensions without common units.
[[nodiscard]] std::string unitHint(std::string_view wrong, const Dimension& wanted);

// Readable name with the SI unit: "pressure (Pa)"; "kg^2 m^-1" for what has no name.
[[nodiscard]] std::string dimensionName(const Dimension& dimension);

// value * factor, but with the reciprocal where that one is a whole number: 3 mm then has the same
// bits as 0.003 m.
[[nodiscard]] double scaled(double value, double factor);

// What a scene's bare numbers mean: SI units in one unit of the scene. Angles are not scaled.
struct UnitSystem {
  double length = 1;
  double mass = 1;
  double time = 1;

  [[nodiscard]] double toSi(const Dimension& dimension) const;

  // "mm g s": a length, a mass and a time, in any order.
  [[nodiscard]] static std::optional<UnitSystem> parse(std::string_view text);
};

}  // namespace stroma
