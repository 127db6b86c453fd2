// SPDX-License-Identifier: Apache-2.0
// Cuts a body along the surface that a blade sweeps, in the rest configuration and while it is
// swept.
//
// Each new strip of the sheet does four things near itself:
//   1. vertices near the sheet (`CutTolerance`) are taken as lying on it; they are not moved.
//   2. edges that cross the sheet, with no end on it, are split where they cross. The sheet is
//      prolonged by a skirt for this: elements into which it only reaches are divided as well.
//   3. edges along the sheet that leave the part which has been swept are split at its border:
//      the tip and the depth of an incision are where the blade is, not at the next vertex.
//   4. facets on the swept part with two sides of the body at them are separated.
// Strips that have been cut before, to the bit, are passed over.
//
// A simplex's side is that of one of its vertices off the sheet, or of its centroid if it has none
// (then all its vertices are on the sheet). Two sides differ if the segment between them crosses
// the sheet an odd number of times, by exact predicates; that is consistent around every edge,
// hence a sheet without holes makes a cut without holes. Simplices that would come free as a piece
// with all vertices on the sheet stay where they are: the blade has touched, not cut. So do chips
// smaller than `smallestPiece`.
//
// Without subdivision (the cornea paper's first variant) no edge is split, and facets are separated
// whose two simplices have their centroids on different sides of the swept part.
//
// A blade that moves in the slit it has cut, to and fro, sweeps nothing new; where it leaves the
// slit beside the front it begins a new sheet.
//
// The front runs at most half a spacing ahead of the last strip; `finish` brings the cut up to it.
#pragma once

#include <memory>
#include <unordered_set>

#include "components/cutting/cut_sheet.h"
#include "components/cutting/hash_grid.h"
#include "components/cutting/simplicial_complex.h"

namespace stroma {

// In units of the spacing. Smaller ones follow the blade closer and leave worse triangles.
struct CutTolerance {
  double snap;       // how far a vertex may lie off the sheet and still be taken as on it
  double overshoot;  // how far beyond the border of the swept part
  double lag;        // how far the cut may end short of that border
};

struct CutterOptions {
  bool subdivide = true;
  // Where the body's outside is cut, which one sees (the ends of a cut have no lag there), and
  // within, where wider ones keep the walls' triangles well shaped.
  CutTolerance surface{.snap = 0.15, .overshoot = 0.1, .lag = 0.25};
  CutTolerance inside{.snap = 0.22, .overshoot = 0.2, .lag = 0.4};
  double skirt = 1.5;           // width of the skirt, about the longest edge [spacing]
  double smallestPiece = 0.05;  // volume below which nothing is cut free [spacing^3]
};

class Cutter {
 public:
  // `spacing`: local size of the body's mesh [m]; 0 takes the mean edge length. The complex is kept
  // by reference and must be changed by this cutter only.
  explicit Cutter(SimplicialComplex& complex, double spacing = 0,
                  const CutterOptions& options = {});

  // Next pose of the blade's edge, in the rest configuration. The first pose after construction or
  // after `finish` sets the blade in. Returns what has changed, often nothing (see CutSheet).
  // `longest`: length to which the edge may grow [m] where only the part of it near the body is
  // given.
  SurfaceEdit advance(ConstVec3Span blade, double longest = 0);
  // Ends the cut where the blade is, at a last pose if one is given.
  SurfaceEdit finish(ConstVec3Span blade = {});

  [[nodiscard]] bool cutting() const { return sheet_ != nullptr; }
  [[nodiscard]] double spacing() const { return spacing_; }
  // Poses so far that a cut depends on; the others were too near to the one before, or lay in the
  // slit (of these the last one counts if the blade then leaves it).
  [[nodiscard]] Index poseCount() const { return poses_; }
  // The sheet of the cut that is going on, null if none.
  [[nodiscard]] const CutSheet* sheet() const { return sheet_.get(); }

 private:
  using Facet = SimplicialComplex::Facet;
  struct Split {
    Edge edge;
    double weight, length;
  };
  static constexpr Index windowRows = 4;

  void begin(ConstVec3Span blade, double longest);
  void end(std::vector<RestTriangle>& sheetTriangles);
  [[nodiscard]] bool inOwnSlit(ConstVec3Span blade);
  void sweepTo(ConstVec3Span blade, std::vector<RestTriangle>& sheetTriangles);
  [[nodiscard]] SurfaceEdit takeEdit(std::span<const RestTriangle> sheetTriangles);
  [[nodiscard]] std::uint64_t stripKey(Index row, bool first, bool last) const;
  void cutStrip(Index row, bool last, bool replay, std::vector<RestTriangle>& sheetTriangles);
  void findNear(const SheetWindow& window);
  [[nodiscard]] bool isWithin(Index v) const;
  void tag(Index v, const SheetWindow& window);
  void addVertex(Index v);
  void conform(const SheetWindow& window, bool first, bool last);
  [[nodiscard]] bool findCrossedEdges(const SheetWindow& window, std::vector<Split>& splits) const;
  void findBorderEdges(const SheetWindow& window, bool exact, std::vector<Split>& splits);
  [[nodiscard]] bool isCrowded(const Split& split) const;
  [[nodiscard]] bool isUncutAt(Index v, Index w) const;
  Index split(Edge edge, double weight);
  void splitStuck(std::span<const Edge> edges);
  [[nodiscard]] std::vector<Facet> facetsToSeparate(const SheetWindow& window);
  [[nodiscard]] std::vector<Facet> facetsBetweenCentroids(const SheetWindow& strip);
  void keepTouched(std::vector<Facet>& facets);
  [[nodiscard]] bool isInside(Index v) const { return inside_[static_cast<std::size_t>(v)] != 0; }
  // On the swept part: what has once been taken so stays so while the window passes over it.
  [[nodiscard]] bool onSwept(Index v) const {
    return onSwept_[static_cast<std::size_t>(v)] >= firstStep_;
  }
  [[nodiscard]] bool onSheet(Index v) const {
    return onSheet_[static_cast<std::size_t>(v)] == step_ || onSwept(v);
  }
  [[nodiscard]] bool touched(Index t) const;
  [[nodiscard]] Vec3 sidePoint(Index t) const;

  SimplicialComplex& complex_;
  double spacing_, longestEdge_;
  CutterOptions options_;
  HashGrid grid_;
  std::unique_ptr<CutSheet> sheet_;
  std::unique_ptr<SheetWindow> slit_;  // its latest rows, up to row slitEnd_
  Index slitEnd_ = 0;
  Index poses_ = 0;
  std::vector<Vec3> withinSlit_;                // the last pose if it lay there, else empty
  Index start_ = 0;                             // row where the blade set in or turned back
  Index step_ = 0, setIn_ = 0, firstStep_ = 0;  // steps: now, first of the cut, of the window
  std::vector<Index> onSheet_;  // per vertex: last step in which it was on the sheet or its skirt
  std::vector<Index> onSwept_;  // per vertex: last step in which it was on the swept part
  std::vector<char> inside_;    // per vertex: not on the body's outside, which no cut changes
  std::vector<Index> seen_;     // per simplex: step in which it was found
  std::vector<Index> near_;     // simplices near the window
  std::vector<Index> nearVertices_;
  std::unordered_set<std::uint64_t> done_;  // strips that have been cut
  std::vector<Index> refusedRows_;  // rows with facets that could not be separated at the time
  std::vector<Facet> waiting_;      // without subdivision: facets refused so far
};

}  // namespace stroma
