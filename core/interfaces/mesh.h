// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/component.h"
#include "core/types.h"

namespace stroma {

// Points and the elements between them. Spans are valid from bind() on, those of a mesh that follows
// cuts until the next topologyChanged() or topologyRestored().
class Mesh : public Component {
 public:
  static constexpr std::string_view role = "Mesh";

  [[nodiscard]] virtual ConstVec3Span positions() const = 0;
  [[nodiscard]] virtual std::span<const Edge> edges() const { return {}; }
  [[nodiscard]] virtual std::span<const Triangle> triangles() const { return {}; }
  [[nodiscard]] virtual std::span<const Quad> quads() const { return {}; }
  [[nodiscard]] virtual std::span<const Tetrahedron> tetrahedra() const { return {}; }
  [[nodiscard]] virtual std::span<const Hexahedron> hexahedra() const { return {}; }
  // Of each point, where the mesh has them: (u, v, 0).
  [[nodiscard]] virtual ConstVec3Span textureCoordinates() const { return {}; }
};

// A triangle surface somebody else owns.
struct SurfaceView {
  ConstVec3Span positions;
  std::span<const Triangle> triangles;
};

// The mesh of a node: its state takes positions from here, its force fields elements. A loader is
// only a Mesh (several may be in one node); a topology is the node's own.
class Topology : public Mesh {
 public:
  static constexpr std::string_view role = "Topology";

  // Whether its triangles change with a cut (topologyChanged).
  [[nodiscard]] virtual bool followsCuts() const { return false; }
  // Another number whenever points or triangles have changed.
  [[nodiscard]] virtual std::uint64_t revision() const { return 0; }
  // Of each triangle whether it is the side of an incision; empty where nothing has been cut.
  [[nodiscard]] virtual std::span<const char> incisionWalls() const { return {}; }
  // Volume that each point stands for (m^3), empty where it has no meaning.
  [[nodiscard]] virtual std::span<const double> volumes() const { return {}; }
  // Closed surface of the solid that the points fill, outward oriented; empty where there is none.
  [[nodiscard]] virtual SurfaceView enclosingSurface() const { return {}; }
};

}  // namespace stroma
