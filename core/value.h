// SPDX-License-Identifier: Apache-2.0
// Text to value and back for every type that an attribute may have. No value is ever invented:
// what cannot be read is an error that points at the token. Nothing depends on the locale.
//
// Numbers have a decimal point, are separated by blanks and may have a unit: "6 kPa", "0.6mm". The
// unit after the last number of a list holds for all that have none of their own: "1 2 3 mm". Bare
// numbers are meant in the scene's units. Values are held in the attribute's declared unit, which
// is an SI unit, or one of the pure scales "deg" and "%": bare numbers then count degrees or per
// cent.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/types.h"
#include "core/units.h"

namespace stroma {

// What is wrong with a text; offset and length (bytes) give the bad token within it.
struct ParseError {
  std::size_t offset = 0;
  std::size_t length = 0;
  std::string id;  // "value-…", "unit-…", "index-…"
  std::string message;
  std::string hint;
};

struct ValueContext {
  std::string_view unit;  // the attribute's unit; "" = none, and then no suffix is accepted
  UnitSystem units;       // what bare numbers mean
};

// Indices of particles or elements, not negative. Read from "4 7", "3-7", "0-10-2" (step), "7-3"
// (downward); at most maxCount in all.
struct IndexList {
  static constexpr std::size_t maxCount = 50'000'000;
  std::vector<Index> indices;
  friend bool operator==(const IndexList&, const IndexList&) = default;
};

// Components between 0 and 1. Read from "r g b", "r g b a", "#rgb", "#rgba", "#rrggbb",
// "#rrggbbaa", or a name such as "orange".
struct Color {
  double r = 1, g = 1, b = 1, a = 1;
  friend bool operator==(const Color&, const Color&) = default;
};

// Name of a file as the scene has it; blanks round it are dropped, blanks inside it kept.
struct FilePath {
  std::string path;
  friend bool operator==(const FilePath&, const FilePath&) = default;
};

// Axis-aligned box, read from six numbers "xmin ymin zmin xmax ymax zmax" with min <= max.
struct Box {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();
  friend bool operator==(const Box&, const Box&) = default;
};

// Specialise for an enumeration that shall be an attribute:
//   template <> struct EnumNames<Kernel> {
//     static constexpr std::array<std::pair<Kernel, std::string_view>, 2> names{{...}};
//   };
template <class E>
struct EnumNames;

template <class E>
concept NamedEnum = std::is_enum_v<E> && requires {
  EnumNames<E>::names.size();
};

// Types read by value.cpp. Quaternions are "x y z w", normalised unless they are already; lists of
// elements are flat; lists of names are separated by blanks.
template <class T>
concept PlainValue = std::same_as<T, bool> || std::same_as<T, int> || std::same_as<T, double> ||
    std::same_as<T, std::string> || std::same_as<T, Vec3> || std::same_as<T, Quat> ||
    std::same_as<T, Color> || std::same_as<T, FilePath> || std::same_as<T, Box> ||
    std::same_as<T, IndexList> || std::same_as<T, std::array<Index, 2>> ||
    std::same_as<T, std::array<Index, 3>> || std::same_as<T, std::vector<double>> ||
    std::same_as<T, std::vector<int>> || std::same_as<T, std::vector<Vec3>> ||
    std::same_as<T, std::vector<std::string>> || std::same_as<T, std::vector<Box>> ||
    std::same_as<T, std::vector<Edge>> || std::same_as<T, std::vector<Triangle>> ||
    std::same_as<T, std::vector<Tetrahedron>> || std::same_as<T, std::vector<Hexahedron>>;

// typeName: for messages and the reference, such as "3 numbers".
// parse: `out` is changed only on success.
// print: text that parses to the same bits (SI, no suffix); names in a list must have no blanks.
template <class T>
struct ValueTraits;

// Of its own, because clang 16 cannot define members of a constrained specialisation elsewhere.
template <class T>
struct PlainTraits {
  [[nodiscard]] static std::string typeName();
  [[nodiscard]] static std::optional<ParseError> parse(std::string_view text,
                                                       const ValueContext& context, T& out);
  [[nodiscard]] static std::string print(const T& value);
};

template <PlainValue T>
struct ValueTraits<T> : PlainTraits<T> {};

// Index of the text among the names; the error lists them all and the nearest.
[[nodiscard]] std::optional<ParseError> parseChoice(std::string_view text,
                                                    std::span<const std::string_view> names,
                                                    std::size_t& chosen);
// "a | b | c"
[[nodiscard]] std::string listChoices(std::span<const std::string_view> names);

template <NamedEnum E>
struct ValueTraits<E> {
  [[nodiscard]] static std::string typeName() { return listChoices(names()); }

  [[nodiscard]] static std::optional<ParseError> parse(std::string_view text, const ValueContext&,
                                                       E& out) {
    std::size_t chosen = 0;
    auto error = parseChoice(text, names(), chosen);
    if (!error) out = EnumNames<E>::names[chosen].first;
    return error;
  }

  [[nodiscard]] static std::string print(const E& value) {
    for (const auto& [item, name] : EnumNames<E>::names) {
      if (item == value) return std::string(name);
    }
    return {};
  }

 private:
  static auto names() {
    std::array<std::string_view, EnumNames<E>::names.size()> list;
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = EnumNames<E>::names[i].second;
    return list;
  }
};

}  // namespace stroma
