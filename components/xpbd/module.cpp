// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/xpbd_distance_constraint.h"
#include "components/xpbd/xpbd_solver.h"
#include "components/xpbd/xpbd_tetrahedron_constraint.h"
#include "core/plugin.h"

PLUGIN(xpbd, "0.1.0", "Apache-2.0", "Extended position based dynamics, to compare with.")
(stroma::Registry& registry) {
  using namespace stroma;
  registry.add<XpbdSolver>("XPBDSolver")
      .doc("Extended position based dynamics: a prediction, then sweeps over constraints.")
      .domain(
          "Does not blow up by what its constraints do, but how stiff a body is depends on the "
          "sub-steps: what its moduli say only where they are about as short as an explicit "
          "solver's; longer ones make it softer, then let it shake. First order and damping in "
          "time. Verified against the minimum of the energy and the damped oscillator.")
      .example("scenes/beam/xpbd.xml");
  registry.add<XpbdTetrahedronConstraint>("XPBDTetrahedronConstraint")
      .doc("Stable neo-Hookean tetrahedra as two constraints each, for XPBDSolver.")
      .domain(
          "Any deformation, inverted elements included. Too stiff on coarse meshes, as linear "
          "tetrahedra are, and softer than its moduli with too few sub-steps. Does not follow "
          "cuts.")
      .example("scenes/beam/xpbd.xml");
  registry.add<XpbdVolumeConstraint>("XPBDVolumeConstraint")
      .doc("Keeps the volume of each tetrahedron, for XPBDSolver.")
      .domain(
          "Resists changes of volume only, not of shape; how much depends on the sub-steps. Does "
          "not "
          "follow cuts.")
      .example("scenes/beam/xpbd_springs.xml");
  registry.add<XpbdDistanceConstraint>("XPBDDistanceConstraint")
      .doc("Keeps the distances between the nodes of an element, as springs do, for XPBDSolver.")
      .domain(
          "No material law: how stiff a body of edges is depends on its mesh. Verified on a mass "
          "on a spring. Does not follow cuts.")
      .example("scenes/beam/xpbd_springs.xml");
}
