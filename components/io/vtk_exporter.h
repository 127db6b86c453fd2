// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/io/recorder.h"
#include "components/io/vtk_xml.h"
#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"

namespace stroma {

enum class PointField { displacement, position, velocity, force };

template <>
struct EnumNames<PointField> {
  static constexpr std::array<std::pair<PointField, std::string_view>, 4> names{
      {{PointField::displacement, "displacement"},
       {PointField::position, "position"},
       {PointField::velocity, "velocity"},
       {PointField::force, "force"}}};
};

// Writes a state as a series of files for ParaView and the like: <filename>_<step>.vtp for
// surfaces, .vtu for particles and volumes, and <filename>.pvd, which lists them with their times
// and is valid after every step. Coordinates are metres. Each point has the named fields of the
// state (m, m/s, N) and any attribute of the right size of any component.
//
// Of a body that has been cut the triangles are those of now; points that have none stay. An
// attribute that has no value for the new points is left out from then on, with a warning.
class VtkExporter final : public Recorder {
 public:
  Attribute<std::vector<std::string>> fields{
      this,
      "fields",
      {"displacement", "velocity"},
      "Fields of the state: displacement (from the rest positions), position, velocity, force."};
  Attribute<std::vector<std::string>> pointsDataFields{
      this,
      "pointsDataFields",
      {},
      "More fields: attributes with a number or three for every point, as component.attribute or "
      "name=component.attribute, with paths as in links."};
  Attribute<bool> showEdges{this, "edges", false, "Writes edges."};
  Attribute<bool> showTriangles{this, "triangles", true, "Writes triangles and quads."};
  Attribute<bool> showTetrahedra{
      this, "tetrahedra", true, "Writes tetrahedra.", {.aliases = "tetras"}};
  Attribute<bool> showHexahedra{this, "hexahedra", true, "Writes hexahedra.", {.aliases = "hexas"}};
  Link<MechanicalState> mechanicalState{
      this, "state", "What is written.", Lookup::sameNode, {.aliases = "mstate"}};
  Link<Topology> topology{this, "topology", "Its elements.", Lookup::sameNode, {.required = false}};
  Link<Mesh> mesh{this,
                  "mesh",
                  "Its elements, from a mesh that is not the node's topology.",
                  Lookup::explicitOnly,
                  {.required = false}};

  void bind() override;
  void start() override;
  void topologyChanged(const TopologyChange& change) override;
  void reset() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

 protected:
  void record(double time, std::uint64_t step) override;

 private:
  struct Source {
    std::string name;
    const AttributeBase* attribute;
    bool missed = false;  // a warning has said that it is left out
  };
  void addSource(const std::string& text);
  void checkElements();
  void addStateField(PointField field, vtk::Picture& picture) const;
  void addAttributeField(Source& source, vtk::Picture& picture);
  void addElements(vtk::Picture& picture) const;
  [[nodiscard]] vtk::Picture picture(double time);

  const Mesh* elements_ = nullptr;
  std::vector<PointField> stateFields_;
  std::vector<Source> sources_;
  std::vector<double> times_;
  std::vector<std::uint64_t> steps_;
  bool surface_ = false;  // a series keeps its kind of file
};

}  // namespace stroma
