// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace stroma::viewer {

// In one line. Bytes that are no UTF-8, such as a file's name may have, become U+FFFD.
[[nodiscard]] inline std::string dumped(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace stroma::viewer
