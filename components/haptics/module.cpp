// SPDX-License-Identifier: Apache-2.0
#include "components/haptics/haptic_controller.h"
#include "components/haptics/replay_device.h"
#include "components/haptics/software_hand_device.h"
#include "core/plugin.h"

PLUGIN(haptics, "0.1.0", "Apache-2.0", "Hands: haptic devices and their coupling to tools.")
(stroma::Registry& registry) {
  using namespace stroma;
  registry.add<HapticController>("HapticController")
      .doc("Joins a haptic device and a tool, in lock-step or by a thread of its own.")
      .domain(
          "Forces on three axes. Stable where couplingStiffness T / 2 + couplingDamping, as felt "
          "at "
          "the device, is at most 1 N s/m; verified with simulated hands of 0.05 to 1 kg.")
      .example("scenes/cornea/hand.xml");
  registry.add<SoftwareHandDevice>("SoftwareHandDevice")
      .doc("A simulated hand: a mass that spring and damper pull along an intended path.")
      .domain("Any mass, spring and damper. Verified against the damped oscillator.")
      .example("scenes/cornea/hand.xml");
  registry.add<ReplayDevice>("ReplayDevice")
      .doc("Plays a recorded session: the simulation makes the same steps, bit for bit.")
      .domain("The scene and build that recorded it. Verified for sessions in real time.")
      .example("scenes/cornea/hand_again.xml");
}
