// SPDX-License-Identifier: Apache-2.0
// Scenes with tools and scripted devices.
#pragma once

#include "components/tools/grip_tool.h"
#include "components/tools/keratome_tool.h"
#include "components/tools/probe_tool.h"
#include "components/tools/scalpel_tool.h"
#include "components/tools/scripted_device.h"
#include "tests/components/solver/test_scene.h"

namespace stroma::test {

inline void registerTools(Registry& registry) {
  registry.add<ProbeTool>("ProbeTool");
  registry.add<GripTool>("GripTool");
  registry.add<ScalpelTool>("ScalpelTool");
  registry.add<KeratomeTool>("KeratomeTool");
  registry.add<ScriptedDevice>("ScriptedDevice");
}

}  // namespace stroma::test
