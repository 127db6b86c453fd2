// SPDX-License-Identifier: Apache-2.0
// Supports that hold particles wholly, in chosen axes, or in a plane. All of them project
// increments of velocity and position; a solver also removes what the initial velocities have along
// held directions.
#pragma once

#include "core/interfaces/projective_constraint.h"

namespace stroma {

// Holds particles where they are. Unlike in SOFA, where particle 0 is held when nothing is said,
// `indices` or `fixAll` must be given.
class FixedProjectiveConstraint final : public ProjectiveConstraint {
 public:
  Attribute<IndexList> indices{
      this, "indices", {}, "Particles that are held.", {.aliases = "points"}};
  Attribute<bool> fixAll{this, "fixAll", false, "Holds every particle of the state."};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles acted on.", Lookup::nearest, {.aliases = "mstate"}};

  void configure() override;
  void bind() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addProjectors(std::vector<ParticleProjector>& projectors) const override;

 private:
  std::vector<Index> held_;
};

// Holds particles along chosen coordinate axes only.
class PartialFixedProjectiveConstraint final : public ProjectiveConstraint {
 public:
  Attribute<IndexList> indices{
      this, "indices", {}, "Particles that are held.", {.aliases = "points"}};
  Attribute<bool> fixAll{this, "fixAll", false, "Holds every particle of the state."};
  Attribute<std::vector<int>> fixedDirections{this,
                                              "fixedDirections",
                                              {1, 1, 1},
                                              "For x, y and z: 1 holds it, 0 leaves it free.",
                                              {.min = 0, .max = 1}};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles acted on.", Lookup::nearest, {.aliases = "mstate"}};

  void configure() override;
  void bind() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addProjectors(std::vector<ParticleProjector>& projectors) const override;

 private:
  std::vector<Index> held_;
};

// Keeps particles in their plane across `direction`: they may slide in it, not leave it. The
// particles are `indices`, or all whose rest position has dmin <= X . direction / |direction| <=
// dmax.
class FixedPlaneProjectiveConstraint final : public ProjectiveConstraint {
 public:
  Attribute<Vec3> direction{
      this, "direction", Vec3::Zero(), "Normal of the plane, of any length.", {.required = true}};
  Attribute<double> dmin{
      this, "dmin", 0.0, "Lowest coordinate along the direction.", {.unit = "m"}};
  Attribute<double> dmax{
      this, "dmax", 0.0, "Highest coordinate along the direction.", {.unit = "m"}};
  Attribute<IndexList> indices{this,
                               "indices",
                               {},
                               "Particles that are kept in their plane, "
                               "instead of those between dmin and dmax."};
  Link<MechanicalState> mechanicalState{
      this, "state", "Particles acted on.", Lookup::nearest, {.aliases = "mstate"}};

  void configure() override;
  void bind() override;
  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addProjectors(std::vector<ParticleProjector>& projectors) const override;

 private:
  std::vector<Index> held_;
};

}  // namespace stroma
