// SPDX-License-Identifier: Apache-2.0
#include "components/io/mesh_loader.h"

#include "components/io/mesh_subdivision.h"
#include "core/rigid_motion.h"
#include "core/scene.h"

namespace stroma {

void MeshLoader::transform(MeshData& mesh) const {
  const Mat3 turn = fromEuler(rotation).toRotationMatrix();
  const Vec3 stretch = *scale * *scale3d;
  for (Vec3& x : mesh.positions) x = turn * stretch.cwiseProduct(x) + *translation;
  for (Vec3& n : mesh.normals) n = (turn * n.cwiseQuotient(stretch)).normalized();
  // a reflection turns the faces over: turn them back
  if (*flipNormals == (stretch.prod() > 0)) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    for (Quad& q : mesh.quads) std::swap(q[1], q[3]);
  }
  if (stretch.prod() < 0) {
    for (Tetrahedron& t : mesh.tetrahedra) std::swap(t[2], t[3]);
  }
  if (flipNormals) {
    for (Vec3& n : mesh.normals) n = -n;
  }
}

void MeshLoader::bind() {
  if (scale3d->cwiseAbs().minCoeff() == 0) {
    error(scale3d, "value-range", "has a zero: the mesh would be flat");
    return;
  }
  const auto file = scene().findInput(*this, filename);
  if (!file) return;
  MeshData mesh = readMesh(*file, format_, triangulate);
  for (const MeshProblem& problem : mesh.problems) {
    const std::string line = problem.line > 0 ? ":" + std::to_string(problem.line) : "";
    error(filename, "mesh-read",
          "cannot be used: " + file->string() + line + ": " + problem.message);
  }
  if (failed()) return;
  for (MeshRemark& remark : checkMesh(mesh)) {
    remark.message.insert(0, file->string() + ": ");
    if (remark.unusable) {
      error(filename, remark.id, "cannot be used: " + remark.message);
    } else {
      blemishes_.push_back(std::move(remark));
    }
  }
  if (subdivisions > 0 && !mesh.quads.empty()) {
    error(subdivisions, "attr-conflict", "needs triangles, and the mesh has quads",
          "leave triangulate at true");
  }
  if (subdivisions > 0 && !mesh.tetrahedra.empty()) {
    error(subdivisions, "attr-conflict",
          "splits triangles, and the mesh has tetrahedra behind them", "write a finer mesh file");
  }
  if (failed()) return;
  transform(mesh);
  for (int level = 0; level < subdivisions; ++level) subdivide(mesh);
  const std::string size = sizeRemark(mesh.positions);
  if (!size.empty()) {
    warning("mesh-size", file->string() + ": " + size,
            "positions are metres; scale=\"0.001\" reads a mesh in millimetres");
  }
  publish(std::move(mesh));
}

void MeshLoader::start() {
  for (const MeshRemark& blemish : blemishes_) warning(blemish.id, blemish.message);
}

void MeshLoader::publish(MeshData mesh) {
  groups_ = std::move(mesh.groups);
  std::vector<std::string> names;
  for (const MeshGroup& group : groups_) names.push_back(group.name);
  groupNames.set(std::move(names));
  position.set(std::move(mesh.positions));
  edgeList.set(std::move(mesh.edges));
  triangleList.set(std::move(mesh.triangles));
  quadList.set(std::move(mesh.quads));
  tetrahedronList.set(std::move(mesh.tetrahedra));
  normals.set(std::move(mesh.normals));
  texcoords.set(std::move(mesh.texcoords));
}

}  // namespace stroma
