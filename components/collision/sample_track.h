// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "components/collision/bvh_collision_model.h"

namespace stroma {

// Where a sample of a tool, a sphere or a point, is nearest to a surface.
struct Touch {
  Index triangle = -1;
  Vec3 weights = Vec3::Zero();  // of the triangle's nodes
  Vec3 point = Vec3::Zero();    // on the surface
  Vec3 normal = Vec3::UnitZ();  // unit, out of the tissue, from the point to the centre outside
  double depth = 0;             // m, positive: the sphere reaches in; negative: how far away it is
  bool inside = false;          // the centre is inside
};

// On which side of a surface one sample is, from step to step. It gets inside only by going in
// through the front of a triangle, tested without a gap in time between the positions of the
// surface and of the sample at consecutive steps, so that no speed takes it through unnoticed. It
// then stays inside, also when it has gone through a thin sheet and out on the other side, until
// it is in front of the place where the leash from its entry holds it (see
// BVHCollisionModel::slide). Of closed surfaces a sample that starts inside is known to be there by
// the sign of the distance; behind an open one a sample touches nothing. Where the triangle at the
// leash's end is cut, the sample goes on with the piece that is nearest to it.
class SampleTrack {
 public:
  // The surface is followed to this step. The sample, of this radius (m), moves from `from` to
  // `to`. Where `from` is not the place it went to last, it was set there, not moved: what was
  // known of it is forgotten. Nothing farther than `margin` counts as a touch.
  [[nodiscard]] std::optional<Touch> follow(const BVHCollisionModel& surface, const Vec3& from,
                                            const Vec3& to, double radius, double margin);
  // The sample is far outside, or nothing is known of it.
  void setOutside(const Vec3& position);
  void forget() { where_ = Where::unknown; }

  [[nodiscard]] bool inside() const { return where_ == Where::inside; }

  static constexpr std::size_t numberCount = 6;
  void save(std::span<double> numbers) const;
  void restore(std::span<const double> numbers);

 private:
  enum class Where { unknown, outside, inside };
  [[nodiscard]] std::optional<Touch> held(const BVHCollisionModel& surface, const Vec3& p,
                                          double radius);

  Where where_ = Where::unknown;
  Vec3 position_ = Vec3::Zero();
  Index triangle_ = -1;  // inside: where the leash ends now
  Index entry_ = -1;     // inside: the triangle whose normal says which side it came from
};

}  // namespace stroma
