// SPDX-License-Identifier: Apache-2.0
// A session with a device: what the simulation took from the haptic side in each step, and so all
// that it needs to make the same step again, bit for bit.
//
// The file is text: a first line "stroma-session 1", a line that names the columns, then a line a
// step. Numbers are hexadecimal floating point as std::to_chars writes it ("1.8p+1" is 3), which
// lose nothing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/interfaces/haptic_device.h"

namespace stroma {

struct SessionFrame {
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;  // changes when the tool was set, not moved, to its pose
  std::uint32_t buttons = 0;
  Pose tool;                  // of the proxy, in the scene
  ToolSample device;          // the sample behind it
  Vec3 force = Vec3::Zero();  // given to the device (N)
};

// The first two lines of a session file.
[[nodiscard]] std::string sessionHeader();
// One line with its end.
[[nodiscard]] std::string sessionLine(const SessionFrame& frame);

// Reads a session; frames come with rising steps. Returns what is wrong with the text, with its
// line, or "".
[[nodiscard]] std::string readSession(std::string_view text, std::vector<SessionFrame>& frames);

}  // namespace stroma
