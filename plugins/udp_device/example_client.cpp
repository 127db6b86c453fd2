// SPDX-License-Identifier: Apache-2.0
// The host of a device, as an example to copy: it needs protocol.h and POSIX sockets. Instead of a
// device's driver it has a stylus that goes up and down by 10 mm; put your driver's calls where
// `Device` is.
//
//   stroma run plugins/udp_device/example.xml --real-time
//   udp-example-client 127.0.0.1 47800 5
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "plugins/udp_device/protocol.h"

namespace {

using Clock = std::chrono::steady_clock;
namespace udp = stroma::udp;

// Put your driver here: HD_CURRENT_POSITION and hdSetDoublev(HD_CURRENT_FORCE) of a Touch, or the
// position and force of a Haply's handle, in metres and newtons.
class Device {
 public:
  udp::PosePacket pose(double time) const {
    udp::PosePacket pose;
    pose.position = {0, 0, 0.01 * std::cos(6.28 * time)};
    pose.linearVelocity = {0, 0, -0.0628 * std::sin(6.28 * time)};
    return pose;
  }
  void push(const std::array<double, 3>& force) { force_ = force; }
  double felt() const { return std::hypot(force_[0], force_[1], force_[2]); }

 private:
  std::array<double, 3> force_{};
};

int connectTo(const char* host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, host, &address.sin_addr) != 1) return -1;
  const int handle = socket(AF_INET, SOCK_DGRAM, 0);
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  return handle >= 0 && connect(handle, generic, sizeof address) == 0 ? handle : -1;
}

}  // namespace

int main(int argc, char** argv) {
  const int port = argc > 2 ? std::atoi(argv[2]) : 47800;
  const double seconds = argc > 3 ? std::atof(argv[3]) : 10;
  const int handle = connectTo(argc > 1 ? argv[1] : "127.0.0.1", port);
  if (handle < 0) {
    std::perror("udp-example-client");
    return 1;
  }
  Device device;
  const auto begin = Clock::now();
  auto next = begin, answered = begin;
  double most = 0;
  long answers = 0;
  for (std::uint64_t sequence = 1;; ++sequence) {
    const auto now = Clock::now();
    const double time = std::chrono::duration<double>(now - begin).count();
    if (time > seconds) break;
    udp::PosePacket pose = device.pose(time);
    pose.sequence = sequence;
    const auto packet = udp::encode(pose);
    // nobody listening is no reason to stop: the simulation may come later
    static_cast<void>(send(handle, packet.data(), packet.size(), MSG_DONTWAIT));

    // the newest answer that is there within half a tick
    std::array<std::byte, udp::forceSize + 1> buffer;
    pollfd waiting{handle, POLLIN, 0};
    if (poll(&waiting, 1, 0) == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
    for (ssize_t size = 0; (size = recv(handle, buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;) {
      const auto bytes = std::span(buffer).first(static_cast<std::size_t>(size));
      if (const auto force = udp::decodeForce(bytes)) {
        device.push(force->force);
        most = std::max(most, device.felt());
        answered = now;
        ++answers;
      }
    }
    // a host that hears nothing lets go, whatever the simulation meant last
    if (now - answered > std::chrono::milliseconds(50)) device.push({});

    next += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(next);
  }
  std::printf("%ld answers, strongest force %.3f N\n", answers, most);
  close(handle);
  return 0;
}
