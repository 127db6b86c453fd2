// SPDX-License-Identifier: Apache-2.0
#include "components/stability/stability_check.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "core/interfaces/integrator.h"
#include "core/scene.h"
#include "core/snapshot.h"
#include "core/triangle.h"

namespace stroma {
namespace {

std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", number);
  return text;
}

// Which of two measured values is worse; not a number is the worst of all.
bool isWorse(double now, double before, bool most) {
  if (std::isnan(before)) return false;
  return std::isnan(now) || (most ? now > before : now < before);
}

}  // namespace

StabilityCheck::StabilityCheck() = default;

void StabilityCheck::add(const Attribute<double>& bound, Measure measure, When when, Side side,
                         Scale scale) {
  if (bound.isSet()) criteria_.push_back({&bound, measure, when, side, scale});
}

void StabilityCheck::configure() {
  using C = StabilityCheck;
  add(maxSpeed, &C::speed);
  add(maxDisplacement, &C::displacement);
  add(maxShapeError, &C::shapeError);
  add(energyGrowth, &C::growth, When::always, Side::most, Scale::energy);
  add(energyRise, &C::rise, When::always, Side::most, Scale::energy);
  add(energyDrift, &C::drift, When::always, Side::most, Scale::energy);
  add(momentumDrift, &C::momentumChange, When::always, Side::most, Scale::momentum);
  add(angularMomentumDrift, &C::angularMomentumChange, When::always, Side::most,
      Scale::angularMomentum);
  add(minVolumeRatio, &C::volumeRatio, When::always, Side::least);
  add(maxVolumeRatio, &C::volumeRatio);
  add(minValue, &C::valueNow, When::always, Side::least);
  add(maxValue, &C::valueNow);
  add(finalDisplacement, &C::displacement, When::end);
  add(finalShapeError, &C::shapeError, When::end);
  add(finalSpeed, &C::speed, When::end);
  add(finalInverted, &C::invertedShare, When::end);
  add(finalPattern, &C::patternLeft, When::end);
  add(referenceTolerance, &C::referenceError, When::end);
  add(finalTime, &C::timeReached, When::end, Side::least);
  if (criteria_.empty()) error("check-empty", "has no criterion: give at least one of them");
  const auto need = [&](const Attribute<double>& criterion, const AttributeBase& input) {
    if (!criterion.isSet() || input.isSet()) return;
    error(criterion, "attr-required", "needs '" + std::string(input.name()) + "'");
  };
  need(finalPattern, pattern);
  need(referenceTolerance, reference);
  need(referenceTolerance, indices);
  need(minValue, value);
  need(maxValue, value);
  if (value.isSet() && !value.source()) {
    error(value, "link-syntax", "is a link to an attribute: \"@component.attribute\"");
  }
  const auto needMesh = [&](const Attribute<double>& criterion, const Link<Mesh>& mesh) {
    if (!criterion.isSet() || mesh) return;
    error(criterion, "attr-required", "needs '" + std::string(mesh.name()) + "'");
  };
  needMesh(minVolumeRatio, surface);
  needMesh(maxVolumeRatio, surface);
  needMesh(finalInverted, elements);
}

void StabilityCheck::start() {
  systems_.clear();
  states_.clear();
  if (mechanicalState) {
    if (System* system = scene().systemOf(*mechanicalState)) systems_.push_back(system);
    states_.push_back(mechanicalState.get());
  } else {
    for (const auto& system : scene().systems()) {
      systems_.push_back(system.get());
      for (MechanicalState* state : system->states()) states_.push_back(state);
    }
  }
  std::vector<Vec3> rest;
  for (const MechanicalState* state : states_) {
    rest.insert(rest.end(), state->rest().begin(), state->rest().end());
  }
  size_ = size.isSet() ? *size : longestSide(rest);
  if (!(size_ > 0)) {
    error("check-size", "looks at particles without a size", "give 'size', such as their distance");
  }
  checkLinks();
  if (value.source() && std::isnan(valueNow()) && !value.source()->number()) {
    error(value, "link-type",
          "links to '" + std::string(value.source()->name()) + "' (" + value.source()->typeName() +
              "), which is no number");
  }
}

void StabilityCheck::checkLinks() {
  const bool ofOne = surface || elements || pattern.isSet() || indices.isSet();
  if (!ofOne) return;
  if (states_.size() != 1) {
    error("check-state", "needs 'state': there are " + std::to_string(states_.size()) + " of them");
    return;
  }
  const auto count = static_cast<std::size_t>(states_.front()->size());
  const auto points = std::to_string(count);
  for (const auto* mesh : {&surface, &elements}) {
    if (*mesh && (*mesh)->positions().size() != count) {
      error(*mesh, "check-mesh", "has another number of points than the state, " + points);
    }
  }
  if (pattern.isSet() && pattern->size() != count) {
    error(pattern, "check-pattern",
          "has " + std::to_string(pattern->size()) + " displacements for " + points + " particles");
  }
  for (const Index i : indices->indices) {
    if (static_cast<std::size_t>(i) < count) continue;
    error(indices, "index-range", "has particle " + std::to_string(i) + "; there are " + points);
    return;
  }
  if (surface) restVolume_ = enclosedVolume(states_.front()->rest(), surface->triangles());
  if (surface && !(restVolume_ > 0)) error(surface, "check-mesh", "encloses no volume");
}

void StabilityCheck::schedule(Schedule& schedule) {
  schedule.add<&StabilityCheck::beforeSolve>(Stage::Collide, *this, "energy before");
  schedule.add<&StabilityCheck::afterStep>(Stage::Guard, *this, "criteria");
}

bool StabilityCheck::uses(Scale scale) const {
  return std::ranges::any_of(criteria_, [&](const Criterion& c) { return c.scale == scale; });
}

MechanicalEnergy StabilityCheck::energy(double time) const {
  MechanicalEnergy sum;
  for (System* system : systems_) {
    sum.kinetic += system->kineticEnergy(system->v());
    sum.potential += system->potentialEnergy({system->x(), system->v(), time});
  }
  return sum;
}

void StabilityCheck::begin(double time) {
  begun_ = true;
  if (uses(Scale::energy)) balance_.begin(energy(time));
  momenta_ = {};
  for (System* system : systems_) {
    addMomenta(system->x(), system->v(), system->mass(), Vec3::Zero(), momenta_);
  }
  momentum_ = momenta_.linear;
  angularMomentum_ = momenta_.angular;
}

void StabilityCheck::beforeSolve(const StepContext& step) {
  if (!isAfter(step.time, from)) return;
  if (!begun_) begin(step.time);
  if (every == 1 && uses(Scale::energy)) balance_.loadsMoved(energy(step.time + step.dt));
}

void StabilityCheck::afterStep(const StepContext& step) {
  if (!begun_) return;
  if (step.step % static_cast<std::uint64_t>(*every) == 0) look(step.time, step.step);
}

void StabilityCheck::look(double time, std::uint64_t step) {
  lastLook_ = step;
  if (uses(Scale::energy)) balance_.moved(energy(time));
  if (uses(Scale::momentum) || uses(Scale::angularMomentum)) {
    Momenta now;
    for (System* system : systems_) {
      addMomenta(system->x(), system->v(), system->mass(), Vec3::Zero(), now);
    }
    now.linearScale = std::max(now.linearScale, momenta_.linearScale);
    now.angularScale = std::max(now.angularScale, momenta_.angularScale);
    momenta_ = now;
  }
  record(When::always, step);
  if (settled.isSet() && isAfter(time, settled)) record(When::end, step);
}

// With half a step of grace: times are sums of steps.
bool StabilityCheck::isAfter(double time, const Attribute<double>& mark) const {
  return time >= mark - 0.5 * scene().dt();
}

void StabilityCheck::record(When when, std::uint64_t step) {
  bool all = true;
  for (Criterion& c : criteria_) {
    // a time is reached at the end
    if (c.when == when && (c.bound != &finalTime || stopped_)) {
      const double now = (this->*c.measure)();
      if (!c.seen || isWorse(now, c.worst, c.side == Side::most)) {
        c.worst = now;
        c.step = step;
      }
      c.seen = true;
    }
    all = all && (!c.seen || holds(c));
  }
  passed.set(all);
}

void StabilityCheck::stop() {
  if (stopped_ || failed()) return;  // one that could not start has nothing to look at
  stopped_ = true;
  const std::uint64_t step = scene().stepCount();
  if (begun_ && step != lastLook_) look(scene().time(), step);
  record(When::end, step);
}

void StabilityCheck::reset() {
  for (Criterion& c : criteria_) c.seen = false;
  begun_ = stopped_ = false;
  lastLook_ = 0;
  passed.set(true);
}

double StabilityCheck::scaleOf(const Criterion& c) const {
  switch (c.scale) {
    case Scale::energy:
      return energyScale.isSet() ? *energyScale : balance_.scale();
    case Scale::momentum:
      return momenta_.linearScale;
    case Scale::angularMomentum:
      return momenta_.angularScale;
    case Scale::one:
      break;
  }
  return 1;
}

double StabilityCheck::worstOf(const Criterion& c) const {
  return c.worst == 0 ? 0 : c.worst / scaleOf(c);
}

bool StabilityCheck::holds(const Criterion& c) const {
  const double worst = worstOf(c);
  // a time is reached within half a step
  const double grace = c.bound == &finalTime ? 0.5 * scene().dt() : 0;
  return c.side == Side::most ? worst <= *c.bound : worst >= *c.bound - grace;
}

double StabilityCheck::speed() const {
  double largest = 0;
  for (const MechanicalState* state : states_) {
    for (const Vec3& v : state->v()) largest = std::max(largest, v.norm());
  }
  return largest;
}

double StabilityCheck::displacement() const {
  double largest = 0;
  for (const MechanicalState* state : states_) {
    largest = std::max(largest, largestDisplacement(state->x(), state->rest()));
  }
  return largest / size_;
}

double StabilityCheck::shapeError() const {
  double largest = 0;
  for (const MechanicalState* state : states_) {
    largest = std::max(largest, largestShapeError(state->x(), state->rest()));
  }
  return largest / size_;
}

double StabilityCheck::volumeRatio() const {
  return enclosedVolume(states_.front()->x(), surface->triangles()) / restVolume_;
}

double StabilityCheck::valueNow() const {
  const AttributeBase* source = value.source();
  if (const auto number = source->number()) return *number;
  if (const auto* v = dynamic_cast<const Attribute<Vec3>*>(source)) return v->value().norm();
  return std::numeric_limits<double>::quiet_NaN();
}

double StabilityCheck::invertedShare() const {
  const MechanicalState& state = *states_.front();
  const auto tetrahedra = elements->tetrahedra();
  const auto hexahedra = elements->hexahedra();
  const std::size_t count = tetrahedra.empty() ? hexahedra.size() : tetrahedra.size();
  if (count == 0) return 0;
  const std::size_t inverted = tetrahedra.empty()
                                   ? countInverted(hexahedra, state.x(), state.rest())
                                   : countInverted(tetrahedra, state.x(), state.rest());
  return static_cast<double>(inverted) / static_cast<double>(count);
}

double StabilityCheck::patternLeft() const {
  return std::abs(shareOf(*pattern, states_.front()->x(), states_.front()->rest()));
}

double StabilityCheck::referenceError() const {
  const MechanicalState& state = *states_.front();
  Vec3 sum = Vec3::Zero();
  for (const Index k : indices->indices) {
    const auto i = static_cast<std::size_t>(k);
    sum += state.x()[i] - state.rest()[i];
  }
  sum /= static_cast<double>(std::max<std::size_t>(indices->indices.size(), 1));
  return (sum - *reference).norm() / reference->norm();
}

double StabilityCheck::timeReached() const { return scene().time(); }

std::vector<std::pair<std::string, double>> StabilityCheck::lastValues() const {
  std::vector<std::pair<std::string, double>> values;
  bool all = true;
  for (const Criterion& c : criteria_) {
    if (c.seen) values.emplace_back(name() + "." + std::string(c.bound->name()), worstOf(c));
    all = all && (c.seen ? holds(c) : !stopped_);
  }
  values.emplace_back(name() + ".passed", all ? 1 : 0);
  return values;
}

std::vector<CheckResult> StabilityCheck::checks() const {
  std::vector<CheckResult> results;
  for (const Criterion& c : criteria_) {
    const SourceRange place = c.bound->where() ? c.bound->where() : where();
    if (!c.seen && stopped_) {
      results.push_back({.criterion = std::string(c.bound->name()),
                         .passed = false,
                         .measured = std::numeric_limits<double>::quiet_NaN(),
                         .bound = *c.bound,
                         .step = scene().stepCount(),
                         .message = "not known: no step was made after 'from'",
                         .where = place});
    }
    if (!c.seen) continue;
    const double worst = worstOf(c),
                 time = scene().root().time + static_cast<double>(c.step) * scene().dt();
    const std::string unit(c.bound->info().unit.empty() ? ""
                                                        : " " + std::string(c.bound->info().unit));
    const std::string at = "at step " + std::to_string(c.step) + " (" + rounded(time) + " s)";
    results.push_back({.criterion = std::string(c.bound->name()),
                       .passed = holds(c),
                       .measured = worst,
                       .bound = *c.bound,
                       .step = c.step,
                       .message = rounded(worst) + unit + " " + at + "; bound " +
                                  (c.side == Side::most ? "at most " : "at least ") +
                                  rounded(*c.bound) + unit,
                       .where = place});
  }
  return results;
}

void StabilityCheck::save(StateWriter& writer) const {
  std::vector<double> worst;
  std::vector<std::uint64_t> steps;
  for (const Criterion& c : criteria_) {
    worst.push_back(c.worst);
    steps.push_back(c.seen ? c.step : std::numeric_limits<std::uint64_t>::max());
  }
  writer.write("worst", std::span<const double>(worst));
  writer.write("steps", std::span<const std::uint64_t>(steps));
  writer.write("balance", std::span<const EnergyBalance>(&balance_, 1));
  const std::array<double, 8> momenta{
      momentum_.x(),        momentum_.y(),        momentum_.z(),        angularMomentum_.x(),
      angularMomentum_.y(), angularMomentum_.z(), momenta_.linearScale, momenta_.angularScale};
  writer.write("momenta", std::span<const double>(momenta));
  writer.write("begun", begun_ ? 1 : 0);
}

void StabilityCheck::restore(StateReader& reader) {
  reset();
  std::vector<double> worst(criteria_.size());
  std::vector<std::uint64_t> steps(criteria_.size());
  std::array<double, 8> m{};
  int begun = 0;
  const bool read = reader.read("worst", std::span(worst)) &&
                    reader.read("steps", std::span(steps)) &&
                    reader.read("balance", std::span<EnergyBalance>(&balance_, 1)) &&
                    reader.read("momenta", std::span<double>(m)) && reader.read("begun", begun);
  if (!read) return;
  for (std::size_t i = 0; i < criteria_.size(); ++i) {
    criteria_[i].seen = steps[i] != std::numeric_limits<std::uint64_t>::max();
    criteria_[i].worst = worst[i];
    criteria_[i].step = steps[i];
  }
  momentum_ = {m[0], m[1], m[2]};
  angularMomentum_ = {m[3], m[4], m[5]};
  momenta_.linearScale = m[6];
  momenta_.angularScale = m[7];
  begun_ = begun != 0;
  lastLook_ = scene().stepCount();
}

}  // namespace stroma
