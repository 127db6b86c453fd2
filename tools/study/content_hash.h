// SPDX-License-Identifier: Apache-2.0
// What decides a result besides the scene's text: the files it reads, and the code that runs it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/scene.h"

namespace stroma::study {

[[nodiscard]] std::uint64_t hashText(std::string_view text, std::uint64_t seed);
[[nodiscard]] std::string hexText(std::uint64_t number);

// Over the bytes of the files that attributes of the scene name (found as the scene `file` finds
// them), of the core library, and of the modules the scene has loaded.
[[nodiscard]] std::uint64_t hashOfInputs(Scene& scene, const std::filesystem::path& file);

}  // namespace stroma::study
