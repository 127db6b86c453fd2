// SPDX-License-Identifier: Apache-2.0
#pragma once

// Before Asio of Boost 1.74, which relies on others to bring it along.
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <chrono>
#include <optional>
#include <thread>

#include "plugins/udp_device/protocol.h"
#include "plugins/udp_device/udp_device.h"

namespace stroma {

// Receives poses and answers each with the newest force, in a thread of its own.
class UdpDevice::Network {
 public:
  struct Limits {
    double position;  // m
    double timeout;   // s
  };
  struct Counts {
    std::atomic<int> accepted{0}, malformed{0}, implausible{0}, outdated{0}, foreign{0};
  };

  Network(TripleBuffer<ToolSample>& samples, TripleBuffer<DevicePush>& forces, const Limits& limits)
      : samples_(samples), forces_(forces), limits_(limits), socket_(context_) {}
  ~Network();

  struct Problem {
    std::string text;
    bool ofAddress = false;  // rather than of the port
  };
  // Starts listening, or says why not.
  [[nodiscard]] std::optional<Problem> open(const std::string& address, int port);
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  using Clock = std::chrono::steady_clock;
  void receive();
  void take(std::span<const std::byte> packet);
  [[nodiscard]] bool isPlausible(const udp::PosePacket& pose) const;
  void answer(std::uint64_t sequence);

  TripleBuffer<ToolSample>& samples_;
  TripleBuffer<DevicePush>& forces_;
  const Limits limits_;
  boost::asio::io_context context_;
  boost::asio::ip::udp::socket socket_;
  std::jthread thread_;
  int port_ = 0;
  Counts counts_;

  // of the network's thread; a byte more than any good packet, so that longer ones show
  std::array<std::byte, udp::poseSize + 1> buffer_{};
  boost::asio::ip::udp::endpoint sender_, peer_;
  bool hasPeer_ = false;
  Clock::time_point heard_;
  std::uint64_t sequence_ = 0, samplesTaken_ = 0;
  DevicePush force_;
};

}  // namespace stroma
