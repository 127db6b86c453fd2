// SPDX-License-Identifier: Apache-2.0
#include "tools/stroma/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace stroma::cli {

ProgressBar::ProgressBar(std::uint64_t first, std::uint64_t last, double endTime)
    : first_(first), last_(last), endTime_(endTime), enabled_(isatty(STDERR_FILENO) == 1) {}

void ProgressBar::show(std::uint64_t step, double time) {
  if (!enabled_) return;
  const auto now = Clock::now();
  if (now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  constexpr int width = 30;
  const double fraction = static_cast<double>(step - first_) /
                          static_cast<double>(std::max(last_ - first_, std::uint64_t{1}));
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  const auto left = static_cast<long>(elapsed * (1 - fraction) / fraction + 0.5);
  const auto filled = static_cast<std::size_t>(width * fraction);
  std::fprintf(stderr, "\r[%s%s] %3.0f %%  %.4g of %.4g s simulated  %ld:%02ld left \033[K",
               std::string(filled, '#').c_str(), std::string(width - filled, '.').c_str(),
               100 * fraction, time, endTime_, left / 60, left % 60);
}

void ProgressBar::clear() {
  if (enabled_) std::fputs("\r\033[K", stderr);
}

}  // namespace stroma::cli
