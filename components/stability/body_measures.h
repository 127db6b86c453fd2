// SPDX-License-Identifier: Apache-2.0
// How far particles are from their rest shape, and what they carry with them.
#pragma once

#include <span>

#include "core/types.h"

namespace stroma {

// The longest side of the points' bounds (m); 0 for a single point.
[[nodiscard]] double longestSide(ConstVec3Span points);

// The largest distance between x and rest (m).
[[nodiscard]] double largestDisplacement(ConstVec3Span x, ConstVec3Span rest);

// The largest distance (m) that is left when rest is moved rigidly to where it fits x best in the
// mean square (Kabsch 1976); a mirror image does not fit.
[[nodiscard]] double largestShapeError(ConstVec3Span x, ConstVec3Span rest);

// Momentum (kg m/s) and angular momentum (kg m^2/s) about a point, with the sums of the particles'
// own lengths as their scales.
struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double linearScale = 0, angularScale = 0;
};
void addMomenta(ConstVec3Span x, ConstVec3Span v, std::span<const double> mass, const Vec3& about,
                Momenta& sum);

// Elements whose orientation is not that at rest: tetrahedra of volume zero or of the other sign,
// hexahedra with such a corner.
[[nodiscard]] std::size_t countInverted(std::span<const Tetrahedron> elements, ConstVec3Span x,
                                        ConstVec3Span rest);
[[nodiscard]] std::size_t countInverted(std::span<const Hexahedron> elements, ConstVec3Span x,
                                        ConstVec3Span rest);

// How much of the pattern is in the displacements: <u, p> / <p, p>. 1 for u = p.
[[nodiscard]] double shareOf(ConstVec3Span pattern, ConstVec3Span x, ConstVec3Span rest);

}  // namespace stroma
