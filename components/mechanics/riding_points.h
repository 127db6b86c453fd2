// SPDX-License-Identifier: Apache-2.0
// Points that ride on particles by shape functions (surface_shape.h), and follow cuts. What carries
// a point must be seen from its eye: the point itself until a cut touches it, from then on a place
// just inside the part of the body that it belongs to, since the copies of a node on a seam lie on
// the cut. A point that a cut concerns is carried anew, as a single point, by the nearest particles
// that it sees; all others keep their shape functions.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include "components/mechanics/visibility.h"

namespace stroma {

struct RidingPoints {
  SurfaceShape shape;
  Index supports = 12;

  // Kept for cuts. A chip sees fewer than fewest() particles.
  enum class State : char { sound, chip, retired };
  std::vector<Vec3> eyes;
  std::vector<State> states;
  std::vector<char> single;  // carried as a single point already
  std::vector<char> keeps;   // whether those that the last change concerns keep their carriers
  double longestArm = 0;     // m, from a point to a carrier
  std::uint64_t change = 0;  // number of the last change followed, and what it did
  std::vector<Index> redone;
  Index newChips = 0;
  Marks marks;

  Index leastAtRest = fewestLinks;  // carriers of a point in the whole body, which may have few

  [[nodiscard]] Index fewest() const { return std::min({supports, fewestLinks, leastAtRest}); }
};

// The particles as a cut has left them. The gradients are the plain ones.
struct CutParticles {
  ConstVec3Span rest;
  const Neighbourhoods& neighbourhoods;
  const Gradients& gradients;
  const VisibilitySearch& search;
  const FacetBoxes& newFacets;      // of the last change
  std::span<const Index> relinked;  // rows that the last change has replaced, ascending
};

// Before the first cut; positions at rest.
void prepareForCuts(RidingPoints& points, ConstVec3Span rest, ConstVec3Span particles);

// Which points a change concerns, ascending. With `cut` they are the nodes of the surface that is
// cut: new ones are among the answer, and touched ones get their eyes. Otherwise only what carries
// them has changed. rest: of all points, the new ones included.
[[nodiscard]] std::vector<Index> concernedPoints(RidingPoints& points, ConstVec3Span rest, bool cut,
                                                 const TopologyChange& change,
                                                 const CutParticles& particles);
// Carries these points anew.
void carryAnew(RidingPoints& points, ConstVec3Span rest, std::span<const Index> which,
               const CutBarrier& barrier, const CutParticles& particles);

// Adds what is wrong with them; `name` begins the sentences.
void checkPoints(const RidingPoints& points, ConstVec3Span rest, const CutParticles& particles,
                 const std::string& name, TopologyCheck& check);

// Adds a sentence, at most a few of each kind.
class Failures {
 public:
  Failures(std::vector<std::string>& all, std::string name) : all_(all), name_(std::move(name)) {}
  void add(const std::string& what, Index where) {
    constexpr int most = 3;
    if (counts_[what]++ < most) all_.push_back(name_ + " " + std::to_string(where) + " " + what);
  }

 private:
  std::vector<std::string>& all_;
  std::string name_;
  std::map<std::string, int> counts_;
};

}  // namespace stroma
