// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "components/cutting/cutter.h"
#include "core/snapshot.h"

namespace stroma {

// The poses of edges at rest that cuts depend on. Given to a cutter of the uncut body in the same
// order they make the same cuts again, bit by bit.
class CutHistory {
 public:
  [[nodiscard]] bool empty() const { return events_.empty(); }
  void clear() { *this = {}; }

  // Cutter::advance() and finish(), remembered.
  SurfaceEdit advance(Cutter& cutter, std::vector<Vec3> edge, double longest);
  SurfaceEdit finish(Cutter& cutter, ConstVec3Span edge);

  void save(StateWriter& writer) const;
  // What was saved, made again; `change` gets every edit that is not empty. A history that is no
  // such thing ends where it goes wrong.
  void replay(StateReader& reader, Cutter& cutter,
              const std::function<void(const SurfaceEdit&)>& change);

 private:
  void record(bool finish, ConstVec3Span edge, double longest);
  void recordHeld();

  // an event: 1 for a pose or 0 for the end of a cut, number of points, longest, points
  std::vector<double> events_;
  // The last pose, if it made no difference: it may do so by what comes next.
  std::vector<Vec3> held_;
  double heldLongest_ = 0;
};

}  // namespace stroma
