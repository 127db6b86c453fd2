// SPDX-License-Identifier: Apache-2.0
#include "components/haptics/session.h"

#include <array>
#include <charconv>

namespace stroma {
namespace {

constexpr std::string_view firstLine = "stroma-session 1";
constexpr std::string_view columns =
    "step epoch buttons | tool position, orientation (x y z w) | device time, sequence, position, "
    "orientation, linear and angular velocity | force";

class LineWriter {
 public:
  LineWriter& operator<<(std::uint64_t value) {
    std::array<char, 24> text;
    return add({text.data(), std::to_chars(text.begin(), text.end(), value).ptr});
  }
  LineWriter& operator<<(double value) {
    std::array<char, 40> text;
    return add(
        {text.data(), std::to_chars(text.begin(), text.end(), value, std::chars_format::hex).ptr});
  }
  LineWriter& operator<<(const Vec3& v) { return *this << v.x() << v.y() << v.z(); }
  LineWriter& operator<<(const Quat& q) { return *this << q.x() << q.y() << q.z() << q.w(); }
  LineWriter& operator<<(const Pose& pose) { return *this << pose.position << pose.orientation; }
  [[nodiscard]] std::string line() const { return line_ + '\n'; }

 private:
  LineWriter& add(std::string_view word) {
    if (!line_.empty()) line_ += ' ';
    line_ += word;
    return *this;
  }
  std::string line_;
};

// Reads what LineWriter wrote; every value after a bad one is left alone.
class LineReader {
 public:
  explicit LineReader(std::string_view line) : rest_(line) {}
  template <class T>
  requires std::is_unsigned_v<T> LineReader& operator>>(T& value) {
    const std::string_view word = next();
    return check(word, std::from_chars(word.data(), word.data() + word.size(), value));
  }
  LineReader& operator>>(double& value) {
    const std::string_view word = next();
    return check(word, std::from_chars(word.data(), word.data() + word.size(), value,
                                       std::chars_format::hex));
  }
  LineReader& operator>>(Vec3& v) { return *this >> v.x() >> v.y() >> v.z(); }
  LineReader& operator>>(Quat& q) { return *this >> q.x() >> q.y() >> q.z() >> q.w(); }
  LineReader& operator>>(Pose& pose) { return *this >> pose.position >> pose.orientation; }
  [[nodiscard]] bool complete() const { return good_ && rest_.empty(); }

 private:
  std::string_view next() {
    const std::size_t end = rest_.find(' ');
    const std::string_view word = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    return word;
  }
  LineReader& check(std::string_view word, std::from_chars_result result) {
    good_ = good_ && result.ec == std::errc() && result.ptr == word.data() + word.size();
    return *this;
  }
  std::string_view rest_;
  bool good_ = true;
};

// Cuts the first line off the text.
std::string_view takeLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool isUsable(const SessionFrame& f) {
  return f.tool.position.allFinite() && f.tool.orientation.coeffs().allFinite();
}

}  // namespace

std::string sessionHeader() {
  return std::string(firstLine) + "\n# " + std::string(columns) + "\n";
}

std::string sessionLine(const SessionFrame& f) {
  LineWriter line;
  line << f.step << std::uint64_t{f.epoch} << std::uint64_t{f.buttons} << f.tool << f.device.time
       << f.device.sequence << f.device.pose << f.device.linearVelocity << f.device.angularVelocity
       << f.force;
  return line.line();
}

std::string readSession(std::string_view text, std::vector<SessionFrame>& frames) {
  frames.clear();
  if (takeLine(text) != firstLine) {
    return "is no session: its first line is not '" + std::string(firstLine) + "'";
  }
  for (int number = 2; !text.empty(); ++number) {
    const std::string_view line = takeLine(text);
    if (line.empty() || line.starts_with('#')) continue;
    SessionFrame f;
    LineReader reader(line);
    reader >> f.step >> f.epoch >> f.buttons >> f.tool >> f.device.time >> f.device.sequence >>
        f.device.pose >> f.device.linearVelocity >> f.device.angularVelocity >> f.force;
    f.device.buttons = f.buttons;
    const bool rising = frames.empty() || f.step > frames.back().step;
    if (!reader.complete() || !isUsable(f) || !rising) {
      return "cannot be read: line " + std::to_string(number) +
             (rising ? " has other than the columns named at its head" : " goes back in time");
    }
    frames.push_back(f);
  }
  return "";
}

}  // namespace stroma
