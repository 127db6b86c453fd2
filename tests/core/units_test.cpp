// SPDX-License-Identifier: Apache-2.0
#include "core/units.h"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>
#include <vector>

namespace stroma {
namespace {

constexpr Dimension pressure{-1, 1, -2};
constexpr Dimension force{1, 1, -2};

void expectUnit(std::string_view text, Dimension dimension, double factor) {
  const auto unit = parseUnit(text);
  ASSERT_TRUE(unit) << text;
  EXPECT_EQ(unit->dimension, dimension) << text;
  EXPECT_EQ(unit->factor, factor) << text;  // to the bit
}

TEST(Units, baseUnitsAndPrefixes) {
  expectUnit("m", {1}, 1);
  expectUnit("mm", {1}, 1e-3);
  expectUnit("cm", {1}, 1e-2);
  expectUnit("um", {1}, 1e-6);
  expectUnit("\u00B5m", {1}, 1e-6);
  expectUnit("\u03BCm", {1}, 1e-6);
  expectUnit("km", {1}, 1e3);
  expectUnit("kg", {0, 1}, 1);
  expectUnit("g", {0, 1}, 1e-3);
  expectUnit("mg", {0, 1}, 1e-6);
  expectUnit("s", {0, 0, 1}, 1);
  expectUnit("ms", {0, 0, 1}, 1e-3);
  expectUnit("min", {0, 0, 1}, 60);
  expectUnit("Hz", {0, 0, -1}, 1);
  expectUnit("kHz", {0, 0, -1}, 1e3);
  expectUnit("mN", force, 1e-3);
}

TEST(Units, pressures) {
  expectUnit("Pa", pressure, 1);
  expectUnit("kPa", pressure, 1e3);
  expectUnit("hPa", pressure, 1e2);
  expectUnit("MPa", pressure, 1e6);
  expectUnit("mbar", pressure, 1e2);
  expectUnit("mmHg", pressure, 133.322387415);
  expectUnit("cmH2O", pressure, 98.0665);
  expectUnit("N/m^2", pressure, 1);
  expectUnit("N/mm^2", pressure, 1e6);
}

TEST(Units, anglesAndPureNumbers) {
  expectUnit("rad", {0, 0, 0, 1}, 1);
  expectUnit("deg", {0, 0, 0, 1}, std::numbers::pi / 180);
  expectUnit("°", {0, 0, 0, 1}, std::numbers::pi / 180);
  expectUnit("rad/s", {0, 0, -1, 1}, 1);
  expectUnit("1", {}, 1);
  expectUnit("%", {}, 1e-2);
  expectUnit("1/s", {0, 0, -1}, 1);
}

TEST(Units, productsQuotientsAndPowers) {
  expectUnit("m/s^2", {1, 0, -2}, 1);
  expectUnit("N s/m", {0, 1, -1}, 1);
  expectUnit("N*s/m", {0, 1, -1}, 1);
  expectUnit("N.s/m", {0, 1, -1}, 1);
  expectUnit("N·s/m", {0, 1, -1}, 1);
  expectUnit("N s / m", {0, 1, -1}, 1);
  expectUnit("J/m^2", {0, 1, -2}, 1);
  expectUnit("kg m^-1 s^-2", pressure, 1);
  expectUnit("m^3", {3}, 1);
  expectUnit("mm^2", {2}, 1e-6);
  expectUnit("mm³", {3}, 1e-9);
  expectUnit("m²", {2}, 1);
  expectUnit("ml", {3}, 1e-6);
  expectUnit("l", {3}, 1e-3);
  expectUnit(" kPa ", pressure, 1e3);
  expectUnit("mm^-1", {-1}, 1e3);
}

TEST(Units, powersOfTenCancelExactly) {
  expectUnit("kg/m^3", {-3, 1}, 1);
  expectUnit("g/cm^3", {-3, 1}, 1e3);
  expectUnit("mg/mm^3", {-3, 1}, 1e3);
  expectUnit("nN/um", {0, 1, -2}, 1e-3);
}

TEST(Units, whatIsNoUnitIsRefused) {
  for (const std::string_view text :
       {"",    " ",    "pa",  "KPa",     "foo", "m/", "/m",   "m//s",
        "m^",  "m^x",  "m^0", "m^99",    "m2",  "^2", "m^2m", "mm mm mm xx",
        "kkg", "mmin", "µ",   "m * * s", "12",  "2m", "m\ns"}) {
    EXPECT_FALSE(parseUnit(text)) << text;
  }
  EXPECT_FALSE(parseUnit(std::string(1'000'000, 'm')));
  EXPECT_FALSE(parseUnit("Tm^9 Tm^9 Tm^9 Tm^9"));  // not a finite factor
}

TEST(Units, hintsNameTheNearest) {
  EXPECT_EQ(unitHint("kpa", pressure), "did you mean 'kPa'?");
  EXPECT_EQ(unitHint("kg/m3", {-3, 1}), "did you mean 'kg/m^3'?");
  EXPECT_EQ(unitHint("msec", {0, 0, 1}), "units of time: s, ms, us, min");
  EXPECT_EQ(unitHint("parsec", {5}), "");
}

TEST(Units, dimensionsHaveNames) {
  EXPECT_EQ(dimensionName(pressure), "pressure (Pa)");
  EXPECT_EQ(dimensionName({1}), "length (m)");
  EXPECT_EQ(dimensionName({}), "a number without unit");
  EXPECT_EQ(dimensionName({0, 0, 0, 1}), "angle (rad)");
  EXPECT_EQ(dimensionName({-1, 2, -3, 1}), "kg^2 m^-1 s^-3 rad");
}

TEST(Units, namesOfDimensionsShowAUnitOfThatDimension) {
  for (const std::string_view text :
       {"m",  "m^2", "m^3",   "kg",    "s", "Hz", "m/s",  "m/s^2", "kg/m^3", "N",
        "Pa", "N/m", "N s/m", "N/m^3", "J", "W",  "Pa s", "N s",   "rad",    "rad/s"}) {
    const auto unit = parseUnit(text);
    ASSERT_TRUE(unit) << text;
    EXPECT_TRUE(dimensionName(unit->dimension).ends_with("(" + std::string(text) + ")")) << text;
    EXPECT_EQ(unit->factor, 1) << text;
  }
}

TEST(Units, scalingWholeNumbersGivesTheNearestDouble) {
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(scaled(i, 1e-3), std::stod(std::to_string(i) + "e-3"));
    EXPECT_EQ(scaled(i, 1e-9), std::stod(std::to_string(i) + "e-9"));
    EXPECT_EQ(scaled(i, 1e3), 1000.0 * i);
  }
}

TEST(UnitSystem, sceneUnitsInAnyOrder) {
  const auto system = UnitSystem::parse("mm g s");
  ASSERT_TRUE(system);
  EXPECT_EQ(system->length, 1e-3);
  EXPECT_EQ(system->mass, 1e-3);
  EXPECT_EQ(system->time, 1);
  const auto other = UnitSystem::parse("  ms\tkg cm ");
  ASSERT_TRUE(other);
  EXPECT_EQ(other->length, 1e-2);
  EXPECT_EQ(other->mass, 1);
  EXPECT_EQ(other->time, 1e-3);
}

TEST(UnitSystem, conversionsAreExactForPowersOfTen) {
  const auto system = UnitSystem::parse("mm g s");
  ASSERT_TRUE(system);
  EXPECT_EQ(system->toSi(pressure), 1.0);
  EXPECT_EQ(system->toSi({-3, 1}), 1e6);  // g/mm^3
  EXPECT_EQ(system->toSi({1, 0, -2}), 1e-3);
  EXPECT_EQ(system->toSi(force), 1e-6);
  EXPECT_EQ(system->toSi({}), 1.0);
  EXPECT_EQ(system->toSi({0, 0, 0, 1}), 1.0);
  EXPECT_EQ(UnitSystem{}.toSi({3, 1, -2}), 1.0);
}

TEST(UnitSystem, anythingElseIsRefused) {
  for (const std::string_view text :
       {"", "mm", "mm g", "mm g s s", "mm mm s", "mm g Pa", "mm g x", "mm,g,s", "1 g s"}) {
    EXPECT_FALSE(UnitSystem::parse(text)) << text;
  }
}

}  // namespace
}  // namespace stroma
