// SPDX-License-Identifier: Apache-2.0
// The true lines of incisions, and how well the surface follows them. A path is where an edge went
// through the outer surface, at rest; for a blade that cuts with two sides both halves, for a ring
// the ring itself once it is inside.
#pragma once

#include "components/cutting/blade_course.h"
#include "components/cutting/simplicial_complex.h"
#include "core/interfaces/tool.h"
#include "core/snapshot.h"

namespace stroma {

class IncisionTrace {
 public:
  // `meanEdge`: of the uncut mesh [m].
  explicit IncisionTrace(double meanEdge) : meanEdge_(meanEdge) {}

  // A blade goes in.
  void begin() { paths_.resize(paths_.size() + 2); }
  // Its edge at rest, as it cuts.
  void add(const Tool& tool, ConstVec3Span edge, const BladeCourse::Course& course);

  struct Measure {
    double path = 0;       // length of the paths [m]
    double length = 0;     // of the seams that follow them [m]
    double turning = 0;    // mean angle between their successive segments [rad]
    double deviation = 0;  // their mean distance from the paths, in mean edges
  };
  [[nodiscard]] Measure measure(const SimplicialComplex& complex) const;

  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  double meanEdge_;
  std::vector<std::vector<Vec3>> paths_;  // two for each time that a blade went in
};

}  // namespace stroma
