// SPDX-License-Identifier: Apache-2.0
// A square of two triangles on four particles, and a cut through it that is written out by hand.
#pragma once

#include "core/interfaces/mapping.h"
#include "core/interfaces/mesh.h"
#include "core/link.h"
#include "core/scene.h"
#include "core/topology_change.h"
#include "core/triangle.h"

namespace stroma::test {

// Surface nodes that ride on the particles of the same number; new nodes follow a cut.
class Riding final : public Mapping {
 public:
  Link<MechanicalState> from{this, "input", "Particles.", Lookup::parent};
  Link<MechanicalState> to{this, "output", "Nodes.", Lookup::sameNode};
  [[nodiscard]] MechanicalState& input() const override { return *from; }
  [[nodiscard]] MechanicalState& output() const override { return *to; }
  void bind() override { topologyRestored(); }
  void apply(ConstVec3Span in, Vec3Span out) const override {
    for (std::size_t i = 0; i < rows_.size(); ++i) out[i] = along(rows_[i], in) + rows_[i].shift;
  }
  void applyJ(ConstVec3Span in, Vec3Span out) const override {
    for (std::size_t i = 0; i < rows_.size(); ++i) out[i] = along(rows_[i], in);
  }
  void addTransposed(ConstVec3Span out, Vec3Span in) const override {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      in[rows_[i].a] += (1 - rows_[i].weight) * out[i];
      in[rows_[i].b] += rows_[i].weight * out[i];
    }
  }
  void topologyChanged(const TopologyChange& change) override {
    if (&change.nodes != to.get()) return;
    for (const NewSurfaceNode& node : change.edit.nodes) {
      Row row;
      if (node.copyOf >= 0) {
        row = rows_[static_cast<std::size_t>(node.copyOf)];
      } else if (node.parents[0] >= 0) {
        row = {static_cast<std::size_t>(node.parents[0]), static_cast<std::size_t>(node.parents[1]),
               node.weight, Vec3::Zero()};
      } else {
        row.shift = node.rest - from->rest()[0];
      }
      rows_.push_back(row);
    }
    apply(from->x(), to->x());
    applyJ(from->v(), to->v());
  }
  void topologyRestored() override {
    rows_.resize(static_cast<std::size_t>(to->size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i] = {i, i, 0, Vec3::Zero()};
  }

 private:
  struct Row {
    std::size_t a = 0, b = 0;
    double weight = 0;
    Vec3 shift = Vec3::Zero();
  };
  static Vec3 along(const Row& row, ConstVec3Span in) {
    return (1 - row.weight) * in[row.a] + row.weight * in[row.b];
  }
  std::vector<Row> rows_;
};

inline const std::string squarePoints = "0 0 0  1 0 0  1 1 0  0 1 0";
inline const std::string squareTriangles = "0 1 2  0 2 3";

// Particles and the surface on them; `content` stands beside the surface's nodes.
inline std::string squareScene(const std::string& content, const std::string& beside = "") {
  return "<EulerImplicitSolver/><CGLinearSolver/><MechanicalObject name='particles' position='" +
         squarePoints + "'/><UniformMass vertexMass='1'/>" + beside +
         "<Node name='surface'><MeshTopology name='mesh' position='" + squarePoints +
         "' triangles='" + squareTriangles +
         "'/><MechanicalObject name='nodes'/><Riding name='mapping'/>" + content + "</Node>";
}

// From node 3 straight to the middle of edge 0-1. Each triangle keeps its slot on the side of
// node 0; the other side gets a piece of each and, of the first one, a piece of that piece. Node 3
// is separated into 3 and 8; two walls reach down to a node inside.
inline SurfaceEdit squareCut() {
  SurfaceEdit edit;
  edit.firstNewNode = 4;
  edit.firstNewTriangle = 2;
  const Vec3 onDiagonal(1.0 / 3, 1.0 / 3, 0), onSide(0.5, 0, 0);
  edit.nodes = {{onDiagonal, -1, {0, 2}, 1.0 / 3},     // 4
                {onSide, -1, {0, 1}, 0.5},             // 5
                {onDiagonal, 4, {-1, -1}, 0},          // 6
                {onSide, 5, {-1, -1}, 0},              // 7
                {{0, 1, 0}, 3, {-1, -1}, 0},           // 8
                {{0.3, 0.3, -0.5}, -1, {-1, -1}, 0}};  // 9
  edit.changed = {{0, {0, 5, 4}}, {1, {0, 4, 3}}};
  edit.appended = {{{7, 1, 2}, 0, false},
                   {{7, 2, 6}, 2, false},
                   {{6, 2, 8}, 1, false},
                   {{4, 5, 9}, -1, true},
                   {{7, 6, 9}, -1, true}};
  return edit;
}

inline const std::vector<Triangle> cutTriangles = {{0, 5, 4}, {0, 4, 3}, {7, 1, 2}, {7, 2, 6},
                                                   {6, 2, 8}, {4, 5, 9}, {7, 6, 9}};

class NoBarrier final : public CutBarrier {
 public:
  void block(const Vec3&, ConstVec3Span, std::span<char> blocked) const override {
    std::ranges::fill(blocked, char{0});
  }
};

template <class T>
T& named(Scene& scene, const std::string& name) {
  T* found = nullptr;
  const auto look = [&](auto&& self, Node& node) -> void {
    for (const auto& c : node.components()) {
      if (c->name() == name) found = dynamic_cast<T*>(c.get());
    }
    for (const auto& child : node.children()) self(self, *child);
  };
  look(look, scene.root());
  return *found;
}

// The whole scene follows.
inline void cutSquare(Scene& scene, const SurfaceEdit& edit = squareCut()) {
  scene.changeTopology({named<MechanicalState>(scene, "particles"),
                        named<MechanicalState>(scene, "nodes"), named<Topology>(scene, "mesh"),
                        edit, NoBarrier()});
}

// What the components find wrong then.
inline std::vector<std::string> topologyFailures(Scene& scene) {
  const NoBarrier barrier;
  TopologyCheck check{named<MechanicalState>(scene, "particles"),
                      named<MechanicalState>(scene, "nodes"),
                      named<Topology>(scene, "mesh"),
                      barrier,
                      0,
                      {}};
  scene.checkTopology(check);
  return check.failures;
}

}  // namespace stroma::test
