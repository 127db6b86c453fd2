// SPDX-License-Identifier: Apache-2.0
// The surface swept by a blade's edge, given pose by pose as a polyline in the rest configuration.
// Rows of points, one row for each accepted pose; neighbouring rows span quads of two triangles,
// which share their points exactly with the rows before and after.
#pragma once

#include <limits>
#include <vector>

#include "core/topology_change.h"
#include "core/types.h"

namespace stroma {

// Whether a polyline of more than three points ends where it begins.
[[nodiscard]] bool isRing(ConstVec3Span polyline);

class CutSheet {
 public:
  // `spacing`: local size of the body's mesh [m]. Rows are about half of it apart, columns at most
  // three quarters. A polyline whose ends coincide is a closed blade (a trephine's ring).
  // `longest`: length to which the polyline may grow [m]; that of the first pose if shorter.
  explicit CutSheet(double spacing, double longest = 0);

  // Adds a pose and returns the number of new rows: none until the blade has moved by half the
  // spacing since the last row (smaller motions accumulate) or turned a corner, several for a fast
  // blade. Poses nearer than 0.02 of the spacing to the one before are dropped. Throws
  // std::invalid_argument for fewer than two points or a number that is not finite.
  Index addPose(ConstVec3Span blade);
  // How far a pose has come from the last row [m].
  [[nodiscard]] double distanceToFront(ConstVec3Span blade) const;
  // Adds a row where the blade is now, unless it has moved by less than 0.05 of the spacing, or
  // along itself.
  Index finish();

  [[nodiscard]] double spacing() const { return spacing_; }
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] Index rowCount() const { return static_cast<Index>(rows_.size()); }
  // Poses that were not dropped.
  [[nodiscard]] Index poseCount() const { return poses_; }
  [[nodiscard]] Index columnCount() const { return columns_; }
  [[nodiscard]] ConstVec3Span row(Index r) const { return rows_[static_cast<std::size_t>(r)]; }
  // Triangles between row r and row r + 1, without those that have no area.
  [[nodiscard]] std::vector<RestTriangle> strip(Index r) const;

 private:
  [[nodiscard]] std::vector<Vec3> resampled(ConstVec3Span blade) const;
  [[nodiscard]] bool isSlide(const std::vector<Vec3>& from, const std::vector<Vec3>& to) const;
  void slideIn();
  [[nodiscard]] std::size_t cornerBefore(const std::vector<Vec3>& pose) const;

  double spacing_, longest_;
  bool closed_ = false;
  Index columns_ = 0, poses_ = 0;
  std::vector<std::vector<Vec3>> rows_;
  std::vector<std::vector<Vec3>> since_;  // poses since the last row
};

// A part of a sheet with what cutting needs around it: a skirt that prolongs the swept part beyond
// each of its borders, and the borders themselves.
struct SheetWindow {
  struct Border {  // segment of the rim, `normal` of the sheet beside it
    Vec3 a, b, normal;
  };
  struct Box {
    Vec3 low, high;
  };
  std::vector<RestTriangle> triangles;  // swept ones first
  std::vector<Box> boxes;               // of the triangles
  std::size_t swept = 0;
  std::vector<Border> borders;
  Vec3 low, high;  // box of all

  // Triangles between rows `from` and `to`. `start`: row where the blade set in; if it is `from`
  // the sheet has a border there.
  SheetWindow(const CutSheet& sheet, Index from, Index to, Index start, double skirt);
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    double beyond = 0;  // the part of it along the sheet: not 0 beyond a border only
  };
  // Nearest of the first `count` triangles; the distance is infinite if it is more than `reach`.
  [[nodiscard]] Nearest nearest(const Vec3& x, double reach, std::size_t count) const;
  // Number of the first `count` triangles that a segment crosses.
  [[nodiscard]] Index crossings(const Vec3& p, const Vec3& q, std::size_t count) const;
  struct Crossing {
    double weight = -1;  // share of the segment's length; negative if it does not cross
    bool swept = false;  // the swept part, not the skirt
  };
  // Where a segment first crosses.
  [[nodiscard]] Crossing crossing(const Vec3& p, const Vec3& q) const;
  // Where a segment along the sheet that starts on the swept part leaves it; negative if it does
  // not.
  [[nodiscard]] double exit(const Vec3& p, const Vec3& q) const;
};

}  // namespace stroma
