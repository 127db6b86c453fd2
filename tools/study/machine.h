// SPDX-License-Identifier: Apache-2.0
// The machine and the build that figures come from.
#pragma once

#include <string>

#include "tools/study/job.h"

namespace stroma::study {

[[nodiscard]] std::string processorName();
// processor, cores, governor, system, compiler, build, version, date, load.
[[nodiscard]] Json describeMachine();

}  // namespace stroma::study
