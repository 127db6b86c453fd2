// SPDX-License-Identifier: Apache-2.0
#include "tools/stroma/study_progress.h"

#include <unistd.h>

#include <cstdio>

namespace stroma::cli {

StudyProgress::StudyProgress(std::size_t total)
    : total_(total), terminal_(isatty(STDERR_FILENO) == 1) {}

void StudyProgress::started(const study::Job& job) {
  current_ = job.label;
  tick();
}

void StudyProgress::finished(const study::Job& job, const study::Json& result) {
  ++done_;
  clear();
  std::string what = result["status"].get<std::string>();
  if (what == "done") {
    char text[64];
    std::snprintf(text, sizeof text, "%.4g ms a step",
                  result["ms_per_step"]["median"].get<double>());
    what = text;
  } else {
    what += ": " + result["message"].get<std::string>();
  }
  std::fprintf(stderr, "%zu/%zu  %s  %s\n", done_, total_, job.label.c_str(), what.c_str());
  tick();
}

void StudyProgress::tick() const {
  if (!terminal_ || done_ == total_) return;
  constexpr std::size_t width = 30;
  const std::size_t filled = width * done_ / total_;
  std::string left = "";
  if (done_ > 0) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - begin_).count();
    const double each = elapsed / static_cast<double>(done_);
    const auto seconds = static_cast<long>(each * static_cast<double>(total_ - done_) + 0.5);
    char text[48];
    std::snprintf(text, sizeof text, "  about %ld:%02ld left", seconds / 60, seconds % 60);
    left = text;
  }
  std::fprintf(stderr, "\r[%s%s] %zu of %zu%s  %.60s\033[K", std::string(filled, '#').c_str(),
               std::string(width - filled, '.').c_str(), done_, total_, left.c_str(),
               current_.c_str());
}

void StudyProgress::clear() const {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

}  // namespace stroma::cli
