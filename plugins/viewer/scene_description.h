// SPDX-License-Identifier: Apache-2.0
// The JSON messages that tell of a scene (protocol.md).
#pragma once

#include <nlohmann/json.hpp>

#include "core/diagnostics.h"
#include "plugins/viewer/scene_bodies.h"

namespace stroma::viewer {

// The message `scene`.
[[nodiscard]] nlohmann::json describeScene(Scene& scene, const SceneBodies& bodies,
                                           std::uint64_t generation,
                                           const std::vector<std::string>& changes);
// The message `diagnostics`.
[[nodiscard]] nlohmann::json describe(const Diagnostics& diagnostics, bool broken);
// Components that may take the place of this one: those that play the same role.
[[nodiscard]] std::vector<std::string> alternativesTo(const Component& component);
// The device that the component links to; null where there is none.
[[nodiscard]] HapticDevice* deviceAmong(const Component& component);
// What moves the tool: the device that it or its controller links to; null if nothing does.
[[nodiscard]] HapticDevice* deviceOf(Scene& scene, const Tool& tool);

}  // namespace stroma::viewer
