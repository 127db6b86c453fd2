// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

namespace stroma::view {

// Tells when files were written anew, by their times and sizes: a few times a second, and only once
// they have stood still, so that nobody reads half a file.
class FileWatch {
 public:
  void watch(std::vector<std::filesystem::path> files);
  // True once after a change. Cheap to call in every step.
  [[nodiscard]] bool changed();

 private:
  using Clock = std::chrono::steady_clock;
  struct Mark {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    bool operator==(const Mark&) const = default;
  };
  [[nodiscard]] std::vector<Mark> marks() const;

  std::vector<std::filesystem::path> files_;
  std::vector<Mark> known_, last_;
  Clock::time_point next_{};
};

}  // namespace stroma::view
