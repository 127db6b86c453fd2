// SPDX-License-Identifier: Apache-2.0
#include "core/value.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <numbers>
#include <random>

namespace stroma {

enum class Kernel { wendland, cubicSpline, gauss };

template <>
struct EnumNames<Kernel> {
  static constexpr std::array<std::pair<Kernel, std::string_view>, 3> names{
      {{Kernel::wendland, "wendland"},
       {Kernel::cubicSpline, "cubicSpline"},
       {Kernel::gauss, "gauss"}}};
};

namespace {

template <class T>
T parsed(std::string_view text, const ValueContext& context = {}) {
  T value{};
  const auto error = ValueTraits<T>::parse(text, context, value);
  EXPECT_FALSE(error) << "'" << text.substr(0, 100) << "': " << error->message;
  return value;
}

// Expects an error with this id that points at this token of the text.
template <class T>
ParseError refused(std::string_view text, std::string_view id, std::string_view token,
                   const ValueContext& context = {}) {
  T value{};
  const auto error = ValueTraits<T>::parse(text, context, value);
  EXPECT_TRUE(error) << "'" << text << "' was accepted";
  if (!error) return {};
  EXPECT_EQ(error->id, id) << "'" << text << "': " << error->message;
  EXPECT_LE(error->offset + error->length, text.size());
  EXPECT_EQ(text.substr(error->offset, error->length), token) << "'" << text << "'";
  EXPECT_FALSE(error->message.empty());
  return *error;
}

template <class T>
void expectRoundTrip(const T& value) {
  const std::string text = ValueTraits<T>::print(value);
  EXPECT_TRUE(parsed<T>(text) == value) << text;
}

using Numbers = std::vector<double>;

// === bool

TEST(BoolValue, acceptedForms) {
  for (const std::string_view text : {"T", "t", "true", "True", "TRUE", "1", " 1 ", "2", "-1"}) {
    EXPECT_TRUE(parsed<bool>(text)) << text;
  }
  for (const std::string_view text : {"F", "f", "false", "False", "0", "\t0\n"}) {
    EXPECT_FALSE(parsed<bool>(text)) << text;
  }
  EXPECT_EQ(ValueTraits<bool>::print(true), "true");
  EXPECT_EQ(ValueTraits<bool>::print(false), "false");
}

TEST(BoolValue, anythingElseIsAnError) {
  refused<bool>("yes", "value-bool", "yes");
  refused<bool>(" tru ", "value-bool", "tru");
  refused<bool>("truely", "value-bool", "truely");
  refused<bool>("1.0", "value-bool", "1.0");
  refused<bool>("1 0", "value-bool", "1 0");
  refused<bool>("", "value-missing", "");
}

// === whole numbers

TEST(IntValue, wholeNumbersOnly) {
  EXPECT_EQ(parsed<int>(" 42 "), 42);
  EXPECT_EQ(parsed<int>("-7"), -7);
  EXPECT_EQ(parsed<int>("+7"), 7);
  EXPECT_EQ(parsed<int>("-2147483648"), std::numeric_limits<int>::min());
  refused<int>("3.0", "value-number", "3.0");
  refused<int>("1e3", "value-number", "1e3");
  refused<int>("x", "value-number", "x");
  refused<int>("5 mm", "value-number", "mm");
  refused<int>("+-5", "value-number", "+-5");
  refused<int>("++5", "value-number", "++5");
  refused<int>("2147483648", "value-overflow", "2147483648");
  refused<int>("1,5", "value-comma", "1,5");
  refused<int>("1 2", "value-count", "2");
  refused<int>("", "value-missing", "");
}

TEST(IntValue, listsAndTuples) {
  EXPECT_EQ(parsed<std::vector<int>>("1 -2\n\t3"), (std::vector<int>{1, -2, 3}));
  EXPECT_EQ(parsed<std::vector<int>>("  "), std::vector<int>{});
  refused<std::vector<int>>("1 2 x3 4", "value-number", "x3");
  EXPECT_EQ((parsed<std::array<Index, 3>>("10 4 2")), (std::array<Index, 3>{10, 4, 2}));
  const auto error = refused<std::array<Index, 3>>("10 4", "value-count", "10 4");
  EXPECT_EQ(error.message, "expected 3 whole numbers, got 2");
}

// === numbers

TEST(DoubleValue, decimalPointWhateverTheLocale) {
  const char* const before = std::setlocale(LC_NUMERIC, nullptr);
  const std::string kept = before ? before : "C";
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  EXPECT_EQ(parsed<double>("0.25"), 0.25);
  EXPECT_EQ(ValueTraits<double>::print(0.25), "0.25");
  std::setlocale(LC_NUMERIC, kept.c_str());
}

TEST(DoubleValue, acceptedForms) {
  EXPECT_EQ(parsed<double>(" 5 "), 5);
  EXPECT_EQ(parsed<double>("+.5"), 0.5);
  EXPECT_EQ(parsed<double>("-1.5E-3"), -1.5e-3);
  EXPECT_EQ(parsed<double>("1."), 1);
  EXPECT_EQ(parsed<double>("1e308"), 1e308);
  EXPECT_EQ(parsed<double>("5e-324"), 5e-324);
  EXPECT_TRUE(std::signbit(parsed<double>("-0")));
}

TEST(DoubleValue, commasAreExplained) {
  EXPECT_EQ(refused<double>("0,01", "value-comma", "0,01").hint, "write '0.01'");
  EXPECT_EQ(refused<Vec3>("1, 2, 3", "value-comma", "1,").hint, "");
  EXPECT_EQ(refused<Vec3>("1,2,3", "value-comma", "1,2,3").hint, "");
  refused<Vec3>("1 ,2 3", "value-comma", ",2");
}

TEST(DoubleValue, onlyFiniteNumbers) {
  for (const std::string_view text : {"nan", "NaN", "-nan", "inf", "-inf", "Infinity", "+inf"}) {
    refused<double>(text, "value-not-finite", text);
    refused<Numbers>("1 " + std::string(text) + " 2", "value-not-finite", text);
  }
  refused<double>("1e400", "value-overflow", "1e400");
  refused<double>("-1e400", "value-overflow", "-1e400");
  refused<double>("1e-400", "value-overflow", "1e-400");
  refused<double>("1e308 km", "value-overflow", "1e308 km", {"m", {}});
}

TEST(DoubleValue, badTokensArePointedAt) {
  refused<double>("abc", "value-number", "abc");
  refused<double>("information", "value-number", "information");
  refused<double>("0x10", "value-number", "0x10");
  refused<double>("1.2.3", "value-number", "1.2.3");
  refused<double>("--5", "value-number", "--5");
  refused<double>("5-3", "value-number", "5-3");
  refused<double>("1.#INF", "value-number", "1.#INF");
  refused<Numbers>(" 1 2 3;4 5", "value-number", "3;4");
  refused<Numbers>("1 2 30o0 5", "value-number", "30o0", {"Pa", {}});
  refused<Numbers>("(1 2)", "value-number", "(1");
  refused<double>(std::string_view("5\0", 2), "value-number", std::string_view("5\0", 2));
}

TEST(DoubleValue, countsAreStated) {
  EXPECT_EQ(refused<double>("", "value-missing", "").message, "expected 1 number, got nothing");
  EXPECT_EQ(refused<double>("1 2", "value-count", "2").message, "expected 1 number, got more");
  EXPECT_EQ(refused<Vec3>(" 1 2 ", "value-count", "1 2").message, "expected 3 numbers, got 2");
  EXPECT_EQ(refused<Vec3>("1 2 3 4", "value-count", "4").message, "expected 3 numbers, got more");
  EXPECT_EQ(refused<std::vector<Vec3>>("1 2 3 4", "value-count", "1 2 3 4").message,
            "expected a multiple of 3 numbers, got 4");
}

TEST(DoubleValue, printsTheShortestTextOfTheSameBits) {
  EXPECT_EQ(ValueTraits<double>::print(0.1), "0.1");
  EXPECT_EQ(ValueTraits<double>::print(3000), "3000");
  std::mt19937_64 random(1);
  Numbers numbers;
  while (numbers.size() < 20000) {
    const double number = std::bit_cast<double>(random());
    if (std::isfinite(number)) numbers.push_back(number);
  }
  for (const double edge : {0.0, -0.0, 5e-324, 1.7976931348623157e308}) numbers.push_back(edge);
  const auto back = parsed<Numbers>(ValueTraits<Numbers>::print(numbers));
  ASSERT_EQ(back.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(numbers[i]));
  }
}

TEST(DoubleValue, theValueIsKeptOnErrors) {
  double number = 7;
  EXPECT_TRUE(ValueTraits<double>::parse("x", {}, number));
  EXPECT_EQ(number, 7);
  Numbers numbers{7};
  EXPECT_TRUE(ValueTraits<Numbers>::parse("1 2 x", {}, numbers));
  EXPECT_EQ(numbers, Numbers{7});
}

// === units

TEST(UnitSuffix, withAndWithoutBlank) {
  const ValueContext pascal{"Pa", {}};
  EXPECT_EQ(parsed<double>("6 kPa", pascal), 6000);
  EXPECT_EQ(parsed<double>("6kPa", pascal), 6000);
  EXPECT_EQ(parsed<double>("6e3Pa", pascal), 6000);
  EXPECT_EQ(parsed<double>("6000", pascal), 6000);
  EXPECT_EQ(parsed<double>(" 15 mmHg ", pascal), 15 * 133.322387415);
  EXPECT_EQ(parsed<double>("0.6 mm", {"m", {}}), 0.6e-3);
  EXPECT_EQ(parsed<double>("58 um", {"m", {}}), 58e-6);
  EXPECT_EQ(parsed<double>("58µm", {"m", {}}), 58e-6);
  EXPECT_EQ(parsed<double>("2 N s/m", {"N s/m", {}}), 2);
  EXPECT_EQ(parsed<double>("2 N s / m", {"kg/s", {}}), 2);
  EXPECT_EQ(parsed<double>("5 1/s", {"Hz", {}}), 5);
  EXPECT_EQ(parsed<double>("5/s", {"Hz", {}}), 5);
  EXPECT_EQ(parsed<double>("1/s", {"Hz", {}}), 1);
}

TEST(UnitSuffix, theLastOneHoldsForTheList) {
  const ValueContext metre{"m", {}};
  EXPECT_EQ(parsed<Numbers>("1 2 3 mm", metre), (Numbers{1e-3, 2e-3, 3e-3}));
  EXPECT_EQ(parsed<Vec3>("0 0 -9.81 m/s^2", {"m/s^2", {}}), Vec3(0, 0, -9.81));
  EXPECT_EQ(parsed<Numbers>("1 mm 2 cm 3mm", metre), (Numbers{1e-3, 2e-2, 3e-3}));
  EXPECT_EQ(parsed<Numbers>("1 mm 2 3 cm", metre), (Numbers{1e-3, 2e-2, 3e-2}));
  EXPECT_EQ(parsed<Numbers>("0 1 mm 0", metre), (Numbers{0, 1e-3, 0}));
}

TEST(UnitSuffix, aBareNumberAfterUnitsIsAmbiguous) {
  const ValueContext metre{"m", {}};
  refused<Numbers>("1 mm 25 0", "unit-mixed", "25", metre);
  refused<Numbers>("0 5 2 mm 0 7", "unit-mixed", "5", metre);
}

TEST(UnitSuffix, theWrongDimensionIsNamed) {
  const auto error = refused<double>("6 mm", "unit-dimension", "mm", {"Pa", {}});
  EXPECT_EQ(error.message, "expected pressure (Pa), got length (m)");
  refused<double>("6kg", "unit-dimension", "kg", {"Pa", {}});
  refused<Vec3>("0 0 -9.81 m/s", "unit-dimension", "m/s", {"m/s^2", {}});
  refused<double>("5 %", "unit-dimension", "%", {"Pa", {}});
  refused<double>("3 deg", "unit-dimension", "deg", {"1", {}});
}

TEST(UnitSuffix, unknownUnitsHaveAHint) {
  const ValueContext pascal{"Pa", {}};
  EXPECT_EQ(refused<double>("6 kpa", "unit-unknown", "kpa", pascal).hint, "did you mean 'kPa'?");
  refused<double>("6kpascal", "unit-unknown", "kpascal", pascal);
  refused<double>("6 apples and pears", "unit-unknown", "apples and pears", pascal);
}

TEST(UnitSuffix, valuesWithoutUnitTakeNone) {
  refused<double>("6 kPa", "unit-unexpected", "kPa");
  refused<double>("0.45m", "unit-unexpected", "m");
  refused<double>("6 apples", "value-number", "apples");
  refused<Color>("1 0 0 mm", "unit-unexpected", "mm");
  EXPECT_EQ(parsed<double>("45 %", {"1", {}}), 0.45);
}

TEST(UnitSuffix, bareNumbersAreInTheScenesUnits) {
  const auto units = UnitSystem::parse("mm g s");
  ASSERT_TRUE(units);
  EXPECT_EQ(parsed<double>("3", {"m", *units}), 3e-3);
  EXPECT_EQ(parsed<double>("3 m", {"m", *units}), 3);
  EXPECT_EQ(parsed<double>("3", {"Pa", *units}), 3);
  EXPECT_EQ(parsed<double>("0.001", {"kg/m^3", *units}), 1000);
  EXPECT_EQ(parsed<double>("3", {"", *units}), 3);
  EXPECT_EQ(parsed<Vec3>("0 -9810 0", {"m/s^2", *units}), Vec3(0, -9.81, 0));
  const Box box = parsed<Box>("0 0 0 1 2 3", {"m", *units});
  EXPECT_EQ(box.max, Vec3(1e-3, 2e-3, 3e-3));
}

TEST(UnitSuffix, degreesStayDegreesWhereTheyAreDeclared) {
  EXPECT_EQ(parsed<Vec3>("90 0 45", {"deg", {}}), Vec3(90, 0, 45));
  EXPECT_EQ(parsed<double>("90 deg", {"deg", {}}), 90);
  EXPECT_DOUBLE_EQ(parsed<double>("1 rad", {"deg", {}}), 180 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(parsed<double>("90°", {"rad", {}}), std::numbers::pi / 2);
}

TEST(UnitSuffix, aWrongDeclarationIsReported) {
  refused<double>("5", "unit-declared", "5", {"pascals", {}});
}

// === points, rotations, boxes

TEST(VectorValue, roundTrips) {
  expectRoundTrip(Vec3(0.1, -2e-9, 1e300));
  expectRoundTrip(std::vector<Vec3>{{1, 2, 3}, {0.1, 0.2, 0.3}});
  expectRoundTrip(std::vector<Vec3>{});
  EXPECT_EQ(parsed<std::vector<Vec3>>("1 2 3\n 4 5 6 mm", {"m", {}}).at(1), Vec3(4e-3, 5e-3, 6e-3));
}

TEST(QuatValue, isNormalisedOnce) {
  const Quat q = parsed<Quat>("0 0 2 0");
  EXPECT_EQ(q.z(), 1);
  EXPECT_EQ(q.w(), 0);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Quat wanted = Quat(normal(random), normal(random), normal(random), normal(random));
    const Quat once = parsed<Quat>(ValueTraits<Quat>::print(wanted));
    EXPECT_NEAR(once.norm(), 1, 1e-15);
    const Quat twice = parsed<Quat>(ValueTraits<Quat>::print(once));
    EXPECT_EQ(once.coeffs(), twice.coeffs());
  }
  refused<Quat>(" 0 0 0 0 ", "value-rotation", "0 0 0 0");
  refused<Quat>("0 0 1", "value-count", "0 0 1");
}

TEST(BoxValue, minimumIsNotAboveMaximum) {
  const Box box = parsed<Box>("0 0 0 1 1 0");
  EXPECT_EQ(box.max, Vec3(1, 1, 0));
  expectRoundTrip(box);
  refused<Box>("0 0 0 1 -1 1", "value-box", "0 0 0 1 -1 1");
  refused<Box>("0 0 0 1 1", "value-count", "0 0 0 1 1");
  refused<Box>("0 0 0 1 1 1 1", "value-count", "1");
  EXPECT_EQ(parsed<std::vector<Box>>("0 0 0 1 1 1  2 2 2 3 3 3").size(), 2u);
  refused<std::vector<Box>>("0 0 0 1 1 1 2", "value-count", "0 0 0 1 1 1 2");
  expectRoundTrip(std::vector<Box>{box, box});
}

// === colours, names, files, choices

TEST(ColorValue, acceptedForms) {
  EXPECT_EQ(parsed<Color>("1 0.5 0"), (Color{1, 0.5, 0, 1}));
  EXPECT_EQ(parsed<Color>("1 0.5 0 0.25"), (Color{1, 0.5, 0, 0.25}));
  EXPECT_EQ(parsed<Color>("#f00"), (Color{1, 0, 0, 1}));
  EXPECT_EQ(parsed<Color>("#F000"), (Color{1, 0, 0, 0}));
  EXPECT_EQ(parsed<Color>(" #ff8000 "), (Color{1, 128 / 255.0, 0, 1}));
  EXPECT_EQ(parsed<Color>("#ff800080"), (Color{1, 128 / 255.0, 0, 128 / 255.0}));
  for (const std::string_view name :
       {"white", "black",    "red",       "green",  "blue",   "cyan", "magenta", "yellow",
        "gray",  "darkgray", "lightgray", "orange", "purple", "pink", "brown",   "lime",
        "teal",  "navy",     "olive",     "maroon", "silver", "gold", "azure"}) {
    expectRoundTrip(parsed<Color>(name));
  }
}

TEST(ColorValue, otherFormsAreErrors) {
  EXPECT_EQ(refused<Color>("yelow", "value-color", "yelow").hint, "did you mean 'yellow'?");
  for (const std::string_view text : {"#", "#12", "#12345", "#1234567", "#ggg", "#-12", "#ff 00"}) {
    refused<Color>(text, "value-color", text);
  }
  refused<Color>("255 0 0", "value-color", "255 0 0");
  refused<Color>("1 0", "value-count", "1 0");
  refused<Color>("1 0 0 1 1", "value-count", "1");
  refused<Color>("", "value-missing", "");
}

TEST(TextValue, textIsKeptAsItIs) {
  EXPECT_EQ(parsed<std::string>(" a b "), " a b ");
  EXPECT_EQ(parsed<FilePath>("  my mesh.obj\n").path, "my mesh.obj");
  const std::vector<std::string> names{"a", "b/c", "µ"};
  EXPECT_EQ(parsed<std::vector<std::string>>(" a  b/c\nµ "), names);
  expectRoundTrip(names);
  expectRoundTrip(FilePath{"my mesh.obj"});
}

TEST(EnumValue, namesOnly) {
  EXPECT_EQ(parsed<Kernel>(" gauss "), Kernel::gauss);
  expectRoundTrip(Kernel::cubicSpline);
  EXPECT_EQ(ValueTraits<Kernel>::typeName(), "wendland | cubicSpline | gauss");
  const auto error = refused<Kernel>("wenland", "value-choice", "wenland");
  EXPECT_EQ(error.message, "expected wendland | cubicSpline | gauss, got 'wenland'");
  EXPECT_EQ(error.hint, "did you mean 'wendland'?");
  refused<Kernel>("", "value-missing", "");
}

// === indices

std::vector<Index> indices(std::string_view text) { return parsed<IndexList>(text).indices; }
using Indices = std::vector<Index>;

TEST(IndexListValue, ranges) {
  EXPECT_EQ(indices("4 7"), (Indices{4, 7}));
  EXPECT_EQ(indices("3-7"), (Indices{3, 4, 5, 6, 7}));
  EXPECT_EQ(indices("7-3"), (Indices{7, 6, 5, 4, 3}));
  EXPECT_EQ(indices("0-10-2"), (Indices{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(indices("0-9-4"), (Indices{0, 4, 8}));
  EXPECT_EQ(indices("10-1--3"), (Indices{10, 7, 4, 1}));
  EXPECT_EQ(indices("10-1-2"), (Indices{1, 3, 5, 7, 9}));  // the step's sign decides
  EXPECT_EQ(indices("1-10--2"), (Indices{10, 8, 6, 4, 2}));
  EXPECT_EQ(indices("5-5"), (Indices{5}));
  EXPECT_EQ(indices(" 1 3-4\n9 "), (Indices{1, 3, 4, 9}));
  EXPECT_EQ(indices(""), Indices{});
  EXPECT_EQ(indices("2147483646-2147483647"), (Indices{2147483646, 2147483647}));
}

TEST(IndexListValue, badTokensArePointedAt) {
  refused<IndexList>("1 -2 3", "index-negative", "-2");
  refused<IndexList>("1 3--5", "index-negative", "3--5");
  refused<IndexList>("1 2- 3", "value-number", "2-");
  refused<IndexList>("1 2-x 3", "value-number", "2-x");
  refused<IndexList>("1 2-5-", "value-number", "2-5-");
  refused<IndexList>("1-2-3-4", "value-number", "1-2-3-4");
  refused<IndexList>("1 a 3", "value-number", "a");
  refused<IndexList>("1,2", "value-comma", "1,2");
  refused<IndexList>("1.5", "value-number", "1.5");
  refused<IndexList>("0-10-0", "index-step", "0-10-0");
  refused<IndexList>("0-2147483648", "value-overflow", "0-2147483648");
}

TEST(IndexListValue, expansionIsBounded) {
  refused<IndexList>("7 0-2147483647", "index-too-many", "0-2147483647");
  std::string text;
  for (int i = 0; i < 100; ++i) text += "0-999999 ";
  refused<IndexList>(text, "index-too-many", "0-999999");
  EXPECT_EQ(indices("0-2147483647-2147483647"), (Indices{0, 2147483647}));
  EXPECT_EQ(indices("0-2147483647--2147483648"), (Indices{2147483647}));
}

TEST(IndexListValue, runsArePrintedAsRanges) {
  const auto print = [](Indices list) { return ValueTraits<IndexList>::print({std::move(list)}); };
  EXPECT_EQ(print({0, 1, 2, 3}), "0-3");
  EXPECT_EQ(print({0, 1, 5, 6, 7, 3}), "0 1 5-7 3");
  EXPECT_EQ(print({4, 3, 2}), "4 3 2");
  EXPECT_EQ(print({}), "");
  std::mt19937 random(5);
  for (int run = 0; run < 200; ++run) {
    IndexList list;
    for (Index i = 0; i < 200; ++i) {
      if (random() % 3 != 0) list.indices.push_back(i);
      if (random() % 9 == 0) list.indices.push_back(static_cast<Index>(random() % 300));
    }
    expectRoundTrip(list);
  }
}

TEST(ElementValue, flatLists) {
  EXPECT_EQ(parsed<std::vector<Triangle>>("0 1 2 2 1 3"),
            (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  expectRoundTrip(std::vector<Edge>{{0, 1}, {1, 2}});
  expectRoundTrip(std::vector<Tetrahedron>{{0, 1, 2, 3}});
  expectRoundTrip(std::vector<Hexahedron>{{0, 1, 2, 3, 4, 5, 6, 7}});
  refused<std::vector<Triangle>>("0 1 -2", "index-negative", "-2");
  refused<std::vector<Triangle>>("0 1 2x", "value-number", "2x");
  const auto error = refused<std::vector<Triangle>>("0 1 2 3", "value-count", "0 1 2 3");
  EXPECT_EQ(error.message, "expected a multiple of 3 whole numbers, got 4");
}

// === robustness

// Times are only judged in optimised builds without sanitizers.
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr bool judgesTimes = true;
#else
constexpr bool judgesTimes = false;
#endif

double seconds(const auto& body) {
  const auto begin = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(ValueSpeed, aMillionNumbers) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-0.01, 0.01);
  Numbers numbers(1'000'000);
  for (double& number : numbers) number = uniform(random);
  const std::string text = ValueTraits<Numbers>::print(numbers);
  double best = 1e9;
  Numbers back;
  for (int run = 0; run < 3; ++run) {
    best = std::min(best, seconds([&] { back = parsed<Numbers>(text + " mm", {"m", {}}); }));
  }
  std::cout << "1e6 numbers (" << text.size() << " bytes): " << 1e3 * best << " ms\n";
  EXPECT_EQ(back.size(), numbers.size());
  if (judgesTimes) {
    EXPECT_LT(best, 0.2);
  }
}

TEST(ValueSpeed, garbageOfAHundredMegabytesFailsFast) {
  constexpr std::size_t size = 100'000'000;
  for (const std::string& text :
       {std::string(size, 'x'), std::string(size, '7'), "5 " + std::string(size, 'm'),
        std::string(size, ' ') + "x", "1," + std::string(size, '2'), "1" + std::string(size, '.'),
        "5" + std::string(size, '\xB5')}) {
    Numbers numbers;
    std::optional<ParseError> error;
    const double took = seconds([&] {
      error = ValueTraits<Numbers>::parse(text, {"m", {}}, numbers);
    });
    ASSERT_TRUE(error);
    EXPECT_LT(error->message.size() + error->hint.size(), 500u);
    std::cout << error->id << ": " << 1e3 * took << " ms\n";
    if (judgesTimes) {
      EXPECT_LT(took, 2.0);
    }
  }
}

// Whatever the bytes, an answer comes back, and errors point into the text.
template <class T>
void expectNoSurprise(std::string_view text, const ValueContext& context) {
  T value{};
  const auto error = ValueTraits<T>::parse(text, context, value);
  if (!error) return;
  ASSERT_LE(error->offset, text.size());
  ASSERT_LE(error->offset + error->length, text.size());
  ASSERT_FALSE(error->id.empty());
  ASSERT_FALSE(error->message.empty());
}

TEST(ValueRobustness, randomTexts) {
  constexpr std::string_view letters = "0123456789 .-+eEmkPa/^%#,nifxT\t\n\xC2\xB5\xB2\xFF";
  std::mt19937 random(13);
  const UnitSystem units{1e-3, 1e-3, 1};
  for (int run = 0; run < 20000; ++run) {
    std::string text;
    for (std::size_t length = random() % 24; length > 0; --length) {
      text += letters[random() % letters.size()];
    }
    const ValueContext context{run % 2 == 0 ? "Pa" : "", units};
    expectNoSurprise<bool>(text, context);
    expectNoSurprise<int>(text, context);
    expectNoSurprise<double>(text, context);
    expectNoSurprise<Vec3>(text, context);
    expectNoSurprise<Quat>(text, context);
    expectNoSurprise<Color>(text, context);
    expectNoSurprise<Box>(text, context);
    expectNoSurprise<IndexList>(text.substr(0, 9), context);
    expectNoSurprise<std::vector<Vec3>>(text, context);
    expectNoSurprise<std::vector<Triangle>>(text, context);
    expectNoSurprise<std::vector<Box>>(text, context);
    expectNoSurprise<Kernel>(text, context);
  }
}

TEST(ValueTypes, haveNames) {
  EXPECT_EQ(ValueTraits<double>::typeName(), "number");
  EXPECT_EQ(ValueTraits<Vec3>::typeName(), "3 numbers");
  EXPECT_EQ(ValueTraits<std::vector<Triangle>>::typeName(), "triangles (3 indices each)");
  EXPECT_EQ((ValueTraits<std::array<Index, 3>>::typeName()), "3 whole numbers");
}

}  // namespace
}  // namespace stroma
