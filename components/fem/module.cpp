// SPDX-License-Identifier: Apache-2.0
#include "components/fem/fem_force_field.h"
#include "components/fem/hyperelastic_force_field.h"
#include "components/fem/mesh_spring_force_field.h"
#include "core/plugin.h"

PLUGIN(fem, "0.1.0", "Apache-2.0", "Finite elements and springs on meshes, to compare with.")
(stroma::Registry& registry) {
  registry.add<stroma::TetrahedronFemForceField>("TetrahedronFEMForceField")
      .doc("Linear elastic tetrahedra with a constant strain each.")
      .domain(
          "method=\"small\" is for small rotations only. Too stiff in bending on coarse meshes "
          "(half "
          "the deflection at two elements through the thickness) and nearly incompressible "
          "(locking "
          "above Poisson's ratio 0.45). Does not follow cuts.")
      .example("scenes/beam/tetrahedra.xml")
      .alias("TetrahedralCorotationalFEMForceField");
  registry
      .add<stroma::TetrahedronHyperelasticityForceField>("TetrahedronHyperelasticityFEMForceField")
      .doc("Hyperelastic tetrahedra with a constant strain each.")
      .domain(
          "StVenantKirchhoff loses stiffness in compression beyond 42 %, NeoHookean does not "
          "survive "
          "an inverted element, StableNeoHookean holds for any deformation. Too stiff on coarse "
          "meshes, as linear tetrahedra are. Does not follow cuts.")
      .example("scenes/beam/hyperelastic.xml");
  registry.add<stroma::HexahedronFemForceField>("HexahedronFEMForceField")
      .doc("Linear elastic hexahedra, trilinear with eight Gauss points.")
      .domain(
          "method=\"small\" is for small rotations only. Converges at second order; locks above "
          "Poisson's ratio 0.45. Does not follow cuts.")
      .example("scenes/beam/hexahedra.xml");
  registry.add<stroma::MeshSpringForceField>("MeshSpringForceField")
      .doc("Damped springs between the nodes of the elements of a topology.")
      .domain(
          "No material law: how stiff a body of springs is depends on its mesh, and its Poisson's "
          "ratio is not free (1/4 for many springs in all directions). Does not follow cuts.")
      .example("scenes/beam/springs.xml");
}
