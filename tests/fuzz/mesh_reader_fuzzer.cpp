// SPDX-License-Identifier: Apache-2.0
// Any bytes are either a mesh whose indices and groups hold, or a problem that is told. The first
// byte chooses the format.
#include <cstdint>
#include <cstdlib>

#include "components/io/mesh_check.h"
#include "components/io/mesh_file.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

template <class Element>
void requireIndices(const std::vector<Element>& elements, std::size_t points) {
  for (const Element& element : elements) {
    for (const stroma::Index i : element) require(i >= 0 && static_cast<std::size_t>(i) < points);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto format = static_cast<stroma::MeshFormat>(data[0] % 4);
  const bool triangulate = data[0] < 128;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const stroma::MeshData mesh = stroma::parseMesh(bytes, format, triangulate);
  if (!mesh.problems.empty()) return 0;
  const std::size_t points = mesh.positions.size();
  requireIndices(mesh.edges, points);
  requireIndices(mesh.triangles, points);
  requireIndices(mesh.quads, points);
  requireIndices(mesh.tetrahedra, points);
  require(mesh.normals.empty() || mesh.normals.size() == points);
  require(mesh.texcoords.empty() || mesh.texcoords.size() == points);
  for (const stroma::MeshGroup& group : mesh.groups) {
    for (const stroma::Index t : group.triangles) {
      require(t >= 0 && static_cast<std::size_t>(t) < mesh.triangles.size());
    }
  }
  (void)stroma::checkMesh(mesh);
  (void)stroma::sizeRemark(mesh.positions);
  return 0;
}
