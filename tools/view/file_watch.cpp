// SPDX-License-Identifier: Apache-2.0
#include "tools/view/file_watch.h"

namespace stroma::view {
namespace fs = std::filesystem;

void FileWatch::watch(std::vector<fs::path> files) {
  files_ = std::move(files);
  known_ = last_ = marks();
}

std::vector<FileWatch::Mark> FileWatch::marks() const {
  std::vector<Mark> all;
  for (const fs::path& file : files_) {
    std::error_code gone;  // an editor may be replacing it
    Mark mark;
    mark.time = fs::last_write_time(file, gone);
    if (!gone) mark.size = fs::file_size(file, gone);
    all.push_back(gone ? Mark{} : mark);
  }
  return all;
}

bool FileWatch::changed() {
  const auto now = Clock::now();
  if (now < next_) return false;
  next_ = now + std::chrono::milliseconds(150);
  std::vector<Mark> marks = this->marks();
  const bool still = marks == last_;
  last_ = std::move(marks);
  if (!still || last_ == known_) return false;
  known_ = last_;
  return true;
}

}  // namespace stroma::view
