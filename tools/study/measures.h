// SPDX-License-Identifier: Apache-2.0
// What a study measures of a scene.
#pragma once

#include "core/scene.h"
#include "tools/study/job.h"

namespace stroma::study {

// Reports what the measure names but the scene (read, not necessarily initialised) does not have.
void checkMeasure(Scene& scene, const Measure& measure, Diagnostics& diagnostics);

// Its value as the scene is now, SI: {"value": number}, of a displacement field {"field": [x y z of
// every point]}, or {"problem": text} where it cannot be measured.
//   monitor    what a Monitor saw last
//   attribute  any attribute that is a number
//   field      displacement of a state's nodes from rest, fitted at common points (field_fit.h)
//   energy     potential energy of everything the solvers govern (J), loads and gravity included,
//              over that of the bodies at rest under the same loads
//   reaction   force of a constraint on what it holds (N), its size or its part along an axis;
//              where several hold a particle, each has what is along its own directions
//   volume     inside a closed surface, over that at rest
[[nodiscard]] Json evaluate(Scene& scene, const Measure& measure);

}  // namespace stroma::study
