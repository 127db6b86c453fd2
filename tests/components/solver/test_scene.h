// SPDX-License-Identifier: Apache-2.0
// Scenes made from text with the components of this topic and some force fields that are good to
// test with.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "components/boundary/constant_force_field.h"
#include "components/boundary/fixed_constraints.h"
#include "components/boundary/rest_shape_springs.h"
#include "components/boundary/velocity_damping.h"
#include "components/mass/uniform_mass.h"
#include "components/solver/cg_linear_solver.h"
#include "components/solver/euler_explicit_solver.h"
#include "components/solver/euler_implicit_solver.h"
#include "components/solver/sparse_ldl_solver.h"
#include "components/solver/static_solver.h"
#include "components/state/mechanical_object.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma::test {

// Each particle on a spring to its rest position that stiffens: f = -(k + c |u|^2) u, u = x - X.
class StiffeningSprings final : public ForceField {
 public:
  Attribute<double> k{this, "k", 0.0, "Stiffness.", {.runtime = true}};
  Attribute<double> c{this, "c", 0.0, "Cubic stiffness."};
  Link<MechanicalState> mechanicalState{this, "state", "Particles.", Lookup::nearest};

  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override {
    for (std::size_t i = 0; i < f.size(); ++i) {
      const Vec3 u = at.x[i] - state().rest()[i];
      f[i] -= (k + c * u.squaredNorm()) * u;
    }
  }
  [[nodiscard]] double potentialEnergy(const StateView& at) const override {
    double energy = 0;
    for (std::size_t i = 0; i < at.x.size(); ++i) {
      const double u2 = (at.x[i] - state().rest()[i]).squaredNorm();
      energy += 0.5 * k * u2 + 0.25 * c * u2 * u2;
    }
    return energy;
  }
  void linearize(const StateView& at) override {
    tangent_.resize(at.x.size());
    for (std::size_t i = 0; i < at.x.size(); ++i) {
      const Vec3 u = at.x[i] - state().rest()[i];
      tangent_[i] = -(k + c * u.squaredNorm()) * Mat3::Identity() - 2 * c * u * u.transpose();
    }
  }
  void addTangentProduct(ConstVec3Span dx, double stiffness, double, Vec3Span df) const override {
    for (std::size_t i = 0; i < dx.size(); ++i) df[i] += stiffness * (tangent_[i] * dx[i]);
  }
  [[nodiscard]] bool addPattern(BlockPattern&, Index) const override { return true; }
  void addTangent(BlockMatrix& matrix, Index offset, double stiffness, double) const override {
    for (std::size_t i = 0; i < tangent_.size(); ++i) {
      const Index row = offset + static_cast<Index>(i);
      matrix.add(row, row, stiffness * tangent_[i]);
    }
  }

 private:
  std::vector<Mat3> tangent_;
};

// Springs between consecutive particles, at rest at their distance in the rest positions.
class Chain final : public ForceField {
 public:
  Attribute<double> k{this, "k", 0.0, "Stiffness.", {.runtime = true}};
  Attribute<bool> assembles{this, "assembles", true, "Whether it gives blocks."};
  Link<MechanicalState> mechanicalState{this, "state", "Particles.", Lookup::nearest};

  [[nodiscard]] MechanicalState& state() const override { return *mechanicalState; }
  void addForce(const StateView& at, Vec3Span f) override {
    for (std::size_t i = 0; i + 1 < f.size(); ++i) {
      const Vec3 d = at.x[i + 1] - at.x[i];
      const Vec3 pull = k * (d.norm() - restLength(i)) * d.normalized();
      f[i] += pull;
      f[i + 1] -= pull;
    }
  }
  [[nodiscard]] double potentialEnergy(const StateView& at) const override {
    double energy = 0;
    for (std::size_t i = 0; i + 1 < at.x.size(); ++i) {
      const double stretch = (at.x[i + 1] - at.x[i]).norm() - restLength(i);
      energy += 0.5 * k * stretch * stretch;
    }
    return energy;
  }
  void linearize(const StateView& at) override {
    block_.resize(at.x.size() - 1);
    for (std::size_t i = 0; i < block_.size(); ++i) {
      const Vec3 d = at.x[i + 1] - at.x[i];
      const Mat3 along = d.normalized() * d.normalized().transpose();
      block_[i] = k * (along + (1 - restLength(i) / d.norm()) * (Mat3::Identity() - along));
    }
  }
  void addTangentProduct(ConstVec3Span dx, double stiffness, double, Vec3Span df) const override {
    for (std::size_t i = 0; i < block_.size(); ++i) {
      const Vec3 pull = stiffness * (block_[i] * (dx[i + 1] - dx[i]));
      df[i] += pull;
      df[i + 1] -= pull;
    }
  }
  [[nodiscard]] bool addPattern(BlockPattern& pattern, Index offset) const override {
    if (!assembles) return false;
    for (Index i = 0; i + 1 < state().size(); ++i) pattern.add(offset + i, offset + i + 1);
    return true;
  }
  void addTangent(BlockMatrix& matrix, Index offset, double stiffness, double) const override {
    if (!assembles) return;
    for (std::size_t k0 = 0; k0 < block_.size(); ++k0) {
      const Index i = offset + static_cast<Index>(k0);
      matrix.add(i, i, -stiffness * block_[k0]);
      matrix.add(i + 1, i + 1, -stiffness * block_[k0]);
      matrix.add(i + 1, i, stiffness * block_[k0]);
    }
  }

 private:
  [[nodiscard]] double restLength(std::size_t i) const {
    return (state().rest()[i + 1] - state().rest()[i]).norm();
  }
  std::vector<Mat3> block_;
};

inline void registerAll(Registry& registry) {
  registry.add<MechanicalObject>("MechanicalObject");
  registry.add<UniformMass>("UniformMass");
  registry.add<StiffeningSprings>("StiffeningSprings");
  registry.add<Chain>("Chain");
  registry.add<EulerExplicitSolver>("EulerExplicitSolver");
  registry.add<EulerImplicitSolver>("EulerImplicitSolver");
  registry.add<StaticSolver>("StaticSolver");
  registry.add<CGLinearSolver>("CGLinearSolver");
  registry.add<SparseLDLSolver>("SparseLDLSolver");
  registry.add<FixedProjectiveConstraint>("FixedProjectiveConstraint");
  registry.add<ConstantForceField>("ConstantForceField");
  registry.add<RestShapeSpringsForceField>("RestShapeSpringsForceField");
  registry.add<UniformVelocityDampingForceField>("UniformVelocityDampingForceField");
}

struct Loaded {
  std::unique_ptr<Scene> scene;
  bool ready = false;
  [[nodiscard]] System& system() const { return *scene->systems().front(); }
  [[nodiscard]] std::string text() const { return scene->diagnostics().text(); }
  template <class T>
  [[nodiscard]] T& find() const {
    return *collect<T>(scene->root()).front();
  }
  void run(int steps) const {
    for (int i = 0; i < steps; ++i) ASSERT_TRUE(scene->step());
  }
};

// Loads and initialises; whether that worked is in `ready`.
inline Loaded tryLoad(const std::string& xml) {
  SceneOptions options;
  options.pluginFolders.clear();
  options.writesOutput = false;
  Loaded loaded{std::make_unique<Scene>(options), false};
  registerAll(loaded.scene->registry());
  loaded.ready = loaded.scene->loadText(xml, "test.xml") && loaded.scene->initialise();
  return loaded;
}

inline Loaded load(const std::string& xml) {
  Loaded loaded = tryLoad(xml);
  EXPECT_TRUE(loaded.ready) << loaded.text();
  return loaded;
}

inline std::uint64_t limiter(const Component& component, std::string_view name) {
  for (const Limiter* l : component.limiters()) {
    if (l->name() == name) return l->count();
  }
  ADD_FAILURE() << "no limiter " << name;
  return 0;
}

// Straight chain of particles along x, `spacing` apart.
inline std::string line(int count, double spacing) {
  std::string text;
  for (int i = 0; i < count; ++i) text += std::to_string(i * spacing) + " 0 0 ";
  return text;
}

inline std::string dtNode(double dt, const std::string& content, const std::string& gravity) {
  std::ostringstream text;
  text.precision(17);
  text << "<Node name='root' dt='" << dt << "' gravity='" << gravity << "'>" << content
       << "</Node>";
  return text.str();
}
inline std::string dtNode(double dt, const std::string& content) {
  return dtNode(dt, content, "0 0 0");
}

}  // namespace stroma::test
