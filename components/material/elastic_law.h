// SPDX-License-Identifier: Apache-2.0
// The names by which scenes choose among the laws of this folder: the same for every force field.
#pragma once

#include "core/value.h"

namespace stroma {

enum class MaterialLaw { hooke, stableNeoHookean };
enum class StrainMeasure { cauchy, green, corotated };  // of Hooke's law
// Stiffness as it is, or filtered to be positive semi-definite.
enum class TangentKind { exact, filtered };

template <>
struct EnumNames<MaterialLaw> {
  static constexpr std::array<std::pair<MaterialLaw, std::string_view>, 2> names = {
      {{MaterialLaw::hooke, "hooke"}, {MaterialLaw::stableNeoHookean, "stableNeoHookean"}}};
};
template <>
struct EnumNames<StrainMeasure> {
  static constexpr std::array<std::pair<StrainMeasure, std::string_view>, 3> names = {
      {{StrainMeasure::cauchy, "cauchy"},
       {StrainMeasure::green, "green"},
       {StrainMeasure::corotated, "corotated"}}};
};
template <>
struct EnumNames<TangentKind> {
  static constexpr std::array<std::pair<TangentKind, std::string_view>, 2> names = {
      {{TangentKind::exact, "exact"}, {TangentKind::filtered, "filtered"}}};
};

}  // namespace stroma
