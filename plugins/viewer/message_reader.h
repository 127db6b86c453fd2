// SPDX-License-Identifier: Apache-2.0
// Messages of a page (protocol.md), read from text that anybody may have sent.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/interfaces/haptic_device.h"

namespace stroma::viewer {

struct PageMessage {
  enum class Type {
    play,
    pause,
    reset,
    undo,
    reload,
    revert,
    step,
    speed,
    rewind,
    set,
    replace,
    take,
    equip,
    pose,
    look,
    watch,
    neighbours,
    alternatives,
    save,
    picture,
    steer
  };
  Type type = Type::pause;
  std::uint64_t n = 0;  // 0: no answer is wanted
  std::string path{};   // of an attribute, a component, a tool or a state
  std::string text{};   // value, element, field, kind of tool, what to save, picture (base64)
  double number = 0;    // speed, time, steps
  int body = -1;
  Index particle = -1;
  Pose pose{};
  std::uint32_t buttons = 0;
  bool jump = false, particles = false, timing = false, energy = false;
  // Whether it changes what all who watch see.
  [[nodiscard]] bool steers() const;
};

// Reads one message. Returns what is wrong with it, or "". Numbers are finite, quaternions of
// length 1, counts within reason.
[[nodiscard]] std::string readMessage(std::string_view text, PageMessage& message);

}  // namespace stroma::viewer
