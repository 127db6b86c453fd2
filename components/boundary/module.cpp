// SPDX-License-Identifier: Apache-2.0
#include "components/boundary/constant_force_field.h"
#include "components/boundary/fixed_constraints.h"
#include "components/boundary/grip_force_field.h"
#include "components/boundary/rest_shape_springs.h"
#include "components/boundary/surface_pressure.h"
#include "components/boundary/traction_force_field.h"
#include "components/boundary/velocity_damping.h"
#include "core/plugin.h"

PLUGIN(boundary, "0.1.0", "Apache-2.0", "Supports and loads.")
(stroma::Registry& registry) {
  using namespace stroma;
  registry.add<FixedProjectiveConstraint>("FixedProjectiveConstraint")
      .doc("Holds particles where they are.")
      .domain("Exact: held particles keep the bits of their positions. Verified by unit tests.")
      .example("scenes/cornea/pull.xml");
  registry.add<PartialFixedProjectiveConstraint>("PartialFixedProjectiveConstraint")
      .doc("Holds particles along chosen coordinate axes.")
      .domain("Exact along the axes. Verified by unit tests.")
      .example("scenes/tutorials/stretch_block.xml");
  registry.add<FixedPlaneProjectiveConstraint>("FixedPlaneProjectiveConstraint")
      .doc("Keeps particles in their plane across a direction; they may slide in it.")
      .domain("Exact up to rounding for directions off the axes. Verified by unit tests.")
      .example("scenes/tutorials/stretch_block.xml");
  registry.add<RestShapeSpringsForceField>("RestShapeSpringsForceField")
      .doc("Springs between particles and their rest positions: an elastic support.")
      .domain("Linear springs without rotation. Force and derivative verified against the energy.")
      .example("scenes/tutorials/elastic_support.xml");
  registry.add<ConstantForceField>("ConstantForceField")
      .doc("Constant forces on particles.")
      .domain("Dead loads. Force verified against the energy.")
      .example("scenes/tutorials/elastic_support.xml");
  registry.add<SurfacePressureForceField>("SurfacePressureForceField")
      .doc("Pressure on the current triangles of a surface; positive pushes along their normals.")
      .domain(
          "Any deformation. Exact gradient of -p V on closed surfaces and on open ones whose rim "
          "is "
          "held; on a moving rim the derivative is the symmetric part. Verified by differences.")
      .example("scenes/cornea/inflate.xml");
  registry.add<TractionForceField>("TractionForceField")
      .doc("Force per rest area on the triangles of a surface, or the load of a uniform stress.")
      .domain(
          "Dead loads. The total force and moment of a uniform stress vanish on closed surfaces.")
      .example("scenes/tutorials/stretch_block.xml");
  registry.add<GripForceField>("GripForceField")
      .doc("Pulls nodes by springs along a path given by key times and displacements.")
      .domain("Linear springs to moving points. Force and derivative verified against the energy.")
      .example("scenes/cornea/pull.xml");
  registry.add<UniformVelocityDampingForceField>("UniformVelocityDampingForceField")
      .doc("A force against the velocity of every particle.")
      .domain("Linear drag. Verified against its derivative.")
      .example("scenes/tutorials/elastic_support.xml");
}
