// SPDX-License-Identifier: Apache-2.0
#include "components/tools/key_poses.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/diagnostics.h"
#include "core/rigid_motion.h"

namespace stroma {
namespace {

// Times of steps are products: a key that is this near (s) counts as met.
constexpr double timeRounding = 1e-9;

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return text.substr(text.size());
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = line.find(',');
    parts.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    line.remove_prefix(comma + 1);
  }
}

struct Columns {
  std::size_t count = 4;
  bool turns = false, buttons = false;
};

class Table {
 public:
  explicit Table(std::shared_ptr<const SourceText> source) : source_(std::move(source)) {}

  std::optional<TableProblem> read(std::vector<KeyPose>& keys) {
    bool named = false;
    for (int n = 1; n <= source_->lineCount(); ++n) {
      const std::string_view line = trimmed(source_->line(n));
      if (line.empty() || line.front() == '#') continue;
      if (!named) {
        if (!readHeader(line)) return problem_;
        named = true;
      } else if (!readRow(line, keys)) {
        return problem_;
      }
    }
    if (keys.empty()) return TableProblem{{source_, 0, 0}, "has no poses"};
    return std::nullopt;
  }

 private:
  bool fail(std::string_view at, std::string message) {
    problem_ = {{source_, static_cast<std::size_t>(at.data() - source_->text().data()), at.size()},
                std::move(message)};
    return false;
  }

  bool readHeader(std::string_view line) {
    constexpr std::array<std::string_view, 9> all = {"time", "x",  "y",  "z",      "qx",
                                                     "qy",   "qz", "qw", "buttons"};
    const auto names = cells(line);
    columns_.turns = names.size() >= 8;
    columns_.buttons = names.size() == 5 || names.size() == 9;
    columns_.count = names.size();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool last = columns_.buttons && i + 1 == names.size();
      const std::string_view expected = last ? all.back() : i < 8 ? all[i] : "";
      if (expected.empty()) return fail(names[i], "a column too many");
      if (names[i] != expected) {
        return fail(names[i], "column " + std::to_string(i + 1) + " is " + quoted(names[i]) +
                                  " instead of '" + std::string(expected) +
                                  "'; the columns are time,x,y,z[,qx,qy,qz,qw][,buttons]");
      }
    }
    if (names.size() < 4 || names.size() == 6 || names.size() == 7) {
      return fail(line, "has " + std::to_string(names.size()) +
                            " columns; they are time,x,y,z[,qx,qy,qz,qw][,buttons]");
    }
    return true;
  }

  bool readRow(std::string_view line, std::vector<KeyPose>& keys) {
    const auto parts = cells(line);
    if (parts.size() != columns_.count) {
      return fail(line, "has " + std::to_string(parts.size()) + " values for " +
                            std::to_string(columns_.count) + " columns");
    }
    std::array<double, 8> value{0, 0, 0, 0, 0, 0, 0, 1};
    const std::size_t numbers = columns_.turns ? 8 : 4;
    for (std::size_t i = 0; i < numbers; ++i) {
      if (!number(parts[i], value[i]) || !std::isfinite(value[i])) {
        return fail(parts[i], quoted(parts[i]) + " is not a finite number");
      }
    }
    KeyPose key;
    key.time = value[0];
    key.pose.position = {value[1], value[2], value[3]};
    key.pose.orientation = Quat(value[7], value[4], value[5], value[6]);
    if (std::abs(key.pose.orientation.norm() - 1) > 1e-3) {
      return fail(parts[4], "the quaternion's length is not 1");
    }
    // what is of unit length to rounding keeps its bits
    if (std::abs(key.pose.orientation.norm() - 1) > 1e-14) key.pose.orientation.normalize();
    if (columns_.buttons && !number(parts.back(), key.buttons)) {
      return fail(parts.back(), quoted(parts.back()) + " is not a whole number");
    }
    if (!keys.empty() && !(key.time > keys.back().time)) {
      return fail(parts[0], "the time does not rise");
    }
    keys.push_back(key);
    return true;
  }

  template <class Number>
  static bool number(std::string_view word, Number& out) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), out);
    return failure == std::errc() && end == word.data() + word.size();
  }

  std::shared_ptr<const SourceText> source_;
  Columns columns_;
  TableProblem problem_;
};

}  // namespace

ToolSample sampleAt(std::span<const KeyPose> keys, double time) {
  ToolSample sample;
  sample.time = time;
  const auto pressed = std::ranges::upper_bound(keys, time + timeRounding, {}, &KeyPose::time);
  if (pressed != keys.begin()) sample.buttons = std::prev(pressed)->buttons;

  const auto end = std::ranges::lower_bound(keys, time - timeRounding, {}, &KeyPose::time);
  if (end == keys.begin() || end == keys.end()) {
    sample.pose = end == keys.begin() ? keys.front().pose : keys.back().pose;
    return sample;
  }
  const KeyPose &a = *std::prev(end), &b = *end;
  const double duration = b.time - a.time, s = std::min(1.0, (time - a.time) / duration);
  const Vec3 turn = rotationVector(a.pose.orientation, b.pose.orientation);
  sample.pose.position = (1 - s) * a.pose.position + s * b.pose.position;
  sample.pose.orientation = s < 1 ? rotated(a.pose.orientation, s * turn) : b.pose.orientation;
  sample.linearVelocity = (b.pose.position - a.pose.position) / duration;
  sample.angularVelocity = turn / duration;
  return sample;
}

std::optional<TableProblem> readKeyPoses(std::shared_ptr<const SourceText> text,
                                         std::vector<KeyPose>& keys) {
  return Table(std::move(text)).read(keys);
}

}  // namespace stroma
