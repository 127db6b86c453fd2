// SPDX-License-Identifier: Apache-2.0
// Elements, as XML text, that put a tool into the hand that holds the mouse.
#pragma once

#include <string>
#include <vector>

#include "plugins/viewer/scene_bodies.h"

namespace stroma::viewer {

// A MouseDevice of this name that begins at a pose.
[[nodiscard]] std::string mouseElement(const std::string& name, const Pose& pose);
// Forceps for a surface, with a stiffness that suits its tissue: for the node of its state.
[[nodiscard]] std::string pullElements(Scene& scene, const Body& surface);
// A ball probe and its contact, likewise.
[[nodiscard]] std::string probeElements(Scene& scene, const Body& surface);
// The scene with each MouseDevice, in document order, replaced by a ScriptedDevice of that table.
[[nodiscard]] std::string withScriptedDevices(const std::string& sceneText,
                                              const std::vector<std::string>& tables);

}  // namespace stroma::viewer
