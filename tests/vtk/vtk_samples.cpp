// SPDX-License-Identifier: Apache-2.0
// Writes a short series of particles, of a surface and of a volume into a folder.
#include <filesystem>
#include <fstream>

#include "components/io/vtk_xml.h"

namespace {

using stroma::Vec3;

void writeSeries(const std::filesystem::path& folder, const std::string& name,
                 stroma::vtk::Picture picture) {
  std::vector<stroma::vtk::Frame> frames;
  const bool surface = stroma::vtk::isSurface(picture);
  for (const double time : {0.0, 0.25}) {
    picture.time = time;
    const std::string file = name + (time > 0 ? "_1" : "_0") + (surface ? ".vtp" : ".vtu");
    std::ofstream(folder / file, std::ios::binary)
        << (surface ? stroma::vtk::polyData(picture) : stroma::vtk::unstructuredGrid(picture));
    frames.push_back({time, file});
  }
  std::ofstream(folder / (name + ".pvd")) << stroma::vtk::collection(frames);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 1;
  std::vector<Vec3> points;
  for (const double z : {0.0, 1.0}) {
    points.insert(points.end(), {Vec3(0, 0, z), Vec3(1, 0, z), Vec3(1, 1, z), Vec3(0, 1, z)});
  }
  const std::vector<stroma::Triangle> triangles{{0, 1, 2}, {4, 6, 5}};
  const std::vector<stroma::Quad> quads{{0, 1, 5, 4}};
  const std::vector<stroma::Hexahedron> hexahedra{{0, 1, 2, 3, 4, 5, 6, 7}};
  stroma::vtk::Picture particles{};
  particles.points = points;
  particles.fields = {{"velocity", 3, std::vector<double>(24, 0.5)},
                      {"heat", 1, {0, 1, 2, 3, 4, 5, 6, 7}}};
  stroma::vtk::Picture surface = particles, volume = particles;
  surface.triangles = triangles;
  surface.quads = quads;
  volume.hexahedra = hexahedra;
  writeSeries(arguments[1], "particles", particles);
  writeSeries(arguments[1], "surface", surface);
  writeSeries(arguments[1], "volume", volume);
  return 0;
}
