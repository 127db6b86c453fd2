// SPDX-License-Identifier: Apache-2.0
#include "components/tools/grip_tool.h"
#include "components/tools/keratome_tool.h"
#include "components/tools/probe_tool.h"
#include "components/tools/scalpel_tool.h"
#include "components/tools/scripted_device.h"
#include "components/tools/trephine_tool.h"
#include "core/plugin.h"

PLUGIN(tools, "0.1.0", "Apache-2.0", "Rigid instruments and a device that follows a script.")
(stroma::Registry& registry) {
  using namespace stroma;
  registry.add<ProbeTool>("ProbeTool")
      .doc("A blunt probe with a spherical tip.")
      .domain("A rigid sphere. Its motion is the device's, to the bit. Verified by unit tests.")
      .example("scenes/cornea/touch.xml");
  registry.add<GripTool>("GripTool")
      .doc("Forceps that hold what surface is near the tip while the trigger is held.")
      .domain("Rigid jaws without a shape of their own; a GripContact does the holding.")
      .example("scenes/tutorials/tools.xml");
  registry.add<ScalpelTool>("ScalpelTool")
      .doc("A pointed blade that cuts with one edge; sample points on its central axis.")
      .domain("A flat rigid blade without thickness.")
      .example("scenes/tutorials/tools.xml");
  registry.add<TrephineTool>("TrephineTool")
      .doc("A tube with a sharp rim, which cuts a circle.")
      .domain("A rigid rim without thickness.")
      .example("scenes/cornea/trephine.xml");
  registry.add<KeratomeTool>("KeratomeTool")
      .doc("A slit knife: a flat arrow head that cuts with both sides.")
      .domain("A flat rigid blade without thickness.")
      .example("scenes/tutorials/tools.xml");
  registry.add<ScriptedDevice>("ScriptedDevice")
      .doc("A stylus that follows key poses from the scene or from a CSV file.")
      .domain("Poses and velocities are exact between the keys. Verified by unit tests.")
      .example("scenes/cornea/touch.xml");
}
