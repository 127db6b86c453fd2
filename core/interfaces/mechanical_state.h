// SPDX-License-Identifier: Apache-2.0
// Positions, velocities and forces of one body's particles.
#pragma once

#include "core/component.h"
#include "core/types.h"

namespace stroma {

// A trial state that forces are evaluated at.
struct StateView {
  ConstVec3Span x;  // positions (m)
  ConstVec3Span v;  // velocities (m/s)
  double time;      // s
  [[nodiscard]] Index size() const { return static_cast<Index>(x.size()); }
};

// Number of particles and their rest positions are fixed in bind(); only a mapped state, such as
// the nodes of a surface that is cut, gets more while the scene runs. The storage of x, v and f
// belongs to the System of the solver that governs the state (one allocation for all of its
// independent states).
class MechanicalState : public Component {
 public:
  static constexpr std::string_view role = "MechanicalState";

  [[nodiscard]] Index size() const { return static_cast<Index>(rest_.size()); }
  [[nodiscard]] ConstVec3Span rest() const { return rest_; }
  [[nodiscard]] Vec3Span x() const { return x_; }
  [[nodiscard]] Vec3Span v() const { return v_; }
  [[nodiscard]] Vec3Span f() const { return f_; }
  [[nodiscard]] StateView view(double time) const { return {x_, v_, time}; }

  // First positions and velocities; read when the scene starts and on reset.
  [[nodiscard]] ConstVec3Span initialPositions() const { return initialX_; }
  [[nodiscard]] ConstVec3Span initialVelocities() const { return initialV_; }

  // Puts the state's arrays at the given places (core only: done when the schedule is compiled).
  void place(Vec3Span x, Vec3Span v, Vec3Span f) { x_ = x, v_ = v, f_ = f; }
  // New particles at the end, and back to the initial ones (core only: through the System).
  void append(ConstVec3Span rest) { rest_.insert(rest_.end(), rest.begin(), rest.end()); }
  void dropAppended() { rest_.resize(initialX_.size()); }

 protected:
  std::vector<Vec3> rest_, initialX_, initialV_;

 private:
  Vec3Span x_, v_, f_;
};

}  // namespace stroma
