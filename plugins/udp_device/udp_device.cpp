// SPDX-License-Identifier: Apache-2.0
#include "plugins/udp_device/udp_device.h"

#include "core/scene.h"
#include "plugins/udp_device/network.h"

namespace stroma {

UdpDevice::UdpDevice() = default;
UdpDevice::~UdpDevice() = default;

void UdpDevice::start() {
  newest_.pose.position = home;
  network_ =
      std::make_unique<Network>(samples_, forces_, Network::Limits{maxPosition, peerTimeout});
  if (const auto problem = network_->open(address, port)) {
    const AttributeBase& wrong =
        problem->ofAddress ? static_cast<const AttributeBase&>(address) : port;
    error(wrong, "udp-listen", problem->text);
  }
  if (!scene().options().realTime) {
    warning("udp-batch",
            "poses come by the wall clock, and this run is not by it: it will not be the same "
            "when made again",
            "run in real time; a session that a HapticController records can be made again");
  }
  boundPort.set(network_->port());
}

void UdpDevice::stop() {
  if (!network_) return;
  showCounts({});
  network_.reset();
}

void UdpDevice::schedule(Schedule& schedule) {
  schedule.add<&UdpDevice::showCounts>(Stage::Publish, *this, "packet counts", Rate::visual);
}

void UdpDevice::showCounts(const StepContext&) {
  const Network::Counts& counts = network_->counts();
  accepted.set(counts.accepted);
  malformed.set(counts.malformed);
  implausible.set(counts.implausible);
  outdated.set(counts.outdated);
  foreign.set(counts.foreign);
}

ToolSample UdpDevice::read(double time) noexcept {
  static_cast<void>(samples_.read(newest_));
  newest_.time = time;
  return newest_;
}

void UdpDevice::write(double, const Vec3& force, const Vec3& torque) noexcept {
  forces_.write({force, torque});
}

}  // namespace stroma
