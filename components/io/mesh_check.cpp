// SPDX-License-Identifier: Apache-2.0
#include "components/io/mesh_check.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace stroma {
namespace {

// Collects cases of one kind into a sentence: "... ; 3 in all".
class Cases {
 public:
  void add(std::string text) {
    if (count_++ == 0) first_ = std::move(text);
  }
  void report(bool unusable, const char* id, std::vector<MeshRemark>& remarks) const {
    if (count_ == 0) return;
    const std::string more = count_ > 1 ? "; " + std::to_string(count_) + " in all" : "";
    remarks.push_back({unusable, id, first_ + more});
  }

 private:
  int count_ = 0;
  std::string first_;
};

std::string text(const Triangle& t) {
  return std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]);
}

bool isDegenerate(const std::vector<Vec3>& x, const Triangle& t) {
  const Vec3 a = x[static_cast<std::size_t>(t[1])] - x[static_cast<std::size_t>(t[0])];
  const Vec3 b = x[static_cast<std::size_t>(t[2])] - x[static_cast<std::size_t>(t[0])];
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
  return !(a.cross(b).norm() > 2e-12 * longest);
}

void checkEdges(const MeshData& mesh, std::vector<MeshRemark>& remarks) {
  struct Uses {
    int forward = 0, backward = 0;
  };
  std::map<Edge, Uses> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      Uses& uses = edges[{std::min(a, b), std::max(a, b)}];
      ++(a < b ? uses.forward : uses.backward);
    }
  }
  Cases nonManifold, turned;
  for (const auto& [edge, uses] : edges) {
    const std::string name = "edge " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]);
    const int count = uses.forward + uses.backward;
    if (count > 2) {
      nonManifold.add(name + " has " + std::to_string(count) + " triangles (non-manifold)");
    } else if (uses.forward == 2 || uses.backward == 2) {
      turned.add("the two triangles of " + name + " face opposite ways");
    }
  }
  nonManifold.report(false, "mesh-nonmanifold", remarks);
  turned.report(false, "mesh-orientation", remarks);
}

}  // namespace

std::vector<MeshRemark> checkMesh(const MeshData& mesh) {
  std::vector<MeshRemark> remarks;
  if (mesh.positions.empty() || (mesh.triangles.empty() && mesh.quads.empty() &&
                                 mesh.edges.empty() && mesh.tetrahedra.empty())) {
    remarks.push_back({true, "mesh-empty",
                       "has " + std::to_string(mesh.positions.size()) + " points and no faces"});
    return remarks;
  }
  Cases infinite, degenerate, unused;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!mesh.positions[i].allFinite()) {
      infinite.add("point " + std::to_string(i) + " has a coordinate that is not finite");
    }
  }
  infinite.report(true, "mesh-coordinate", remarks);
  if (!remarks.empty()) return remarks;
  std::vector<bool> used(mesh.positions.size(), false);
  const auto use = [&](const auto& elements) {
    for (const auto& element : elements) {
      for (const Index i : element) used[static_cast<std::size_t>(i)] = true;
    }
  };
  use(mesh.edges);
  use(mesh.triangles);
  use(mesh.quads);
  use(mesh.tetrahedra);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!isDegenerate(mesh.positions, mesh.triangles[f])) continue;
    degenerate.add("triangle " + std::to_string(f) + " (points " + text(mesh.triangles[f]) +
                   ") has no area");
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) unused.add("point " + std::to_string(i) + " belongs to no face");
  }
  degenerate.report(false, "mesh-degenerate", remarks);
  checkEdges(mesh, remarks);
  unused.report(false, "mesh-unused", remarks);
  return remarks;
}

std::string sizeRemark(ConstVec3Span positions) {
  if (positions.empty()) return {};
  Vec3 low = positions.front(), high = low;
  for (const Vec3& x : positions) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double size = (high - low).maxCoeff();
  if (size <= 10 && size >= 1e-5) return {};
  std::ostringstream out;
  out << "is " << size << " m large, which is no tissue's size";
  return out.str();
}

}  // namespace stroma
