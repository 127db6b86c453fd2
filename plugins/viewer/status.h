// SPDX-License-Identifier: Apache-2.0
// The JSON message `status` and the small outputs of a scene (protocol.md).
#pragma once

#include <nlohmann/json.hpp>

#include "core/interfaces/viewer.h"
#include "core/scene.h"

namespace stroma::viewer {

// Clock, session, what observers saw last, limiters that acted.
[[nodiscard]] nlohmann::json describe(const SessionState& session, Scene& scene);
// Means a step over so many steps; `totals` (ms) are those of the call before.
void addTiming(Scene& scene, std::uint64_t steps, std::vector<double>& totals,
               nlohmann::json& status);
void addEnergy(const Scene& scene, nlohmann::json& status);
// Output attributes that are one number or one vector, as texts, by "/path.attribute".
[[nodiscard]] std::vector<std::pair<std::string, std::string>> smallOutputs(Node& root);

}  // namespace stroma::viewer
