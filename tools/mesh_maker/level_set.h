// SPDX-License-Identifier: Apache-2.0
// Meshes a smooth body given as the level set f = 0 (f < 0 inside): a start mesh of the right
// topology is drawn onto it and relaxed. Numbers of nodes and triangles stay what they are.
#pragma once

#include <functional>
#include <vector>

#include "components/sampling/surface_mesh.h"

namespace stroma::meshes {

using LevelSet = std::function<double(const Vec3&)>;

// Approximate signed distance to an ellipsoid, exact to first order at its surface.
[[nodiscard]] double ellipsoid(const Vec3& p, const Vec3& center, const Vec3& semiAxes);

// Signed distance to a ball whose centre and radius run from (a, ra) to (b, rb).
[[nodiscard]] double taperedRod(const Vec3& p, const Vec3& a, double ra, const Vec3& b, double rb);

// Union and difference with edges rounded over the length k.
[[nodiscard]] double smoothUnion(double a, double b, double k);
[[nodiscard]] double smoothDifference(double a, double b, double k);

// Distance from `inside` along the unit vector `direction` to the last crossing of f = 0 before
// `farthest`.
[[nodiscard]] double castRay(const LevelSet& f, const Vec3& inside, const Vec3& direction,
                             double farthest);

// Moves p onto f = 0 along the gradient.
[[nodiscard]] Vec3 project(const LevelSet& f, Vec3 p);

// `steps` times: flips edges towards Delaunay triangles, moves every node that is not on a rim
// towards the area-weighted middle of its triangles and back onto the level set. Rims stay where
// they are.
void relax(const LevelSet& f, int steps, SurfaceMesh& mesh);

}  // namespace stroma::meshes
