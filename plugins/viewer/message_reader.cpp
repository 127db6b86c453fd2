// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/message_reader.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace stroma::viewer {
namespace {

using Json = nlohmann::json;
using Type = PageMessage::Type;

constexpr std::array<std::pair<std::string_view, Type>, 21> names = {
    {{"play", Type::play},
     {"pause", Type::pause},
     {"reset", Type::reset},
     {"undo", Type::undo},
     {"reload", Type::reload},
     {"revert", Type::revert},
     {"step", Type::step},
     {"speed", Type::speed},
     {"rewind", Type::rewind},
     {"set", Type::set},
     {"replace", Type::replace},
     {"take", Type::take},
     {"equip", Type::equip},
     {"pose", Type::pose},
     {"look", Type::look},
     {"watch", Type::watch},
     {"neighbours", Type::neighbours},
     {"alternatives", Type::alternatives},
     {"save", Type::save},
     {"picture", Type::picture},
     {"steer", Type::steer}}};

// Members of one message; the first problem is kept.
class Members {
 public:
  explicit Members(const Json& json) : json_(json) {}
  [[nodiscard]] const std::string& problem() const { return problem_; }

  [[nodiscard]] bool has(const char* name) const { return json_.contains(name); }
  std::string text(const char* name) {
    const auto at = json_.find(name);
    if (at != json_.end() && at->is_string()) return at->get<std::string>();
    return fail<std::string>(name, "a text");
  }
  double number(const char* name, double least, double most) {
    const auto at = json_.find(name);
    if (at != json_.end() && at->is_number()) {
      const double value = at->get<double>();
      if (value >= least && value <= most) return value;
    }
    return fail<double>(name, "a number in its range");
  }
  template <class Whole>
  Whole whole(const char* name, Whole least, Whole most) {
    const auto at = json_.find(name);
    if (at != json_.end() && at->is_number_integer() &&
        (at->is_number_unsigned() || at->get<std::int64_t>() >= 0)) {
      const auto value = at->get<std::uint64_t>();
      if (value >= static_cast<std::uint64_t>(least) && value <= static_cast<std::uint64_t>(most)) {
        return static_cast<Whole>(value);
      }
    }
    return fail<Whole>(name, "a whole number in its range");
  }
  bool flag(const char* name) {  // false where it is missing
    const auto at = json_.find(name);
    if (at == json_.end()) return false;
    return at->is_boolean() ? at->get<bool>() : fail<bool>(name, "true or false");
  }
  template <std::size_t N>
  std::array<double, N> numbers(const char* name) {
    std::array<double, N> values{};
    const auto at = json_.find(name);
    bool good = at != json_.end() && at->is_array() && at->size() == N;
    for (std::size_t i = 0; good && i < N; ++i) {
      good = (*at)[i].is_number();
      if (good) values[i] = (*at)[i].get<double>();
      good = good && std::abs(values[i]) < 1e6;
    }
    if (!good) fail<bool>(name, std::to_string(N) + " numbers");
    return values;
  }
  void refuse(const char* name, const std::string& wanted) { fail<bool>(name, wanted); }

 private:
  template <class T>
  T fail(const char* name, const std::string& wanted) {
    if (problem_.empty()) problem_ = std::string("'") + name + "' must be " + wanted;
    return T{};
  }
  const Json& json_;
  std::string problem_;
};

void readPose(Members& members, PageMessage& message) {
  const auto p = members.numbers<3>("p");
  const auto q = members.numbers<4>("q");
  const Quat turn(q[3], q[0], q[1], q[2]);
  const double length = turn.norm();
  if (!(std::abs(length - 1) < 1e-2)) return members.refuse("q", "a unit quaternion x y z w");
  message.path = members.text("tool");
  message.pose.position = {p[0], p[1], p[2]};
  message.pose.orientation = turn.normalized();
  message.buttons = members.whole<std::uint32_t>("buttons", 0, 255);
  message.jump = members.flag("jump");
}

void readMembers(Members& members, PageMessage& m) {
  constexpr int mostBodies = 1 << 16;
  switch (m.type) {
    case Type::step:
      m.number = members.whole<int>("count", 1, 100000);
      break;
    case Type::speed:
      m.number = members.number("value", 1e-6, 1e6);
      break;
    case Type::rewind:
      m.number = members.number("time", -1e12, 1e12);
      break;
    case Type::set:
      m.path = members.text("path");
      m.text = members.text("value");
      break;
    case Type::replace:
      m.path = members.text("path");
      m.text = members.text("with");
      break;
    case Type::take:
      m.path = members.text("tool");
      break;
    case Type::equip:
      m.text = members.text("tool");
      m.path = members.text("surface");
      if (m.text != "pull" && m.text != "probe") members.refuse("tool", "pull or probe");
      break;
    case Type::pose:
      readPose(members, m);
      break;
    case Type::look:
      m.body = members.whole<int>("body", 0, mostBodies);
      m.text = members.text("field");
      m.particles = members.flag("particles");
      break;
    case Type::watch:
      m.timing = members.flag("timing");
      m.energy = members.flag("energy");
      break;
    case Type::neighbours:
      m.body = members.whole<int>("body", 0, mostBodies);
      m.particle = members.whole<Index>("particle", 0, std::numeric_limits<Index>::max());
      break;
    case Type::alternatives:
      m.path = members.text("path");
      break;
    case Type::save:
      m.text = members.text("what");
      if (m.text != "scene" && m.text != "recording") {
        members.refuse("what", "scene or recording");
      }
      break;
    case Type::picture:
      if (members.has("problem")) {
        m.path = members.text("problem");
      } else {
        m.text = members.text("png");
      }
      break;
    default:
      break;
  }
}

}  // namespace

bool PageMessage::steers() const {
  switch (type) {
    case Type::look:
    case Type::watch:
    case Type::neighbours:
    case Type::alternatives:
    case Type::save:
    case Type::picture:
    case Type::steer:
      return false;
    default:
      return true;
  }
}

std::string readMessage(std::string_view text, PageMessage& message) {
  // deeper nesting than any message has would cost the parser's stack
  int depth = 0;
  const auto shallow = [&](int, Json::parse_event_t event, Json&) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start || event == Event::array_start) ++depth;
    if (event == Event::object_end || event == Event::array_end) --depth;
    return depth <= 3;
  };
  const Json json = Json::parse(text, shallow, false);
  if (!json.is_object()) return "is not a JSON object";
  const auto type = json.find("type");
  if (type == json.end() || !type->is_string()) return "has no type";
  const auto known = std::ranges::find(names, type->get_ref<const std::string&>(),
                                       [](const auto& entry) { return std::string(entry.first); });
  if (known == names.end()) return "has an unknown type";
  message = {};
  message.type = known->second;
  Members members(json);
  if (json.contains("n")) message.n = members.whole<std::uint64_t>("n", 1, 1ull << 53);
  readMembers(members, message);
  return members.problem();
}

}  // namespace stroma::viewer
