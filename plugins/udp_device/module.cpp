// SPDX-License-Identifier: Apache-2.0
#include "core/plugin.h"
#include "plugins/udp_device/udp_device.h"

PLUGIN(udp_device, "0.1.0", "Apache-2.0", "Haptic devices on other hosts, by UDP.")
(stroma::Registry& registry) {
  registry.add<stroma::UdpDevice>("UdpDevice")
      .doc("A haptic device whose host sends poses by UDP and gets forces back.")
      .domain("Trusted networks: there is no password. Verified with hostile packets on loopback.")
      .example("plugins/udp_device/example.xml");
}
