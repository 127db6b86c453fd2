// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/frame_encoder.h"

#include <algorithm>
#include <bit>
#include <boost/pending/disjoint_sets.hpp>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>

#include "plugins/viewer/json_text.h"

namespace stroma::viewer {
namespace {

using Json = nlohmann::json;
static_assert(std::endian::native == std::endian::little, "the protocol is little endian");

constexpr std::uint32_t topologyKind = 1, frameKind = 2;

// Arrays one behind another, each at a multiple of 4, and their list.
class Payload {
 public:
  template <class T>
  Json add(const char* name, const char* type, std::span<const T> values) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const std::size_t offset = bytes_.size();
    bytes_.resize(offset + values.size_bytes());
    if (!values.empty()) std::memcpy(bytes_.data() + offset, values.data(), values.size_bytes());
    return {{"name", name}, {"type", type}, {"count", values.size()}, {"offset", offset}};
  }

  // Points as 16-bit numbers in the box that they fill.
  Json addPoints(std::span<const float> points) {
    std::array<float, 3> low{}, high{};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t axis = i % 3;
      low[axis] = i < 3 ? points[i] : std::min(low[axis], points[i]);
      high[axis] = i < 3 ? points[i] : std::max(high[axis], points[i]);
    }
    std::array<float, 3> scale{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float size = high[axis] - low[axis];
      scale[axis] = size > 0 ? 65535.0f / size : 0.0f;
    }
    numbers_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t axis = i % 3;
      const float part = (points[i] - low[axis]) * scale[axis];
      numbers_[i] = part > 0 ? static_cast<std::uint16_t>(std::min(part + 0.5f, 65535.0f)) : 0;
    }
    Json array = add("position", "u16box", std::span<const std::uint16_t>(numbers_));
    array["low"] = low;
    array["high"] = high;
    return array;
  }

  [[nodiscard]] std::string message(std::uint32_t kind, const Json& header) const {
    std::string text = dumped(header);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::array<std::uint32_t, 2> start{kind, static_cast<std::uint32_t>(text.size())};
    std::string all(sizeof(start) + text.size() + bytes_.size(), '\0');
    std::memcpy(all.data(), start.data(), sizeof(start));
    std::ranges::copy(text, all.begin() + sizeof(start));
    if (!bytes_.empty()) {
      std::memcpy(all.data() + sizeof(start) + text.size(), bytes_.data(), bytes_.size());
    }
    return all;
  }

 private:
  std::vector<std::byte> bytes_;
  std::vector<std::uint16_t> numbers_;
};

Json json(const Vec3& a) { return {a.x(), a.y(), a.z()}; }

Json json(const ToolCopy& tool) {
  const auto& q = tool.pose.orientation;
  Json contacts = Json::array();
  for (const Contact& contact : tool.contacts) {
    contacts.push_back({{"p", json(contact.point)},
                        {"n", json(contact.normal)},
                        {"force", json(contact.force)},
                        {"depth", contact.depth}});
  }
  return {
      {"path", tool.path},     {"p", json(tool.pose.position)}, {"q", {q.x(), q.y(), q.z(), q.w()}},
      {"active", tool.active}, {"force", json(tool.force)},     {"contacts", std::move(contacts)}};
}

}  // namespace

std::vector<std::uint32_t> piecesOf(std::span<const std::uint32_t> triangles, std::size_t points) {
  std::vector<std::size_t> parent(points), rank(points, 0);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  boost::disjoint_sets<std::size_t*, std::size_t*> sets(rank.data(), parent.data());
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    sets.union_set(triangles[t], triangles[t + 1]);
    sets.union_set(triangles[t], triangles[t + 2]);
  }
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> number(points, none), pieces;
  std::uint32_t next = 0;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    std::uint32_t& own = number[sets.find_set(triangles[t])];
    if (own == none) own = next++;
    pieces.push_back(own);
  }
  return pieces;
}

std::string encode(const TopologyCopy& topology) {
  Payload payload;
  Json arrays = Json::array();
  arrays.push_back(payload.add<float>("rest", "f32", topology.rest));
  if (!topology.triangles.empty()) {
    arrays.push_back(payload.add<std::uint32_t>("triangles", "u32", topology.triangles));
    const auto pieces = piecesOf(topology.triangles, topology.rest.size() / 3);
    arrays.push_back(payload.add<std::uint32_t>("pieces", "u32", pieces));
  }
  if (!topology.walls.empty()) {
    arrays.push_back(payload.add<std::uint8_t>("walls", "u8", topology.walls));
  }
  if (!topology.texture.empty()) {
    arrays.push_back(payload.add<float>("texture", "f32", topology.texture));
  }
  return payload.message(topologyKind, {{"generation", topology.generation},
                                        {"body", topology.body},
                                        {"revision", topology.revision},
                                        {"arrays", std::move(arrays)}});
}

std::string encode(const FrameCopy& frame) {
  Payload payload;
  Json bodies = Json::array(), tools = Json::array();
  for (const BodyCopy& body : frame.bodies) {
    Json arrays = Json::array({payload.addPoints(body.positions)});
    for (const FieldCopy& field : body.fields) {
      arrays.push_back(payload.add<float>("field", "f32", field.values));
      arrays.back()["field"] = field.name;
    }
    bodies.push_back(
        {{"body", body.body}, {"revision", body.revision}, {"arrays", std::move(arrays)}});
  }
  for (const ToolCopy& tool : frame.tools) tools.push_back(json(tool));
  return payload.message(frameKind, {{"generation", frame.generation},
                                     {"time", frame.time},
                                     {"step", frame.step},
                                     {"bodies", std::move(bodies)},
                                     {"tools", std::move(tools)}});
}

}  // namespace stroma::viewer
