// SPDX-License-Identifier: Apache-2.0
#include "components/tools/scripted_device.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/rigid_motion.h"
#include "core/scene.h"
#include "core/snapshot.h"

namespace stroma {

void ScriptedDevice::bind() {
  keys_.clear();
  realTime_ = scene().options().realTime;
  if (filename.isSet() == keyTimes.isSet()) {
    error("attr-conflict", filename.isSet() ? "has both 'filename' and 'keyTimes'" : "has no poses",
          "give either a CSV file or 'keyTimes' and 'positions'");
  } else if (filename.isSet()) {
    readFile();
  } else {
    takeAttributes();
  }
}

void ScriptedDevice::readFile() {
  const auto file = scene().findInput(*this, filename);
  if (!file) return;
  std::ifstream in(*file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) return error(filename, "file-read", "cannot read '" + file->string() + "'");
  const auto problem =
      readKeyPoses(std::make_shared<const SourceText>(file->string(), text.str()), keys_);
  if (!problem) return;
  error(filename, "file-content",
        "cannot be used: " + problem->where.text() + ": " + problem->message);
  keys_.clear();
}

bool ScriptedDevice::hasCount(const AttributeBase& attribute, std::size_t count, bool oneForAll) {
  if (!attribute.isSet() || count == keyTimes->size() || (oneForAll && count == 1)) return true;
  error(attribute, "value-count",
        "has " + std::to_string(count) + " values for " + std::to_string(keyTimes->size()) +
            " key times");
  return false;
}

void ScriptedDevice::takeAttributes() {
  const std::vector<double>& q = orientations;
  if (keyTimes->empty()) return error(keyTimes, "value-count", "has no times");
  if (!std::ranges::is_sorted(*keyTimes, std::ranges::less_equal())) {
    return error(keyTimes, "value-order", "does not rise from each time to the next");
  }
  if (positions->size() != keyTimes->size()) {
    return error(positions, "value-count",
                 "has " + std::to_string(positions->size()) + " positions for " +
                     std::to_string(keyTimes->size()) + " key times");
  }
  if (orientations.isSet() && rotations.isSet()) {
    return error(rotations, "attr-conflict", "is given with 'orientations': one of them, please");
  }
  if (q.size() % 4 != 0) {
    return error(orientations, "value-count", "has numbers left over: four a quaternion, x y z w");
  }
  if (!hasCount(orientations, q.size() / 4, true) ||
      !hasCount(rotations, rotations->size(), true) || !hasCount(buttons, buttons->size(), false)) {
    return;
  }
  for (std::size_t k = 0; k < keyTimes->size(); ++k) {
    KeyPose key;
    key.time = (*keyTimes)[k];
    key.pose.position = (*positions)[k];
    if (!q.empty()) {
      const std::size_t at = q.size() == 4 ? 0 : 4 * k;
      key.pose.orientation = Quat(q[at + 3], q[at], q[at + 1], q[at + 2]);
      if (std::abs(key.pose.orientation.norm() - 1) > 1e-3) {
        return error(orientations, "value-range",
                     "quaternion " + std::to_string(k) + " does not have length 1",
                     "unit quaternions, in the order x y z w");
      }
      key.pose.orientation.normalize();
    } else if (!rotations->empty()) {
      key.pose.orientation = fromEuler((*rotations)[rotations->size() == 1 ? 0 : k]);
    }
    if (!buttons->empty()) key.buttons = static_cast<std::uint32_t>((*buttons)[k]);
    keys_.push_back(key);
  }
}

void ScriptedDevice::schedule(Schedule& schedule) {
  if (!realTime_) return;
  schedule.add<&ScriptedDevice::showNewest>(Stage::Publish, *this, "force felt");
}

void ScriptedDevice::reset() {
  if (realTime_) return;
  sequence_ = 0;
  show({});
}

ToolSample ScriptedDevice::read(double time) noexcept {
  ToolSample sample = sampleAt(keys_, time);
  sample.sequence = ++sequence_;
  return sample;
}

void ScriptedDevice::write(double, const Vec3& newForce, const Vec3& newTorque) noexcept {
  const FeltForce felt{newForce, newTorque};
  if (realTime_) {
    felt_.write(felt);
  } else {
    show(felt);
  }
}

void ScriptedDevice::show(const FeltForce& felt) {
  force.set(felt.force);
  torque.set(felt.torque);
}

void ScriptedDevice::showNewest(const StepContext&) {
  FeltForce felt;
  if (felt_.read(felt)) show(felt);
}

void ScriptedDevice::save(StateWriter& writer) const {
  if (realTime_) return;
  const std::array<Vec3, 2> felt{*force, *torque};
  writer.write("felt", ConstVec3Span(felt));
  writer.write("sequence", sequence_);
}

void ScriptedDevice::restore(StateReader& reader) {
  if (realTime_) return;
  std::array<Vec3, 2> felt{*force, *torque};
  if (!reader.read("felt", Vec3Span(felt)) || !reader.read("sequence", sequence_)) return;
  show({felt[0], felt[1]});
}

}  // namespace stroma
