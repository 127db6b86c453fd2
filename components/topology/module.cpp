// SPDX-License-Identifier: Apache-2.0
#include "components/topology/mesh_topology.h"
#include "components/topology/region_of_interest.h"
#include "components/topology/regular_grid_topology.h"
#include "core/plugin.h"

PLUGIN(topology, "0.1.0", "Apache-2.0", "Meshes, grids and selections.")
(stroma::Registry& registry) {
  registry.add<stroma::MeshTopology>("MeshTopology")
      .doc("Points and elements of a node, given in the scene or by a loader.")
      .example("scenes/cornea/pull.xml")
      .alias("PointSetTopologyContainer")
      .alias("EdgeSetTopologyContainer")
      .alias("TriangleSetTopologyContainer")
      .alias("QuadSetTopologyContainer")
      .alias("TetrahedronSetTopologyContainer")
      .alias("HexahedronSetTopologyContainer");
  registry.add<stroma::RegularGridTopology>("RegularGridTopology")
      .doc("A box of regularly spaced points with the cells between them.")
      .domain("Volumes add up to the box's to rounding; the surface is closed and faces outwards.")
      .example("scenes/beam/fixbeam_E10000.xml");
  registry.add<stroma::BoxRoi>("BoxROI")
      .doc("Selects points and elements by boxes.")
      .example("scenes/tutorials/elastic_support.xml");
  registry.add<stroma::SphereRoi>("SphereROI")
      .doc("Selects points and elements by balls.")
      .example("scenes/cornea/pull.xml");
}
