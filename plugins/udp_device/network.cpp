// SPDX-License-Identifier: Apache-2.0
#include "plugins/udp_device/network.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/address.hpp>
#include <cmath>

namespace stroma {
namespace {

constexpr double mostSpeed = 1000;  // m/s or rad/s; the haptic controller has a stricter limit

bool within(const std::array<double, 3>& v, double most) {
  // false for NaN, which std::hypot of three may lose
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2] <= most * most;
}

Vec3 vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
std::array<double, 3> numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

UdpDevice::Network::~Network() {
  context_.stop();
  if (thread_.joinable()) thread_.join();
}

std::optional<UdpDevice::Network::Problem> UdpDevice::Network::open(const std::string& address,
                                                                    int port) {
  boost::system::error_code failure;
  const auto host = boost::asio::ip::make_address(address, failure);
  if (failure) return Problem{"'" + address + "' is no address: " + failure.message(), true};
  const boost::asio::ip::udp::endpoint endpoint(host, static_cast<std::uint16_t>(port));
  socket_.open(endpoint.protocol(), failure);
  if (!failure) socket_.bind(endpoint, failure);
  if (!failure) socket_.non_blocking(true, failure);
  if (failure) {
    return Problem{
        "cannot listen at " + address + ":" + std::to_string(port) + ": " + failure.message(),
        failure == boost::asio::error::address_family_not_supported ||
            failure.value() == boost::system::errc::address_not_available};
  }
  port_ = socket_.local_endpoint(failure).port();
  receive();
  thread_ = std::jthread([this] { context_.run(); });
  return std::nullopt;
}

void UdpDevice::Network::receive() {
  socket_.async_receive_from(boost::asio::buffer(buffer_.data(), buffer_.size()), sender_,
                             [this](const boost::system::error_code& failure, std::size_t size) {
                               if (failure == boost::asio::error::operation_aborted) return;
                               // errors of single packets, such as an answer that found nobody, end
                               // nothing
                               if (!failure) take(std::span(buffer_).first(size));
                               receive();
                             });
}

bool UdpDevice::Network::isPlausible(const udp::PosePacket& pose) const {
  double norm2 = 0;
  for (const double q : pose.orientation) norm2 += q * q;
  return within(pose.position, limits_.position) && within(pose.linearVelocity, mostSpeed) &&
         within(pose.angularVelocity, mostSpeed) && std::abs(norm2 - 1) <= 1e-3;
}

// In this order: nothing of a packet is believed that could be somebody else's.
void UdpDevice::Network::take(std::span<const std::byte> packet) {
  if (udp::headOf(packet, udp::poseMagic, udp::poseSize) != udp::Verdict::good) {
    ++counts_.malformed;
    return;
  }
  const auto now = Clock::now();
  const bool silent =
      hasPeer_ && std::chrono::duration<double>(now - heard_).count() > limits_.timeout;
  if (hasPeer_ && !silent && sender_ != peer_) {
    ++counts_.foreign;
    return;
  }
  const udp::PosePacket pose = udp::decodePose(packet);
  if (!isPlausible(pose)) {
    ++counts_.implausible;
    return;
  }
  const bool newPeer = !hasPeer_ || silent;
  if (!newPeer && pose.sequence <= sequence_) {
    ++counts_.outdated;
    return;
  }
  hasPeer_ = true;
  peer_ = sender_;
  heard_ = now;
  sequence_ = pose.sequence;
  ToolSample sample;
  const auto& q = pose.orientation;
  sample.pose = {vector(pose.position), Quat(q[3], q[0], q[1], q[2]).normalized()};
  sample.linearVelocity = vector(pose.linearVelocity);
  sample.angularVelocity = vector(pose.angularVelocity);
  sample.buttons = pose.buttons;
  sample.sequence = ++samplesTaken_;
  samples_.write(sample);
  ++counts_.accepted;
  answer(pose.sequence);
}

void UdpDevice::Network::answer(std::uint64_t sequence) {
  static_cast<void>(forces_.read(force_));
  const auto packet = udp::encode(udp::ForcePacket{
      .sequence = sequence, .force = numbers(force_.force), .torque = numbers(force_.torque)});
  boost::system::error_code ignored;  // a host that does not listen is no trouble of ours
  socket_.send_to(boost::asio::buffer(packet.data(), packet.size()), peer_, 0, ignored);
}

}  // namespace stroma
