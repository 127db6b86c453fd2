// SPDX-License-Identifier: Apache-2.0
// Checks of element lists that a scene or a file gave.
#pragma once

#include <array>
#include <span>
#include <string>

#include "core/types.h"

namespace stroma {

// The first element that names a point outside [0, points) or the same point twice, as a sentence
// ("element 4 (7 7 9) uses point 7 twice"); empty when there is none.
template <std::size_t N>
[[nodiscard]] std::string elementProblem(std::span<const std::array<Index, N>> elements,
                                         Index points) {
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto& element = elements[e];
    for (std::size_t i = 0; i < N; ++i) {
      const bool outside = element[i] < 0 || element[i] >= points;
      bool twice = false;
      for (std::size_t j = 0; j < i; ++j) twice |= element[j] == element[i];
      if (!outside && !twice) continue;
      std::string text = "element " + std::to_string(e) + " (";
      for (std::size_t j = 0; j < N; ++j) text += (j ? " " : "") + std::to_string(element[j]);
      text += ") uses point " + std::to_string(element[i]);
      return text + (twice ? " twice" : "; there are " + std::to_string(points) + " points");
    }
  }
  return {};
}

// Share of each point in the tetrahedra around it, a quarter of each (m^3).
[[nodiscard]] std::vector<double> lumpedVolumes(ConstVec3Span positions,
                                                std::span<const Tetrahedron> tetrahedra);
// The same in hexahedra, an eighth of each. Their faces are the bilinear ones.
[[nodiscard]] std::vector<double> lumpedVolumes(ConstVec3Span positions,
                                                std::span<const Hexahedron> hexahedra);

}  // namespace stroma
