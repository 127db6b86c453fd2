// SPDX-License-Identifier: Apache-2.0
// stroma-mesh: writes the meshes that the scenes use. Exit codes: 0 written, 1 usage, 4 file
// trouble.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tools/mesh_maker/cornea.h"
#include "tools/mesh_maker/organs.h"
#ifdef STROMA_NGLIB
#include "tools/mesh_maker/tetrahedra.h"
#endif

namespace {

using stroma::meshes::GroupedMesh;

bool write(const GroupedMesh& mesh, const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  stroma::meshes::writeObj(mesh, file);
  file.close();
  if (file) return true;
  std::cerr << "stroma-mesh: cannot write " << path.string() << '\n';
  return false;
}

#ifdef STROMA_NGLIB
bool writeFilled(const std::filesystem::path& surface, const std::filesystem::path& path,
                 double size) {
  try {
    const stroma::meshes::TetrahedralMesh mesh = stroma::meshes::fillSurface(surface, size);
    std::ofstream file(path, std::ios::binary);
    stroma::meshes::writeMsh(mesh, file);
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path.string());
    std::cout << mesh.positions.size() << " nodes, " << mesh.surface.size() << " triangles, "
              << mesh.tetrahedra.size() << " tetrahedra, smallest dihedral angle "
              << mesh.smallestDihedral << " degrees\n";
    return true;
  } catch (const std::exception& e) {
    std::cerr << "stroma-mesh: " << e.what() << '\n';
    return false;
  }
}
#endif

}  // namespace

int main(int argc, char** argv) {
  constexpr int usage = 1, fileTrouble = 4;
  constexpr int shellRings = 12, capRings = 16;
  CLI::App app{
      "Makes the meshes of Stroma's scenes: Wavefront OBJ, metres, the same bytes every time",
      "stroma-mesh"};
  app.require_subcommand(1);

  struct Job {
    std::string name, help, file;
    int rings;  // 0: the mesh has one resolution
    GroupedMesh (*make)(int rings);
  };
  std::vector<Job> jobs = {
      {"cornea-sheet", "anterior surface of a cornea, 192 nodes, 350 triangles", "cornea_sheet.obj",
       0, [](int) { return stroma::meshes::corneaSheet(); }},
      {"cornea-shell", "closed cornea, 0.58 to 0.64 mm thick", "cornea_shell.obj", shellRings,
       stroma::meshes::corneaShell},
      {"cornea-cap", "closed circular cap, uniformly 0.58 mm thick", "cornea_cap.obj", capRings,
       stroma::meshes::corneaCap},
      {"liver", "closed surface of a liver, 502 nodes, 1000 triangles", "liver.obj", 0,
       [](int) { return stroma::meshes::liver(); }},
      {"stomach", "surface of a stomach with two openings, 512 nodes, 991 triangles", "stomach.obj",
       0, [](int) { return stroma::meshes::stomach(); }}};

  std::string out;
  for (Job& job : jobs) {
    CLI::App* command = app.add_subcommand(job.name, "Write the " + job.help);
    command->add_option("--out", out, "file to write")->default_str(job.file);
    if (job.rings > 0)
      command->add_option("--rings", job.rings, "rings of triangles from apex to rim")
          ->check(CLI::Range(2, 400))
          ->capture_default_str();
  }
  CLI::App* all = app.add_subcommand("all", "Write all of them into a folder");
  all->add_option("--out", out, "folder, made if it does not exist")->default_str("scenes/meshes");
#ifdef STROMA_NGLIB
  std::string surface, filled;
  double size = 0;
  CLI::App* tetrahedra =
      app.add_subcommand("tetrahedra", "Fill a surface with tetrahedra, Gmsh 2.2 ASCII; open rims get lids");
  tetrahedra->add_option("surface", surface, "Wavefront OBJ of triangles")->required();
  tetrahedra->add_option("out", filled, "file to write, .msh")->required();
  tetrahedra
      ->add_option("--size", size,
                   "largest edge inside, in mean edges of the surface; 0: netgen's choice")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
#endif

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : usage;
  }

#ifdef STROMA_NGLIB
  if (tetrahedra->parsed()) return writeFilled(surface, filled, size) ? 0 : fileTrouble;
#endif
  if (all->parsed()) {
    const std::filesystem::path folder = out.empty() ? "scenes/meshes" : out;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    for (const Job& job : jobs)
      if (!write(job.make(job.rings), folder / job.file)) return fileTrouble;
    return 0;
  }
  for (const Job& job : jobs)
    if (app.got_subcommand(job.name) && !write(job.make(job.rings), out.empty() ? job.file : out))
      return fileTrouble;
  return 0;
}
