// SPDX-License-Identifier: Apache-2.0
#include "components/haptics/haptic_controller.h"

#include <algorithm>
#include <ranges>

#include "core/rigid_motion.h"
#include "core/scene.h"
#include "core/traverse.h"

namespace stroma {
namespace {

constexpr double defaultRate = 1000;  // Hz, in real time, where the scene says nothing

// Values that own nothing, as they lie in memory, for a checkpoint of the same build.
template <class T>
void writeValue(StateWriter& writer, std::string_view name, const T& value) {
  static_assert(std::is_trivially_destructible_v<T>);
  writer.write(name, std::as_bytes(std::span(&value, 1)));
}
template <class T>
bool readValue(StateReader& reader, std::string_view name, T& value) {
  return reader.read(name, std::as_writable_bytes(std::span(&value, 1)));
}

// A plane that gives, at the tool's pose of now, the force that the contact gave. That is not
// always stiffness times depth: the contact may be damped, or be a constraint. A contact that
// neither presses nor is deep stays where the tissue is, and a rigid one (stiffness 0) does in any
// case.
ContactPlane planeOf(const Contact& c, const Pose& pose) {
  const double pressing = std::max(0.0, c.force.dot(c.normal));
  const Vec3 touching = c.point - c.depth * c.normal;
  const bool soft = c.stiffness > 0 && (pressing > 0 || c.depth > 0);
  const double shift = soft ? pressing / c.stiffness - c.depth : 0;
  return {pose.orientation.conjugate() * (touching - pose.position), c.point + shift * c.normal,
          c.normal, c.stiffness};
}

}  // namespace

void HapticController::bind() {
  for (const HapticController* other : collect<HapticController>(scene().root())) {
    if (other == this) break;  // of two the later one is told
    if (other->device.get() == device.get()) {
      error(device, "haptic-second", "'" + other->path() + "' serves this device already");
    } else if (other->tool.get() == tool.get()) {
      error(tool, "haptic-second", "'" + other->path() + "' moves this tool already");
    }
  }
  if (failed()) return;
  replay_ = dynamic_cast<const ReplayDevice*>(device.get());
  tool->setDriven(true);
  if (const std::filesystem::path file = record->path;
      file.is_absolute() || std::ranges::find(file, "..") != file.end()) {
    error(record, "output-path", "leaves the output folder",
          "give a relative path; the command line chooses the folder");
  }
}

void HapticController::start() {
  const bool realTime = scene().options().realTime;
  const double given = scene().rates().haptic;
  const double ticksPerSecond = given > 0 ? given : realTime ? defaultRate : 1 / scene().dt();
  loop_.connect(*device, ticksPerSecond);
  const double scale = forceScale * positionScale;
  const double asked = scale * (couplingStiffness / ticksPerSecond / 2 + couplingDamping);
  if (asked > stableDamping) {
    warning("haptic-stiff",
            "the coupling needs " + ValueTraits<double>::print(asked) +
                " N s/m of damping from hand and device; " +
                ValueTraits<double>::print(stableDamping) + " can be relied on",
            "lower couplingStiffness, couplingDamping or the scales, or raise the haptic rate");
  }
  model_.parameters = parameters();
  loop_.restore({}, model_);
  if (!realTime || loop_.start(threadPriority)) return;
  const std::string refused =
      "the system refuses the real-time class: ticks run in the ordinary one, and later under load";
  if (threadPriority.isSet()) {
    warning("haptic-priority", refused, "allow it for the user (limits.conf: rtprio)");
  } else {
    note("haptic-priority", refused);
  }
}

void HapticController::schedule(Schedule& schedule) {
  if (!scene().options().realTime) {
    schedule.add<&HapticController::tick>(Stage::Input, *this, "haptic tick", Rate::haptic);
  }
  schedule.add<&HapticController::moveTool>(Stage::Input, *this, "move tool");
  schedule.add<&HapticController::publish>(Stage::Publish, *this, "publish contacts");
  schedule.add<&HapticController::showPace>(Stage::Publish, *this, "pace statistics", Rate::visual);
}

void HapticController::reset() {
  toolEpoch_ = 0;
  resumedAt_.reset();
  session_.close();
  const std::uint64_t sequence = model_.sequence;
  model_ = {};
  model_.parameters = parameters();
  if (loop_.running()) {
    // the hand is where it is and has counted what it has; only the contacts are gone
    static_cast<void>(loop_.newest(report_));
    counted_ = report_.state;
    model_.sequence = sequence + 1;
    model_.time = loop_.now();
    loop_.publish(model_);
  } else {
    report_ = {};
    counted_ = {};
    loop_.restore({}, model_);
  }
}

void HapticController::stop() {
  loop_.stop();
  session_.close();
  static_cast<void>(loop_.newest(report_));
  showState();
  showPace({});
}

HapticParameters HapticController::parameters() const {
  return {.couplingStiffness = couplingStiffness,
          .couplingDamping = couplingDamping,
          .maxForce = maxForce,
          .maxForceRate = maxForceRate,
          .forceScale = forceScale,
          .positionScale = positionScale,
          .origin = origin,
          .orientation = orientation,
          .staleAfter = staleAfter,
          .decayTime = decayTime,
          .recoveryTime = recoveryTime,
          .maxSpeed = maxSpeed,
          .energyReserve = energyReserve,
          .passivityDamping = passivityDamping};
}

std::optional<SessionFrame> HapticController::frame(std::uint64_t step) {
  if (replay_) {
    const SessionFrame* recorded = replay_->frame(step);
    return recorded ? std::optional(*recorded) : std::nullopt;
  }
  if (!report_.hasSample) return std::nullopt;
  const HapticState& state = report_.state;
  return SessionFrame{step,        state.epoch,    report_.device.buttons,
                      state.proxy, report_.device, state.force};
}

void HapticController::moveTool(const StepContext& step) {
  static_cast<void>(loop_.newest(report_));
  tool->clearForces();
  const Pose from = tool->pose();
  const std::optional<SessionFrame> now = frame(step.step);
  if (!now) {
    tool->moveTo(from, Vec3::Zero(), Vec3::Zero(), false);
    return;
  }
  const bool active = (now->buttons & 1U) != 0;
  if (now->epoch != toolEpoch_) {
    // set, not moved: nothing lies between the two poses
    toolEpoch_ = now->epoch;
    tool->moveTo(now->tool, Vec3::Zero(), Vec3::Zero(), active);
    tool->moveTo(now->tool, Vec3::Zero(), Vec3::Zero(), active);
  } else {
    tool->moveTo(now->tool, (now->tool.position - from.position) / step.dt,
                 rotationVector(from.orientation, now->tool.orientation) / step.dt, active);
  }
  recordFrame(*now);
}

// The deepest contacts become planes. What else pulls at the tool, friction and the normal forces
// of the contacts left out included, stays a force.
void HapticController::fillPlanes() {
  const std::span<const Contact> contacts = tool->contacts();
  const Pose& pose = tool->pose();
  std::array<std::size_t, maxContactPlanes> chosen{};
  const auto end =
      std::ranges::partial_sort_copy(std::views::iota(std::size_t{0}, contacts.size()), chosen,
                                     [&](std::size_t a, std::size_t b) {
                                       return contacts[a].depth != contacts[b].depth
                                                  ? contacts[a].depth > contacts[b].depth
                                                  : a < b;
                                     })
          .out;
  model_.planeCount = static_cast<int>(end - chosen.begin());
  model_.force = tool->totalForce();
  for (int k = 0; k < model_.planeCount; ++k) {
    const Contact& c = contacts[chosen[static_cast<std::size_t>(k)]];
    model_.planes[static_cast<std::size_t>(k)] = planeOf(c, pose);
    model_.force -= std::max(0.0, c.force.dot(c.normal)) * c.normal;  // a plane does not pull
  }
}

void HapticController::publish(const StepContext&) {
  fillPlanes();
  model_.parameters = parameters();
  model_.time = loop_.now();
  ++model_.sequence;
  loop_.publish(model_);
  showState();
}

void HapticController::showState() {
  const HapticState& state = report_.state;
  force.set(state.force);
  stylusPosition.set(report_.device.pose.position);
  energy.set(state.energy);
  leastEnergy.set(state.leastEnergy);
  modelAge.set(state.modelAge);
  faulty.set(state.faulty);
  clamped.add(state.clampedTicks - counted_.clampedTicks);
  slewed.add(state.slewedTicks - counted_.slewedTicks);
  restrained.add(state.passivityTicks - counted_.passivityTicks);
  silent.add(state.staleTicks - counted_.staleTicks);
  faultLimiter.add(state.faults - counted_.faults);
  faults.set(static_cast<int>(faultLimiter.count()));
  counted_ = state;
}

void HapticController::showPace(const StepContext&) {
  if (!scene().options().realTime) return;
  const PaceStatistics pace = loop_.pace();
  rate.set(pace.rate);
  periodP50.set(pace.p50);
  periodP99.set(pace.p99);
  periodMax.set(pace.max);
  missedDeadlines.set(static_cast<int>(pace.misses));
  missRate.set(pace.missRate());
  tickCpuP99.set(loop_.cpuPerTick().quantile(0.99));
}

std::vector<std::pair<std::string, double>> HapticController::lastValues() const {
  std::vector<std::pair<std::string, double>> values = {{"haptic_force", force->norm()},
                                                        {"haptic_energy", energy},
                                                        {"haptic_least_energy", leastEnergy},
                                                        {"haptic_faults", *faults},
                                                        {"haptic_model_age", modelAge}};
  if (scene().options().realTime) {
    values.insert(values.end(), {{"haptic_rate", rate},
                                 {"haptic_period_p50", periodP50},
                                 {"haptic_period_p99", periodP99},
                                 {"haptic_period_max", periodMax},
                                 {"haptic_missed_deadlines", *missedDeadlines},
                                 {"haptic_miss_rate", missRate},
                                 {"haptic_tick_cpu_p99", tickCpuP99}});
  }
  return values;
}

std::filesystem::path HapticController::sessionFile() const {
  return scene().options().outputFolder / record->path;
}

std::vector<std::filesystem::path> HapticController::files() const {
  if (record->path.empty() || !scene().options().writesOutput || !trouble_.empty()) return {};
  return {sessionFile()};
}

// After a resumption the steps up to it are kept; without them there is no session to go on with,
// and a file that is something else is left alone.
void HapticController::openSession() {
  const std::filesystem::path file = sessionFile();
  std::string text = sessionHeader();
  if (resumedAt_.value_or(0) > 0) {
    std::ifstream stream(file, std::ios::binary);
    const std::string old{std::istreambuf_iterator<char>(stream), {}};
    std::vector<SessionFrame> frames;
    if (const std::string problem = stream ? readSession(old, frames) : "is not there";
        !problem.empty()) {
      trouble_ = "cannot go on with the session '" + file.string() + "', which " + problem;
      return;
    }
    for (const SessionFrame& f : frames) {
      if (f.step <= *resumedAt_) text += sessionLine(f);
    }
  }
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  session_.open(file, std::ios::binary | std::ios::trunc);
  session_ << text;
}

void HapticController::recordFrame(const SessionFrame& now) {
  if (files().empty()) return;
  if (!session_.is_open()) openSession();
  if (trouble_.empty()) {
    session_ << sessionLine(now);
    if (session_) return;
    trouble_ = "cannot write '" + sessionFile().string() + "'";
  }
  error(record, "output", trouble_);
}

void HapticController::save(StateWriter& writer) const {
  // in real time the hand's side is another thread's, and cannot be gone back to
  writer.write("realTime", scene().options().realTime ? 1 : 0);
  if (scene().options().realTime) return;
  writeValue(writer, "loop", loop_.memory());
  writeValue(writer, "model", model_);
  writeValue(writer, "report", report_);
  writeValue(writer, "counted", counted_);
  writeValue(writer, "toolEpoch", toolEpoch_);
}

void HapticController::restore(StateReader& reader) {
  session_.close();
  resumedAt_ = scene().stepCount();
  int realTime = 0;
  static_cast<void>(reader.read("realTime", realTime));
  if (scene().options().realTime || realTime != 0) {
    toolEpoch_ = 0;  // the hand is elsewhere than the tool was
    if (!scene().options().realTime) {
      warning("haptic-resumed",
              "a checkpoint of a run in real time does not hold the hand: it begins anew",
              "resume in real time, or replay the run's session");
    }
    return;
  }
  HapticLoop::Memory memory;
  const bool all = readValue(reader, "loop", memory) && readValue(reader, "model", model_) &&
                   readValue(reader, "report", report_) && readValue(reader, "counted", counted_) &&
                   readValue(reader, "toolEpoch", toolEpoch_);
  if (all) loop_.restore(memory, model_);
}

}  // namespace stroma
