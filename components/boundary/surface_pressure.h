// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/boundary/surface_triangles.h"
#include "core/interfaces/force_field.h"

namespace stroma {

// Pressure on the triangles of a surface as they lie now (a follower load), such as the pressure
// inside an eye. As in SOFA a positive pressure pushes along the triangles' normals (b - a) x (c -
// a): it inflates a closed surface whose normals point outward. A fluid that presses on the outside
// of a body, such as the aqueous humour on the posterior face of a cornea that is a closed solid,
// has a negative one.
//
// Each node takes a third of p times the vector area of its triangles. On a closed surface that is
// exactly minus the gradient of the energy -p V, V the enclosed volume, and the derivative is
// symmetric. On an open one the energy is -p times the volume of the cone to the middle of the rim
// at rest. That is exact for all nodes but those on the rim, and for these, too, when they are
// held; the derivative is the symmetric part, as linear solvers need it.
//
// When the body is cut, pieces of loaded triangles are loaded; the walls of the incision are not.
// The cone of the energy keeps its apex (on a surface that was closed, the middle of its nodes), so
// that a cut does not change the energy.
class SurfacePressureForceField final : public ForceField {
 public:
  Attribute<double> pressure{this,
                             "pressure",
                             0.0,
                             "Pressure along the normals.",
                             {.unit = "Pa", .required = true, .runtime = true}};
  Attribute<double> rampTime{this,
                             "rampTime",
                             0.0,
                             "The pressure rises smoothly from zero at time 0 to its value at this "
                             "time; 0 = at once.",
                             {.unit = "s", .min = 0}};
  Attribute<std::vector<Triangle>> triangles{
      this, "triangles", {}, "Triangles acted on; the topology's if not given."};
  Attribute<IndexList> triangleIndices{
      this,
      "triangleIndices",
      {},
      "Numbers of the triangles that are acted on, of those above; "
      "all if not given.",
      {.aliases = "triangleList"}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Nodes of the surface.", Lookup::nearest, {.aliases = "mstate"}};
  Link<Topology> topology{
      this, "topology", "Where the triangles come from.", Lookup::nearest, {.required = false}};

  void bind() override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  void checkTopology(TopologyCheck& check) const override { surface_.check(*this, check); }
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView& at) override;
  void addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                         Vec3Span df) const override;
  [[nodiscard]] bool addPattern(BlockPattern& pattern, Index offset) const override;
  void addTangent(BlockMatrix& matrix, Index offset, double stiffness,
                  double damping) const override;

  [[nodiscard]] double pressureAt(double time) const;
  // Volume between the surface and its apex: the enclosed volume of a closed one.
  [[nodiscard]] double volume(ConstVec3Span x) const;

 private:
  void makeRoom();
  SurfaceTriangles surface_;
  Vec3 apex_ = Vec3::Zero();
  double linearPressure_ = 0;
  std::vector<Vec3> areaForce_;                // of each triangle, on each of its nodes
  std::vector<std::array<Vec3, 3>> opposite_;  // edges opposite to the corners when linearised
  mutable std::vector<Vec3> swept_, sum_;      // scratch of the product, for each triangle
};

}  // namespace stroma
