// SPDX-License-Identifier: Apache-2.0
// The scene of a job, in this process: how it is opened, and what is told of it.
#pragma once

#include "core/scene.h"
#include "tools/study/job.h"

namespace stroma::study {

// As the job asks for, without output files.
[[nodiscard]] SceneOptions optionsOf(const Job& job);
// The first error, with its place in the generated scene `file`.
[[nodiscard]] std::string firstError(const Diagnostics& diagnostics, const std::string& file);
// Steps to make in this time (s), at least one.
[[nodiscard]] std::uint64_t stepsIn(double time, const Scene& scene);
// {"/path.limiter": count} of those that acted.
[[nodiscard]] Json limitersOf(Scene& scene);

}  // namespace stroma::study
