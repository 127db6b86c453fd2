// SPDX-License-Identifier: Apache-2.0
// The binary messages of protocol.md.
#pragma once

#include <string>

#include "plugins/viewer/frame.h"

namespace stroma::viewer {

[[nodiscard]] std::string encode(const TopologyCopy& topology);
[[nodiscard]] std::string encode(const FrameCopy& frame);

// Of each triangle the connected piece of the surface it belongs to, numbered by first triangle.
[[nodiscard]] std::vector<std::uint32_t> piecesOf(std::span<const std::uint32_t> triangles,
                                                  std::size_t points);

}  // namespace stroma::viewer
