// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/io/recorder.h"
#include "components/io/surface_file.h"
#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"

namespace stroma {

template <>
struct EnumNames<SurfaceFormat> {
  static constexpr std::array<std::pair<SurfaceFormat, std::string_view>, 3> names{
      {{SurfaceFormat::obj, "obj"}, {SurfaceFormat::ply, "ply"}, {SurfaceFormat::stl, "stl"}}};
};

// Writes the deformed surface as a mesh file. While the scene runs files are numbered by their
// step, <filename>_000100.obj; what is written at the end is <filename>.obj. Of a body that has
// been cut the triangles are those of now; nodes that have none stay as points.
class MeshExporter final : public Recorder {
 public:
  Attribute<SurfaceFormat> format{this, "format", SurfaceFormat::obj, "Kind of file."};
  Link<MechanicalState> mechanicalState{
      this, "state", "Positions.", Lookup::sameNode, {.aliases = "mstate"}};
  Link<Topology> topology{this, "topology", "Triangles.", Lookup::sameNode, {.required = false}};
  Link<Mesh> mesh{this,
                  "mesh",
                  "Triangles, from a mesh that is not the node's topology.",
                  Lookup::explicitOnly,
                  {.required = false}};

  void bind() override;
  void topologyChanged(const TopologyChange& change) override;
  void reset() override;
  void stop() override;

 protected:
  void record(double time, std::uint64_t step) override;

 private:
  const Mesh* elements_ = nullptr;
  bool ended_ = false;
};

}  // namespace stroma
