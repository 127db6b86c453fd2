// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "components/haptics/session.h"

namespace stroma {

// A recorded session, played again. A HapticController moves its tool as the recording says, step
// by step, so that the simulation has the same bits, however the session was run; forces are
// computed anew from the device's samples and go nowhere. Before its first and after its last step
// the tool stays where it is.
class ReplayDevice final : public HapticDevice {
 public:
  Attribute<FilePath> filename{
      this, "filename", {}, "Session that a HapticController recorded.", {.required = true}};
  Attribute<int> frameCount{this, "frameCount", 0, "Steps in the session.", {.output = true}};

  void bind() override;

  // The newest sample of the session that is not later than `time`.
  [[nodiscard]] ToolSample read(double time) noexcept override;
  void write(double, const Vec3&, const Vec3&) noexcept override {}

  // What the simulation took in this step; null where nothing was recorded.
  [[nodiscard]] const SessionFrame* frame(std::uint64_t step) const;

 private:
  std::vector<SessionFrame> frames_;
  std::size_t newest_ = 0;  // frame of the last read
};

}  // namespace stroma
