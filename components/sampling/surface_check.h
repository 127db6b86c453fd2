// SPDX-License-Identifier: Apache-2.0
// Finds what is wrong with a triangle surface, precisely enough to repair it: every finding names
// its triangle, edge or vertex and comes with a sentence for the user. Nothing here throws or
// asserts on bad meshes: this is where they are found out.
#pragma once

#include <string>
#include <vector>

#include "components/sampling/surface_mesh.h"

namespace stroma {

enum class SurfaceFault {
  empty,                    // no vertex or no triangle
  nonFinitePosition,        // `vertices[0]`
  indexOutOfRange,          // `triangle`, offending index in `vertices[0]`
  repeatedVertex,           // `triangle` uses `vertices[0]` twice
  zeroArea,                 // `triangle` has three vertices on a line, or two in one place
  nonManifoldEdge,          // edge `vertices` has more than two triangles
  inconsistentOrientation,  // both triangles of edge `vertices` run along it the same way
  openRim,                  // edge `vertices` has a single triangle, `triangle`
  unreferencedVertex,       // `vertices[0]`
  insideOut,                // the closed surface encloses a negative volume
  noVolume                  // the closed surface is flat
};

struct SurfaceFinding {
  SurfaceFault fault;
  Index triangle = -1;
  Edge vertices = {-1, -1};
  std::string text;
};

// All findings, in the order of the enumeration; indices and finiteness first, since nothing else
// can be said while these fail (then only they are reported). An area counts as zero below 1e-12 of
// the square of the triangle's longest edge.
[[nodiscard]] std::vector<SurfaceFinding> checkSurface(ConstVec3Span positions,
                                                       TriangleSpan triangles);

// The findings that keep a surface from enclosing a volume: all but unreferenced vertices and
// degenerate triangles, which enclose nothing and do no harm. Empty text when the surface is
// closed, else the first finding's sentence and how many more there are.
[[nodiscard]] std::string whyNotClosed(ConstVec3Span positions, TriangleSpan triangles);

// The same for a surface that may have open rims.
[[nodiscard]] std::string whyNotSheet(ConstVec3Span positions, TriangleSpan triangles);

}  // namespace stroma
