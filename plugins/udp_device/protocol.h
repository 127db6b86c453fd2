// SPDX-License-Identifier: Apache-2.0
// The packets of the UDP protocol, version 1; README.md has the layout. This header needs nothing
// but the standard library: a device's host can copy it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

namespace stroma::udp {

inline constexpr std::uint32_t poseMagic = 0x50525453;   // "STRP"
inline constexpr std::uint32_t forceMagic = 0x46525453;  // "STRF"
inline constexpr std::uint16_t version = 1;
inline constexpr std::size_t poseSize = 128, forceSize = 72;

// From the device's host: where the stylus is.
struct PosePacket {
  std::uint64_t sequence = 0;                                 // rises with every packet
  std::array<double, 3> position{};                           // m
  std::array<double, 4> orientation{0, 0, 0, 1};              // quaternion x y z w
  std::array<double, 3> linearVelocity{}, angularVelocity{};  // m/s, rad/s
  std::uint32_t buttons = 0;                                  // bit 0: the trigger
};

// To the device's host, in answer to every pose that was accepted.
struct ForcePacket {
  std::uint64_t sequence = 0;               // of that pose
  std::array<double, 3> force{}, torque{};  // N, N m
};

// Little-endian numbers, one behind the other.
class Writer {
 public:
  explicit Writer(std::span<std::byte> bytes) : rest_(bytes) {}
  template <class T>
  void put(T value) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    for (std::size_t i = 0; i < sizeof(T); ++i) rest_[i] = bytes[inOrder<T>(i)];
    rest_ = rest_.subspan(sizeof(T));
  }
  template <std::size_t N>
  void put(const std::array<double, N>& values) {
    for (const double value : values) put(value);
  }
  template <class T>
  static constexpr std::size_t inOrder(std::size_t i) {
    return std::endian::native == std::endian::little ? i : sizeof(T) - 1 - i;
  }

 private:
  std::span<std::byte> rest_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <class T>
  T get() {
    std::array<std::byte, sizeof(T)> bytes;
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes[Writer::inOrder<T>(i)] = rest_[i];
    rest_ = rest_.subspan(sizeof(T));
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  template <std::size_t N>
  void get(std::array<double, N>& values) {
    for (double& value : values) value = get<double>();
  }

 private:
  std::span<const std::byte> rest_;
};

enum class Verdict { good, wrongSize, wrongMagic, wrongVersion };

// Magic, version and length at the head of a packet; only a good one is read on.
inline Verdict headOf(std::span<const std::byte> packet, std::uint32_t magic, std::size_t size) {
  if (packet.size() != size) return Verdict::wrongSize;
  Reader reader(packet);
  if (reader.get<std::uint32_t>() != magic) return Verdict::wrongMagic;
  if (reader.get<std::uint16_t>() != version) return Verdict::wrongVersion;
  return reader.get<std::uint16_t>() == size ? Verdict::good : Verdict::wrongSize;
}

inline std::array<std::byte, poseSize> encode(const PosePacket& pose) {
  std::array<std::byte, poseSize> packet{};
  Writer writer(packet);
  writer.put(poseMagic);
  writer.put(version);
  writer.put(static_cast<std::uint16_t>(poseSize));
  writer.put(pose.sequence);
  writer.put(pose.position);
  writer.put(pose.orientation);
  writer.put(pose.linearVelocity);
  writer.put(pose.angularVelocity);
  writer.put(pose.buttons);
  writer.put(std::uint32_t{0});
  return packet;
}

// Expects a packet whose head is good.
inline PosePacket decodePose(std::span<const std::byte> packet) {
  PosePacket pose;
  Reader reader(packet.subspan(8));
  pose.sequence = reader.get<std::uint64_t>();
  reader.get(pose.position);
  reader.get(pose.orientation);
  reader.get(pose.linearVelocity);
  reader.get(pose.angularVelocity);
  pose.buttons = reader.get<std::uint32_t>();
  return pose;
}

inline std::array<std::byte, forceSize> encode(const ForcePacket& force) {
  std::array<std::byte, forceSize> packet{};
  Writer writer(packet);
  writer.put(forceMagic);
  writer.put(version);
  writer.put(static_cast<std::uint16_t>(forceSize));
  writer.put(force.sequence);
  writer.put(force.force);
  writer.put(force.torque);
  writer.put(std::uint64_t{0});
  return packet;
}

// Nothing when the packet is no force packet of this version.
inline std::optional<ForcePacket> decodeForce(std::span<const std::byte> packet) {
  if (headOf(packet, forceMagic, forceSize) != Verdict::good) return std::nullopt;
  ForcePacket force;
  Reader reader(packet.subspan(8));
  force.sequence = reader.get<std::uint64_t>();
  reader.get(force.force);
  reader.get(force.torque);
  return force;
}

}  // namespace stroma::udp
