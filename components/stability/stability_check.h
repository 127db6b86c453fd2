// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "components/stability/body_measures.h"
#include "components/stability/energy_balance.h"
#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/mesh.h"
#include "core/interfaces/observer.h"
#include "core/schedule.h"
#include "core/system.h"

namespace stroma {

// Criteria in numbers that a run has to meet. Each is an attribute that holds only where it is
// given. The worst value of each is recorded with its step; a run that misses one ends as "check
// failed". Criteria of the end hold at the end, or at every look from `settled` on. One that was
// never looked at, because the run ended before `from`, is missed.
//
// It looks at all that the solvers govern, or at `state`. Lengths are relative to `size`, the
// longest side of the bodies at rest. Energies count what loads, tools and cuts put in between
// steps as their work (EnergyBalance): for that it has to look after everything that moves, so it
// belongs in a node of its own at the end of the scene. Constraints that a solver resolves without
// a potential energy (XPBD) are not in them.
class StabilityCheck final : public Observer {
 public:
  Attribute<double> maxSpeed{
      this, "maxSpeed", 0.0, "Largest speed of a particle.", {.unit = "m/s", .min = 0}};
  Attribute<double> maxDisplacement{
      this, "maxDisplacement", 0.0, "Largest displacement from rest, over size.", {.min = 0}};
  Attribute<double> maxShapeError{
      this,
      "maxShapeError",
      0.0,
      "Largest distance from the rest shape, moved rigidly to fit, over size.",
      {.min = 0}};
  Attribute<double> energyGrowth{
      this,
      "energyGrowth",
      0.0,
      "Energy above that at the start, the work of loads taken off, over energyScale.",
      {.min = 0}};
  Attribute<double> energyRise{this,
                               "energyRise",
                               0.0,
                               "The same above the least so far: 0 where energy may never grow.",
                               {.min = 0}};
  Attribute<double> energyDrift{
      this, "energyDrift", 0.0, "The same, up or down from the start.", {.min = 0}};
  Attribute<double> energyScale{
      this,
      "energyScale",
      0.0,
      "What energies are measured by; the largest kinetic energy, or change of the potential one, "
      "if not given.",
      {.unit = "J", .min = 0, .exclusiveMin = true}};
  Attribute<double> momentumDrift{
      this,
      "momentumDrift",
      0.0,
      "Change of momentum over the largest sum of the particles' own. For bodies without loads.",
      {.min = 0}};
  Attribute<double> angularMomentumDrift{this,
                                         "angularMomentumDrift",
                                         0.0,
                                         "The same of angular momentum, about the origin.",
                                         {.min = 0}};
  Attribute<double> minVolumeRatio{
      this, "minVolumeRatio", 0.0, "Volume inside `surface` over that at rest, at least.", {}};
  Attribute<double> maxVolumeRatio{this, "maxVolumeRatio", 0.0, "The same, at most.", {}};
  Attribute<double> minValue{this, "minValue", 0.0, "Least that `value` may be (SI).", {}};
  Attribute<double> maxValue{this, "maxValue", 0.0, "Largest that `value` may be (SI).", {}};
  Attribute<double> finalDisplacement{
      this, "finalDisplacement", 0.0, "Largest displacement at the end, over size.", {.min = 0}};
  Attribute<double> finalShapeError{
      this,
      "finalShapeError",
      0.0,
      "Largest distance from the rest shape, moved rigidly to fit, at the end, over size.",
      {.min = 0}};
  Attribute<double> finalSpeed{
      this, "finalSpeed", 0.0, "Largest speed at the end.", {.unit = "m/s", .min = 0}};
  Attribute<double> finalInverted{
      this, "finalInverted", 0.0, "Share of inverted `elements` at the end.", {.min = 0, .max = 1}};
  Attribute<double> finalPattern{this,
                                 "finalPattern",
                                 0.0,
                                 "How much of `pattern` is left in the displacements at the end.",
                                 {.min = 0}};
  Attribute<double> referenceTolerance{
      this,
      "referenceTolerance",
      0.0,
      "How far the mean displacement of the particles `indices` is from `reference` at the end, "
      "over its length.",
      {.min = 0}};
  Attribute<double> finalTime{
      this, "finalTime", 0.0, "Time that the run has to reach.", {.unit = "s", .min = 0}};

  Attribute<double> settled{this,
                            "settled",
                            0.0,
                            "From this time on criteria of the end hold at every look.",
                            {.unit = "s", .min = 0}};
  Attribute<double> from{
      this, "from", 0.0, "It begins to look at this time.", {.unit = "s", .min = 0}};
  Attribute<int> every{
      this,
      "every",
      1,
      "Steps between looks. With more than 1 loads are taken for constant in energies.",
      {.min = 1}};
  Attribute<double> size{this,
                         "size",
                         0.0,
                         "What lengths are measured by; the longest side at rest if not given.",
                         {.unit = "m", .min = 0, .exclusiveMin = true}};
  Attribute<std::string> value{
      this, "value", "", "A numeric attribute: \"@component.attribute\"; of vectors the length."};
  Attribute<std::vector<Vec3>> pattern{
      this, "pattern", {}, "Displacements, one a particle.", {.unit = "m"}};
  Attribute<IndexList> indices{this, "indices", {}, "Particles of `reference`."};
  Attribute<Vec3> reference{
      this, "reference", Vec3::Zero(), "Mean displacement that is right.", {.unit = "m"}};
  Attribute<bool> passed{
      this, "passed", true, "Whether all criteria are met so far.", {.output = true}};

  Link<MechanicalState> mechanicalState{this,
                                        "state",
                                        "Particles looked at, all if not given. Energies and "
                                        "momenta are those of the solver that governs them.",
                                        Lookup::explicitOnly,
                                        {.required = false}};
  Link<Mesh> surface{this,
                     "surface",
                     "Closed surface of the particles.",
                     Lookup::explicitOnly,
                     {.required = false}};
  Link<Mesh> elements{this,
                      "elements",
                      "Tetrahedra, or hexahedra, of the particles.",
                      Lookup::explicitOnly,
                      {.required = false}};

  StabilityCheck();
  void configure() override;
  void start() override;
  void reset() override;
  void schedule(Schedule& schedule) override;
  void stop() override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] std::vector<std::pair<std::string, double>> lastValues() const override;
  [[nodiscard]] std::vector<CheckResult> checks() const override;

 private:
  enum class When { always, end };
  enum class Side { most, least };
  // What a measure is divided by, once the run has shown how large it is.
  enum class Scale { one, energy, momentum, angularMomentum };
  using Measure = double (StabilityCheck::*)() const;
  struct Criterion {
    const Attribute<double>* bound;
    Measure measure;
    When when;
    Side side;
    Scale scale;
    bool seen = false;
    double worst = 0;  // not yet divided by the scale
    std::uint64_t step = 0;
  };

  void add(const Attribute<double>& bound, Measure measure, When when = When::always,
           Side side = Side::most, Scale scale = Scale::one);
  void checkLinks();
  void begin(double time);
  void beforeSolve(const StepContext& step);
  void afterStep(const StepContext& step);
  void look(double time, std::uint64_t step);
  void record(When when, std::uint64_t step);
  [[nodiscard]] bool isAfter(double time, const Attribute<double>& mark) const;
  [[nodiscard]] double scaleOf(const Criterion& c) const;
  [[nodiscard]] double worstOf(const Criterion& c) const;
  [[nodiscard]] bool holds(const Criterion& c) const;
  [[nodiscard]] bool uses(Scale scale) const;

  [[nodiscard]] MechanicalEnergy energy(double time) const;
  [[nodiscard]] double speed() const;
  [[nodiscard]] double displacement() const;
  [[nodiscard]] double shapeError() const;
  [[nodiscard]] double growth() const { return balance_.growth(); }
  [[nodiscard]] double rise() const { return balance_.rise(); }
  [[nodiscard]] double drift() const { return std::abs(balance_.growth()); }
  [[nodiscard]] double momentumChange() const { return (momenta_.linear - momentum_).norm(); }
  [[nodiscard]] double angularMomentumChange() const {
    return (momenta_.angular - angularMomentum_).norm();
  }
  [[nodiscard]] double volumeRatio() const;
  [[nodiscard]] double valueNow() const;
  [[nodiscard]] double invertedShare() const;
  [[nodiscard]] double patternLeft() const;
  [[nodiscard]] double referenceError() const;
  [[nodiscard]] double timeReached() const;

  std::vector<Criterion> criteria_;  // those that are given
  std::vector<System*> systems_;
  std::vector<MechanicalState*> states_;
  double size_ = 0, restVolume_ = 0;
  EnergyBalance balance_;
  Vec3 momentum_ = Vec3::Zero(), angularMomentum_ = Vec3::Zero();  // at the start
  Momenta momenta_;                                                // now, scales the largest so far
  std::uint64_t lastLook_ = 0;
  bool begun_ = false, stopped_ = false;
};

}  // namespace stroma
