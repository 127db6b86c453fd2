// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/study/names.h"
#include "tools/study/study.h"

namespace stroma::study {

// Reads a Measure of a question that has these methods and reference runs.
[[nodiscard]] Measure readMeasure(const SceneElement& element, const Names& methods,
                                  const Names& references, Diagnostics& diagnostics);

}  // namespace stroma::study
