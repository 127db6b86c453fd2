// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/study/job.h"

namespace stroma::stability {

// Runs the scene of the job for its duration, in this process. {"status": "passed" | "failed" |
// "diverged" | "invalid", "message", "checks": [{criterion, passed, measured, bound, step,
// message}], "limiters": {path: count}, "picture", "seconds", "steps", "particles"}. A scene
// without criteria is invalid: it cannot fail.
[[nodiscard]] study::Json runCase(const study::Job& job);

}  // namespace stroma::stability
