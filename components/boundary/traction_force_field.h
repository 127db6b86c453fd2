// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "components/boundary/surface_triangles.h"
#include "core/interfaces/force_field.h"

namespace stroma {

// Force per area of the surface at rest (a dead load: it keeps its size and direction). Either one
// `traction` for all triangles, or traction = `stress` N with N the triangle's outward normal at
// rest and `stress` the first Piola-Kirchhoff stress, given as xx yy zz xy yz zx; on the whole
// surface of a body this is the load of a uniform stress, or with `stressGradient` of one that
// varies linearly, as in bending. Each node of a triangle gets the integral of the traction times
// its linear shape function. When the body is cut, pieces of loaded triangles carry the load of
// their own areas; the walls of the incision carry none.
class TractionForceField final : public ForceField {
 public:
  Attribute<Vec3> traction{this,
                           "traction",
                           Vec3::Zero(),
                           "Force per area.",
                           {.unit = "Pa", .aliases = "surfaceTraction"}};
  Attribute<std::vector<double>> stress{
      this,
      "stress",
      {},
      "Symmetric stress xx yy zz xy yz zx, instead of a traction.",
      {.unit = "Pa"}};
  Attribute<std::vector<double>> stressGradient{
      this,
      "stressGradient",
      {},
      "Derivatives of the stress along x, y and z, six numbers each.",
      {.unit = "Pa/m"}};
  Attribute<Vec3> stressOrigin{this,
                               "stressOrigin",
                               Vec3::Zero(),
                               "Where a stress that varies has the value `stress`.",
                               {.unit = "m"}};
  Attribute<double> rampTime{this,
                             "rampTime",
                             0.0,
                             "The load rises smoothly from zero at time 0 to its value at this "
                             "time; 0 = at once.",
                             {.unit = "s", .min = 0}};
  Attribute<double> scale{this, "scale", 1.0, "Factor of the load.", {.runtime = true}};
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

  void configure() override;
  void bind() override;
  void topologyChanged(const TopologyChange& change) override;
  void topologyRestored() override;
  void checkTopology(TopologyCheck& check) const override { surface_.check(*this, check); }
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override;
  [[nodiscard]] double potentialEnergy(const StateView& at) const override;
  void linearize(const StateView&) override {}
  void addTangentProduct(ConstVec3Span, double, double, Vec3Span) const override {}
  [[nodiscard]] bool addPattern(BlockPattern&, Index) const override { return true; }

 private:
  [[nodiscard]] double factorAt(double time) const;
  // Full force on nodes()[place] of the surface.
  [[nodiscard]] Vec3 fullForce(Index place) const;
  void computeForces();
  SurfaceTriangles surface_;
  // Traction at a place on a surface with this outward unit normal.
  [[nodiscard]] Vec3 tractionAt(const Vec3& X, const Vec3& normal) const;
  Mat3 tensor_ = Mat3::Zero();   // the stress
  std::array<Mat3, 3> slope_{};  // its derivatives
  std::vector<Vec3> force_;      // full force on each loaded node
};

}  // namespace stroma
