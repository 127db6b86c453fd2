// SPDX-License-Identifier: Apache-2.0
// A device behind UDP on the loopback: good packets move it and are answered, all others change
// nothing and are counted.
#include "plugins/udp_device/udp_device.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <limits>
#include <random>
#include <thread>

#include "core/scene.h"
#include "plugins/udp_device/protocol.h"

namespace stroma {
namespace {

using Bytes = std::vector<std::byte>;

udp::PosePacket poseAt(double x, std::uint64_t sequence) {
  udp::PosePacket pose;
  pose.sequence = sequence;
  pose.position = {x, 2 * x, -x};
  pose.linearVelocity = {0.1, 0, 0};
  pose.buttons = 1;
  return pose;
}

Bytes bytesOf(const udp::PosePacket& pose) {
  const auto packet = udp::encode(pose);
  return {packet.begin(), packet.end()};
}

class Host {
 public:
  explicit Host(int port) : handle_(socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(handle_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Host() { close(handle_); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  void send(const Bytes& packet) const {
    EXPECT_EQ(::send(handle_, packet.data(), packet.size(), 0),
              static_cast<ssize_t>(packet.size()));
  }
  void send(const udp::PosePacket& pose) const { send(bytesOf(pose)); }
  // The next answer, if one comes within the time.
  [[nodiscard]] std::optional<udp::ForcePacket> answer(int milliseconds = 2000) const {
    pollfd waiting{handle_, POLLIN, 0};
    if (poll(&waiting, 1, milliseconds) <= 0) return std::nullopt;
    std::array<std::byte, 256> buffer;
    const ssize_t size = recv(handle_, buffer.data(), buffer.size(), 0);
    if (size < 0) return std::nullopt;
    return udp::decodeForce(std::span(buffer).first(static_cast<std::size_t>(size)));
  }

 private:
  int handle_;
};

class Udp : public testing::Test {
 protected:
  UdpDevice& listen(const std::string& attributes = "") {
    scene_.registry().add<UdpDevice>("UdpDevice");
    const std::string text = "<Node><UdpDevice port=\"0\" " + attributes + "/></Node>";
    const bool good = scene_.loadText(text, "udp.xml") && scene_.initialise();
    EXPECT_TRUE(good) << scene_.diagnostics().text();
    device_ = dynamic_cast<UdpDevice*>(scene_.root().components().front().get());
    return *device_;
  }
  // Number of packets that the device has counted, after a step that shows them.
  int counted() {
    EXPECT_TRUE(scene_.step());
    return device_->accepted + device_->malformed + device_->implausible + device_->outdated +
           device_->foreign;
  }
  void waitFor(int packets) {
    for (int i = 0; i < 2000 && counted() < packets; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(counted(), packets);
  }
  static SceneOptions withoutModules() {
    SceneOptions options;
    options.pluginFolders.clear();
    return options;
  }
  Scene scene_{withoutModules()};
  UdpDevice* device_ = nullptr;
};

TEST_F(Udp, theLayoutIsTheOneOfTheReadme) {
  udp::PosePacket pose = poseAt(1, 0x0102030405060708);
  const Bytes packet = bytesOf(pose);
  ASSERT_EQ(packet.size(), 128u);
  const std::string head(reinterpret_cast<const char*>(packet.data()), 4);
  EXPECT_EQ(head, "STRP");
  const auto at = [&](std::size_t i) { return std::to_integer<int>(packet[i]); };
  EXPECT_EQ(at(4), 1);  // version, little-endian
  EXPECT_EQ(at(5), 0);
  EXPECT_EQ(at(6), 128);  // length
  EXPECT_EQ(at(8), 8);    // sequence
  EXPECT_EQ(at(15), 1);
  EXPECT_EQ(at(22), 0xf0);  // 1.0 at 16
  EXPECT_EQ(at(23), 0x3f);
  EXPECT_EQ(at(70), 0xf0);  // w of the orientation, 1.0 at 64
  EXPECT_EQ(at(71), 0x3f);
  EXPECT_EQ(at(120), 1);  // buttons
}

TEST_F(Udp, aGoodPoseMovesTheStylusAndIsAnsweredByTheForce) {
  UdpDevice& device = listen();
  const Host host(device.boundPort);
  EXPECT_EQ(device.read(0).sequence, 0u);
  device.write(0, Vec3(1, -2, 3), Vec3(0.1, 0.2, 0.3));
  for (std::uint64_t i = 1; i <= 2000; ++i) {
    host.send(poseAt(1e-4 * static_cast<double>(i), i));
    const auto answer = host.answer();
    ASSERT_TRUE(answer);
    ASSERT_EQ(answer->sequence, i);
    ASSERT_EQ(answer->force[1], -2);
    ASSERT_EQ(answer->torque[2], 0.3);
    const ToolSample sample = device.read(0.5);
    ASSERT_EQ(sample.pose.position,
              Vec3(1e-4 * static_cast<double>(i), 2e-4 * static_cast<double>(i),
                   -1e-4 * static_cast<double>(i)));
    ASSERT_EQ(sample.sequence, i);
    ASSERT_EQ(sample.time, 0.5);
    ASSERT_EQ(sample.buttons, 1u);
  }
  waitFor(2000);
  EXPECT_EQ(*device.accepted, 2000);
}

TEST_F(Udp, wrongPacketsChangeNothingAndAreCounted) {
  UdpDevice& device = listen();
  const Host host(device.boundPort);
  host.send(poseAt(0.5, 10));
  ASSERT_TRUE(host.answer());
  const Bytes good = bytesOf(poseAt(0.7, 11));
  int sent = 1, malformed = 0, implausible = 0;
  const auto flush = [&] { waitFor(sent); };
  // every other length, up to a large one
  for (std::size_t size = 0; size < 300; ++size) {
    if (size == good.size()) continue;
    Bytes packet = good;
    packet.resize(size);
    host.send(packet);
    ++sent;
    ++malformed;
    if (size % 50 == 0) flush();
  }
  for (const std::size_t size : {1000, 9000, 60000}) {
    host.send(Bytes(size, std::byte{0x53}));
    ++sent;
    ++malformed;
  }
  flush();
  // every change of a byte of the head
  for (std::size_t at = 0; at < 8; ++at) {
    for (int change = 1; change < 256; ++change) {
      Bytes packet = good;
      packet[at] ^= static_cast<std::byte>(change);
      host.send(packet);
      ++sent;
      ++malformed;
      if (change % 50 == 0) flush();
    }
    flush();
  }
  // numbers that are none, or too large
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (std::size_t number = 0; number < 13; ++number) {
    for (const double bad : {nan, -nan, infinite, -infinite, 1e9, -1e300}) {
      Bytes packet = good;
      std::memcpy(packet.data() + 16 + 8 * number, &bad, sizeof bad);
      host.send(packet);
      ++sent;
      ++implausible;
    }
    flush();
  }
  udp::PosePacket zero = poseAt(0.7, 11);
  zero.orientation = {0, 0, 0, 0};
  host.send(zero);
  ++sent;
  ++implausible;
  flush();
  std::printf("%d packets: %d malformed, %d implausible\n", sent, malformed, implausible);
  EXPECT_EQ(*device.malformed, malformed);
  EXPECT_EQ(*device.implausible, implausible);
  EXPECT_EQ(*device.accepted, 1);
  EXPECT_EQ(device.read(0).pose.position, Vec3(0.5, 1, -0.5));
  EXPECT_FALSE(host.answer(20)) << "nothing but good packets is answered";
  host.send(good);
  EXPECT_TRUE(host.answer());
}

TEST_F(Udp, randomPacketsChangeNothing) {
  UdpDevice& device = listen();
  const Host host(device.boundPort);
  host.send(poseAt(0.5, 10));
  ASSERT_TRUE(host.answer());
  std::mt19937_64 random(47);
  int sent = 1;
  for (int i = 0; i < 10'000; ++i) {
    Bytes packet(random() % 3 == 0 ? 128 : random() % 400);
    for (std::byte& b : packet) b = static_cast<std::byte>(random());
    if (packet.size() == 128 && random() % 2 == 0) {
      // a good head over noise
      const Bytes head = bytesOf({});
      std::copy_n(head.begin(), 8, packet.begin());
    }
    host.send(packet);
    if (++sent % 50 == 0) waitFor(sent);
  }
  waitFor(sent);
  std::printf("%d packets: %d malformed, %d implausible, %d outdated\n", sent, *device.malformed,
              *device.implausible, *device.outdated);
  EXPECT_EQ(*device.accepted, 1);
  EXPECT_EQ(device.read(0).pose.position, Vec3(0.5, 1, -0.5));
}

TEST_F(Udp, oldSequenceNumbersAreDropped) {
  UdpDevice& device = listen();
  const Host host(device.boundPort);
  for (const std::uint64_t sequence : {5, 5, 4, 9, 8, 7, 10, 1}) {
    host.send(poseAt(0.01 * static_cast<double>(sequence), sequence));
  }
  waitFor(8);
  EXPECT_EQ(*device.accepted, 3);  // 5, 9, 10
  EXPECT_EQ(*device.outdated, 5);
  EXPECT_NEAR(device.read(0).pose.position.x(), 0.1, 1e-15);
}

TEST_F(Udp, anotherHostIsHeardOnlyAfterTheFirstHasBeenSilent) {
  UdpDevice& device = listen("peerTimeout=\"0.3 s\"");
  const Host first(device.boundPort), second(device.boundPort);
  first.send(poseAt(0.1, 100));
  ASSERT_TRUE(first.answer());
  for (std::uint64_t i = 1; i <= 50; ++i) second.send(poseAt(0.2, 1000 + i));
  waitFor(51);
  EXPECT_EQ(*device.foreign, 50);
  EXPECT_EQ(device.read(0).pose.position.x(), 0.1);
  EXPECT_FALSE(second.answer(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  // a wrong packet does not make it the device
  second.send(Bytes(128));
  second.send(poseAt(0.2, 1));
  EXPECT_TRUE(second.answer());
  EXPECT_EQ(device.read(0).pose.position.x(), 0.2);
  first.send(poseAt(0.1, 101));
  waitFor(54);
  EXPECT_EQ(*device.foreign, 51);
}

TEST_F(Udp, aPortThatIsTakenIsAnError) {
  UdpDevice& device = listen();
  Scene other(withoutModules());
  other.registry().add<UdpDevice>("UdpDevice");
  const std::string text =
      "<Node><UdpDevice port=\"" + std::to_string(*device.boundPort) + "\"/></Node>";
  EXPECT_FALSE(other.loadText(text, "udp.xml") && other.initialise());
  EXPECT_NE(other.diagnostics().text().find("udp-listen"), std::string::npos);
}

TEST_F(Udp, anAddressThatIsNoneIsAnErrorOfTheAddress) {
  // the second is well formed, but no address of this machine
  for (const std::string address : {"nowhere", "192.0.2.1"}) {
    Scene other(withoutModules());
    other.registry().add<UdpDevice>("UdpDevice");
    const std::string text =
        "<Node>\n<UdpDevice port=\"0\"\n\naddress=\"" + address + "\"/></Node>";
    EXPECT_FALSE(other.loadText(text, "udp.xml") && other.initialise());
    const std::string problems = other.diagnostics().text();
    EXPECT_NE(problems.find("udp-listen"), std::string::npos);
    EXPECT_NE(problems.find("udp.xml:4:"), std::string::npos) << problems;
  }
}

TEST_F(Udp, inBatchItWarnsThatTheRunCannotBeMadeAgain) {
  listen();
  EXPECT_NE(scene_.diagnostics().text().find("udp-batch"), std::string::npos);
  SceneOptions options = withoutModules();
  options.realTime = true;
  Scene live(options);
  live.registry().add<UdpDevice>("UdpDevice");
  ASSERT_TRUE(live.loadText("<Node><UdpDevice port=\"0\"/></Node>", "udp.xml"));
  ASSERT_TRUE(live.initialise()) << live.diagnostics().text();
  EXPECT_EQ(live.diagnostics().text(), "");
}

TEST_F(Udp, readingAndWritingBesideTheNetworkIsNoRace) {
  UdpDevice& device = listen();
  const Host host(device.boundPort);
  std::atomic<bool> done = false;
  std::jthread haptic([&] {
    std::uint64_t last = 0;
    for (double t = 0; !done; t += 1e-3) {
      const ToolSample sample = device.read(t);
      EXPECT_GE(sample.sequence, last);
      // whole, never torn
      EXPECT_EQ(sample.pose.position.y(), 2 * sample.pose.position.x());
      last = sample.sequence;
      device.write(t, Vec3::Constant(t), Vec3::Zero());
      std::this_thread::yield();
    }
  });
  for (std::uint64_t i = 1; i <= 3000; ++i) {
    host.send(poseAt(1e-4 * static_cast<double>(i), i));
    const auto answer = host.answer();
    ASSERT_TRUE(answer);
    ASSERT_EQ(answer->force[0], answer->force[2]);
  }
  done = true;
}

}  // namespace
}  // namespace stroma
