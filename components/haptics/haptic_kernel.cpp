// SPDX-License-Identifier: Apache-2.0
#include "components/haptics/haptic_kernel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace stroma {
namespace {

// Stiffness (N/m) that stands for a rigid plane, over that of the coupling.
constexpr double rigidRatio = 1e4;
// Without force for so long (s) the coupling holds no energy: the observer starts afresh.
constexpr double idleReset = 0.1;
// Samples come to a late tick in bunches: closer ones are taken to be so far apart (s).
constexpr double shortestTick = 1e-3;

bool isFinite(const ToolSample& s) {
  return s.pose.position.allFinite() && s.pose.orientation.coeffs().allFinite() &&
         s.linearVelocity.allFinite() && s.angularVelocity.allFinite();
}

// A finite pose with a real orientation, at a speed that a hand can have.
bool isPlausible(const ToolSample& s, const HapticParameters& with, double dt,
                 const HapticState& state) {
  if (!isFinite(s) || std::abs(s.pose.orientation.squaredNorm() - 1) > 1e-2) return false;
  if (s.linearVelocity.norm() > with.maxSpeed) return false;
  const double most = with.maxSpeed * std::max(dt, shortestTick);
  return !state.started || (s.pose.position - state.stylus).norm() <= most;
}

// Stiffnesses that a spring can have. What else is not finite in a model shows in the result.
bool isPlausible(const LocalContactModel& model) {
  const auto count = static_cast<std::size_t>(std::clamp(model.planeCount, 0, maxContactPlanes));
  return std::ranges::all_of(std::span(model.planes).first(count), [](const ContactPlane& plane) {
    return std::isfinite(plane.stiffness) && plane.stiffness >= 0;
  });
}

struct Coupling {
  Pose proxy;
  Vec3 force = Vec3::Zero();  // on the tool by contacts and the rest (N)
  double pressing = 0;        // J, held by the springs at work
};

// The planes at the time and orientation of the tick: gap(p) = normal . p - offset.
struct Plane {
  Vec3 normal;
  double offset, stiffness;
};

// Minimises S |p - free|^2 / 2 + sum k_i min(0, gap_i(p))^2 / 2, the equation at the head of the
// header, by Newton's method on the planes that touch. It ends after as many rounds as it takes
// until these no longer change, which is two or three.
Vec3 restingPlace(const Vec3& freePlace, double s, std::span<const Plane> planes) {
  Vec3 p = freePlace;
  std::uint32_t touching = 0;
  for (int round = 0; round < 2 * maxContactPlanes; ++round) {
    std::uint32_t now = 0;
    Mat3 matrix = s * Mat3::Identity();
    Vec3 right = s * freePlace;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const Plane& plane = planes[i];
      if (plane.normal.dot(p) >= plane.offset) continue;
      now |= 1U << i;
      matrix += plane.stiffness * plane.normal * plane.normal.transpose();
      right += plane.stiffness * plane.offset * plane.normal;
    }
    if (round > 0 && now == touching) break;
    touching = now;
    p = matrix.llt().solve(right);
  }
  return p;
}

// Balances the proxy between the stylus and the tissue; one that is set anew has not moved, and
// nothing damps it.
Coupling couple(const Pose& stylus, const Vec3& velocity, const LocalContactModel& model, double dt,
                const std::optional<Vec3>& lastProxy) {
  const HapticParameters& with = model.parameters;
  // the damper by backward Euler, so that any B keeps the proxy calm
  const double k = with.couplingStiffness;
  const double b = lastProxy ? with.couplingDamping / dt : 0;
  const double s = k + b;
  Coupling result;
  const Vec3 damped = lastProxy.value_or(stylus.position) + dt * velocity;
  const Vec3 freePlace = (k * stylus.position + b * damped + model.force) / s;

  const int count = std::clamp(model.planeCount, 0, maxContactPlanes);
  std::array<Plane, maxContactPlanes> storage;
  for (int i = 0; i < count; ++i) {
    const ContactPlane& c = model.planes[static_cast<std::size_t>(i)];
    storage[static_cast<std::size_t>(i)] = {
        c.normal, c.normal.dot(c.point - stylus.orientation * c.arm),
        c.stiffness > 0 ? std::min(c.stiffness, rigidRatio * s) : rigidRatio * s};
  }
  const std::span planes(storage.data(), static_cast<std::size_t>(count));

  result.proxy = {restingPlace(freePlace, s, planes), stylus.orientation};
  result.force = model.force;
  for (const Plane& plane : planes) {
    const double push =
        plane.stiffness * std::max(0.0, plane.offset - plane.normal.dot(result.proxy.position));
    result.force += push * plane.normal;
    result.pressing += 0.5 * push * std::max(0.0, plane.offset - plane.normal.dot(stylus.position));
  }
  return result;
}

// Zero force at once. A finite pose is believed from the next tick on, when the stylus is still
// there: the tool is then set beside it.
HapticOutput fail(const ToolSample& sample, HapticState& state) {
  ++state.faults;
  state.faulty = true;
  state.gain = 0;
  state.energy = 0;
  state.force.setZero();
  if (sample.pose.position.allFinite()) {
    state.stylus = sample.pose.position;
    state.jumped = true;
  }
  return {state.force, state.proxy};
}

// How far the force is faded in (0 to 1): down while the simulation or the device is silent.
double fadedGain(const ToolSample& sample, const LocalContactModel& model, double dt,
                 HapticState& state) {
  const HapticParameters& with = model.parameters;
  state.modelAge = model.sequence > 0 ? std::max(0.0, sample.time - model.time) : 0;
  // a device that does not count its samples is taken to be alive
  state.silence =
      sample.sequence == 0 || sample.sequence != state.sequence ? 0 : state.silence + dt;
  state.sequence = sample.sequence;
  const bool alive =
      model.sequence > 0 && state.modelAge <= with.staleAfter && state.silence <= with.staleAfter;
  if (!alive) ++state.staleTicks;
  return alive ? std::min(1.0, state.gain + dt / with.recoveryTime)
               : std::max(0.0, state.gain - dt / with.decayTime);
}

// The passivity controller's share, 0 to 1: from zero energy on it comes up.
double debt(const HapticParameters& with, const HapticState& state) {
  return std::clamp(-state.energy / with.energyReserve, 0.0, 1.0);
}

// Without the part that helps the hand's motion, in so far as the hand has had back all its work.
Vec3 passive(const Vec3& force, const Vec3& velocity, double share) {
  const double power = force.dot(velocity);
  if (share <= 0 || power <= 0) return force;
  return force - share * power / velocity.squaredNorm() * velocity;
}

Vec3 limited(const Vec3& wanted, double dt, const HapticParameters& with, HapticState& state) {
  Vec3 force = wanted;
  if (force.norm() > with.maxForce) {
    ++state.clampedTicks;
    force *= with.maxForce / force.norm();
  }
  const Vec3 change = force - state.force;
  const double most = with.maxForceRate * dt;
  if (change.norm() > most) {
    ++state.slewedTicks;
    force = state.force + change * (most / change.norm());
  }
  return force;
}

}  // namespace

HapticOutput HapticKernel::step(const ToolSample& sample, const LocalContactModel& model, double dt,
                                HapticState& state) noexcept {
  const HapticParameters& with = model.parameters;
  if (!isPlausible(sample, with, dt, state) || !isPlausible(model)) return fail(sample, state);
  const Vec3& x = sample.pose.position;
  const Vec3 moved = state.started ? Vec3(x - state.stylus) : Vec3(Vec3::Zero());
  const bool set = !state.started || state.jumped;

  // passivity observer: the last force was held while the hand moved, so this is its exact work
  state.energy -= state.force.dot(moved);
  state.idle = state.force.isZero(0) ? state.idle + dt : 0;
  if (state.idle >= idleReset) state.energy = 0;
  state.leastEnergy = std::min(state.leastEnergy, state.energy);

  const Pose stylus{with.origin + with.orientation * (with.positionScale * x),
                    (with.orientation * sample.pose.orientation).normalized()};
  const Vec3 approach = with.orientation * (with.positionScale * sample.linearVelocity);
  const double gain = fadedGain(sample, model, dt, state);
  const Coupling coupling =
      couple(stylus, approach, model, dt, set ? std::nullopt : std::optional(state.proxy.position));
  if (!coupling.proxy.position.allFinite() || !coupling.force.allFinite()) {
    return fail(sample, state);
  }

  // fading changes the springs while they are loaded: that energy is no work of the hand
  const double fading =
      (gain - state.gain) * coupling.pressing * with.forceScale / with.positionScale;
  state.energy = std::max(std::min(state.energy, 0.0), state.energy + fading);
  const Vec3 wanted = gain * with.forceScale * (with.orientation.conjugate() * coupling.force);
  const double share = wanted.isZero(0) ? 0 : debt(with, state);
  if (share > 0) ++state.passivityTicks;
  const Vec3 velocity = moved / dt;
  const Vec3 damped = wanted - share * with.passivityDamping * velocity;
  const Vec3 force = passive(limited(damped, dt, with, state), velocity, share);
  if (!force.allFinite()) return fail(sample, state);

  state.started = true;
  state.epoch += set ? 1 : 0;
  state.jumped = false;
  state.gain = gain;
  if (gain >= 1) state.faulty = false;
  state.stylus = x;
  state.proxy = coupling.proxy;
  state.force = force;
  return {force, coupling.proxy};
}

}  // namespace stroma
