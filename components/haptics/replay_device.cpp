// SPDX-License-Identifier: Apache-2.0
#include "components/haptics/replay_device.h"

#include <algorithm>
#include <fstream>

#include "core/scene.h"

namespace stroma {

void ReplayDevice::bind() {
  const auto file = scene().findInput(*this, filename);
  if (!file) return;
  std::ifstream stream(*file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (const std::string problem = readSession(text, frames_); !problem.empty()) {
    error(filename, "session-format", problem);
  } else if (frames_.empty()) {
    error(filename, "session-format", "has no step");
  }
  frameCount.set(static_cast<int>(frames_.size()));
  newest_ = 0;
}

ToolSample ReplayDevice::read(double time) noexcept {
  while (newest_ > 0 && frames_[newest_].device.time > time) --newest_;
  while (newest_ + 1 < frames_.size() && frames_[newest_ + 1].device.time <= time) ++newest_;
  ToolSample sample = frames_[newest_].device;
  sample.time = time;
  return sample;
}

const SessionFrame* ReplayDevice::frame(std::uint64_t step) const {
  const auto at = std::ranges::lower_bound(frames_, step, {}, &SessionFrame::step);
  return at != frames_.end() && at->step == step ? &*at : nullptr;
}

}  // namespace stroma
