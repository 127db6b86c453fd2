// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>

#include "core/channel.h"
#include "core/interfaces/haptic_device.h"

namespace stroma {

// What a device is to give to its hand.
struct DevicePush {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();  // N, N m
};

// A device whose host sends poses by UDP and gets forces back; README.md has the protocol. A thread
// of its own talks to the network, and exchanges values with the haptic thread through wait-free
// buffers. Packets that are not exactly right change nothing and are counted.
//
// The first host that sends a valid pose is the device until it has been silent for `peerTimeout`;
// packets from others are counted, not read.
class UdpDevice final : public HapticDevice {
 public:
  UdpDevice();
  ~UdpDevice() override;

  Attribute<std::string> address{
      this, "address", "127.0.0.1",
      "Address to listen at. Others than the loopback open the device to the network: the protocol "
      "has no password."};
  Attribute<int> port{this,
                      "port",
                      47800,
                      "UDP port to listen at; 0 = one that is free, see boundPort.",
                      {.min = 0, .max = 65535}};
  Attribute<double> peerTimeout{this,
                                "peerTimeout",
                                1.0,
                                "Silence after which another host may be the device.",
                                {.unit = "s", .min = 0.01, .max = 3600}};
  Attribute<double> maxPosition{this,
                                "maxPosition",
                                10.0,
                                "Positions farther from the device's origin are no positions.",
                                {.unit = "m", .min = 0, .exclusiveMin = true}};
  Attribute<Vec3> home{this,
                       "home",
                       Vec3::Zero(),
                       "Where the stylus is taken to be before the first packet.",
                       {.unit = "m"}};

  Attribute<int> boundPort{this, "boundPort", 0, "Port that is listened at.", {.output = true}};
  Attribute<int> accepted{this, "accepted", 0, "Packets that moved the stylus.", {.output = true}};
  Attribute<int> malformed{this,
                           "malformed",
                           0,
                           "Packets of a wrong length, magic number or version.",
                           {.output = true}};
  Attribute<int> implausible{this,
                             "implausible",
                             0,
                             "Packets with a pose or a velocity that cannot be.",
                             {.output = true}};
  Attribute<int> outdated{
      this, "outdated", 0, "Packets with a sequence number that had passed.", {.output = true}};
  Attribute<int> foreign{this,
                         "foreign",
                         0,
                         "Packets from others than the host that is the device.",
                         {.output = true}};

  void start() override;
  void stop() override;
  void schedule(Schedule& schedule) override;

  [[nodiscard]] ToolSample read(double time) noexcept override;
  void write(double time, const Vec3& force, const Vec3& torque) noexcept override;

 private:
  class Network;  // socket and thread
  void showCounts(const StepContext&);

  TripleBuffer<ToolSample> samples_;
  TripleBuffer<DevicePush> forces_;
  ToolSample newest_;  // of the haptic side
  std::unique_ptr<Network> network_;
};

}  // namespace stroma
