// SPDX-License-Identifier: Apache-2.0
#include "components/io/mesh_exporter.h"
#include "components/io/mesh_group_roi.h"
#include "components/io/mesh_loader.h"
#include "components/io/monitor.h"
#include "components/io/vtk_exporter.h"
#include "core/plugin.h"

PLUGIN(io, "0.1.0", "Apache-2.0", "Mesh files, pictures for ParaView, tables.")
(stroma::Registry& registry) {
  using stroma::MeshFormat;
  const char* scene = "scenes/cornea/pull.xml";
  registry.add<stroma::MeshFileLoader<MeshFormat::obj>>("MeshOBJLoader")
      .doc("Reads a surface mesh and its groups from a Wavefront OBJ file.")
      .domain("Points keep the file's order, number and digits.")
      .example(scene);
  registry.add<stroma::MeshFileLoader<MeshFormat::stl>>("MeshSTLLoader")
      .doc("Reads a surface mesh from an STL file, text or binary.")
      .domain("Single precision; equal positions become one point.")
      .example("scenes/tutorials/elastic_support.xml");
  registry.add<stroma::MeshFileLoader<MeshFormat::ply>>("MeshPLYLoader")
      .doc("Reads a surface mesh from a PLY file, text or binary.")
      .domain("Single precision; points keep the file's order.")
      .example("scenes/tutorials/stretch_block.xml");
  registry.add<stroma::MeshFileLoader<MeshFormat::gmsh>>("MeshGmshLoader")
      .doc("Reads triangles and tetrahedra from a Gmsh file, format 2, ASCII.")
      .domain("Points keep the file's order, number and digits; tetrahedra are made positive.")
      .example("scenes/cornea/cut.xml");
  registry.add<stroma::MeshGroupRoi>("MeshGroupROI")
      .doc("Selects the points and triangles of named groups of a mesh file.")
      .example(scene);
  registry.add<stroma::VtkExporter>("VTKExporter")
      .doc("Writes a state as a time series that ParaView opens.")
      .example(scene);
  registry.add<stroma::MeshExporter>("MeshExporter")
      .doc("Writes the deformed surface as an OBJ, PLY or STL file.")
      .example("scenes/tutorials/stretch_block.xml");
  registry.add<stroma::Monitor>("Monitor")
      .doc("Records a quantity of chosen particles, or an attribute, as a CSV table.")
      .example(scene);
}
