// SPDX-License-Identifier: Apache-2.0
// The three kinds of VTK XML file that ParaView needs: polygons (.vtp), unstructured grids (.vtu)
// and the list of a time series (.pvd). Numbers are written as they are in memory (appended raw
// data, little endian, 64-bit lengths), after the VTK file format description, version 1.0.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/types.h"

namespace stroma::vtk {

// Values of every point: `components` numbers each (1 or 3).
struct Field {
  std::string name;
  int components;
  std::vector<double> values;
};

// What a file shows; unstructured grids have vertices where there is no element at all.
struct Picture {
  ConstVec3Span points;
  std::span<const Edge> edges;
  std::span<const Triangle> triangles;
  std::span<const Quad> quads;
  std::span<const Tetrahedron> tetrahedra;
  std::span<const Hexahedron> hexahedra;
  std::vector<Field> fields;
  double time;  // s
};

// Whether the picture has surfaces but no volumes, so that it belongs in a .vtp file.
[[nodiscard]] bool isSurface(const Picture& picture);
// Contents of a .vtp file: edges, triangles and quads; vertices where there is none of them.
[[nodiscard]] std::string polyData(const Picture& picture);
// Contents of a .vtu file: every kind of element; vertices where there is none.
[[nodiscard]] std::string unstructuredGrid(const Picture& picture);

struct Frame {
  double time;       // s
  std::string file;  // relative to the list
};
// Contents of a .pvd file.
[[nodiscard]] std::string collection(std::span<const Frame> frames);

}  // namespace stroma::vtk
