// SPDX-License-Identifier: Apache-2.0
// Small components for tests of the core, and a scene that knows them without any module.
#pragma once

#include <memory>
#include <string>

#include "core/interfaces/force_field.h"
#include "core/interfaces/integrator.h"
#include "core/interfaces/mapping.h"
#include "core/interfaces/mass.h"
#include "core/scene.h"

namespace stroma::test {

class Points final : public MechanicalState {
 public:
  Attribute<std::vector<Vec3>> position{
      this, "position", {}, "Initial positions.", {.unit = "m", .autolink = true}};
  void bind() override {
    rest_ = initialX_ = position;
    initialV_.assign(rest_.size(), Vec3::Zero());
  }
};

class UnitMass final : public Mass {
 public:
  Link<MechanicalState> points{this, "state", "Particles.", Lookup::sameNode};
  [[nodiscard]] MechanicalState& state() const override { return *points; }
  void addMasses(std::span<double> masses) const override {
    for (double& m : masses) m += 1;
  }
};

// f = -k x - c v
class Tether final : public ForceField {
 public:
  Attribute<double> stiffness{
      this, "stiffness", 1.0, "Pull.", {.unit = "N/m", .min = 0, .runtime = true}};
  Attribute<double> damping{this, "damping", 0.0, "Drag.", {.unit = "N s/m"}};
  Attribute<double> poison{
      this, "poison", -1.0, "Time from which the force is NaN.", {.unit = "s"}};
  Link<MechanicalState> points{
      this, "state", "Particles.", Lookup::sameNode, {.aliases = "mstate"}};
  [[nodiscard]] MechanicalState& state() const override { return *points; }
  void addForce(const StateView& at, Vec3Span f) override {
    for (std::size_t i = 0; i < f.size(); ++i) f[i] -= *stiffness * at.x[i] + *damping * at.v[i];
    if (poison >= 0.0 && at.time >= *poison) f[0].x() = std::nan("");
  }
  [[nodiscard]] double potentialEnergy(const StateView& at) const override {
    double sum = 0;
    for (const Vec3& x : at.x) sum += 0.5 * *stiffness * x.squaredNorm();
    return sum;
  }
  void linearize(const StateView&) override {}
  void addTangentProduct(ConstVec3Span dx, double k, double b, Vec3Span df) const override {
    for (std::size_t i = 0; i < df.size(); ++i) df[i] -= (k * *stiffness + b * *damping) * dx[i];
  }
  [[nodiscard]] bool addPattern(BlockPattern&, Index) const override { return true; }
  void addTangent(BlockMatrix& matrix, Index offset, double k, double b) const override {
    for (Index i = 0; i < points->size(); ++i) {
      matrix.addDiagonal(offset + i, -(k * *stiffness + b * *damping));
    }
  }
};

class HalfMapping final : public Mapping {
 public:
  Link<MechanicalState> in{this, "input", "From.", Lookup::parent};
  Link<MechanicalState> out{this, "output", "To.", Lookup::sameNode};
  [[nodiscard]] MechanicalState& input() const override { return *in; }
  [[nodiscard]] MechanicalState& output() const override { return *out; }
  void apply(ConstVec3Span a, Vec3Span b) const override { applyJ(a, b); }
  void applyJ(ConstVec3Span a, Vec3Span b) const override {
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = 0.5 * a[i];
  }
  void addTransposed(ConstVec3Span b, Vec3Span a) const override {
    for (std::size_t i = 0; i < b.size(); ++i) a[i] += 0.5 * b[i];
  }
};

class SymplecticEuler final : public Integrator {
 public:
  void integrate(const StepContext& step) override {
    System& s = system();
    s.computeForce({s.x(), s.v(), step.time}, s.f());
    for (std::size_t i = 0; i < s.f().size(); ++i) {
      s.v()[i] += step.dt * s.inverseMass()[i] * s.f()[i];
      s.x()[i] += step.dt * s.v()[i];
    }
  }
};

// Adds up a number in every step; its sum is state.
class Counter final : public Component {
 public:
  Attribute<int> increment{this, "increment", 1, "Added in every step.", {.runtime = true}};
  Attribute<std::vector<double>> numbers{
      this, "numbers", {}, "For data links.", {.autolink = true}};
  Attribute<IndexList> indices{this, "indices", {}, "For data links."};
  Attribute<double> sum{this, "sum", 0.0, "Sum so far.", {.output = true}};
  Link<Counter> other{this, "other", "For link cycles.", Lookup::explicitOnly, {.required = false}};
  static constexpr std::string_view role = "Counter";
  void schedule(Schedule& schedule) override {
    schedule.add<&Counter::count>(Stage::Publish, *this, "count", Rate::visual);
  }
  void count(const StepContext&) { sum.set(sum + static_cast<double>(*increment)); }
  void save(StateWriter& writer) const override { writer.write("sum", sum.value()); }
  void restore(StateReader& reader) override {
    double value = 0;
    if (reader.read("sum", value)) sum.set(value);
  }
};

inline std::unique_ptr<Scene> makeScene(SceneOptions options = {}) {
  options.pluginFolders.clear();
  auto scene = std::make_unique<Scene>(std::move(options));
  Registry& r = scene->registry();
  r.setOrigin("test");
  r.add<Points>("Points").alias("OldPoints");
  r.add<UnitMass>("UnitMass");
  r.add<Tether>("Tether");
  r.add<HalfMapping>("HalfMapping");
  r.add<SymplecticEuler>("SymplecticEuler");
  r.add<Counter>("Counter");
  return scene;
}

// Loads and initialises; the diagnostics' text tells what went wrong.
inline bool ready(Scene& scene, const std::string& xml) {
  return scene.loadText(xml, "scene.xml") && scene.initialise();
}

}  // namespace stroma::test
