// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/scene.h"
#include "tools/study/job.h"

namespace stroma::study {

// What the scene looks like now, small enough for a page: of each body its surface where it has
// one, else its particles, at most 4,000 points. Positions and rest positions are whole numbers
// from 0 to 1000 across the longest side of the bounds; colours count the displacement in 255ths of
// the largest. {"points": [x y z ...], "colours": [...], "triangles": [a b c ...], "largest": m,
// "side": m}
[[nodiscard]] Json pictureOf(Scene& scene);

}  // namespace stroma::study
