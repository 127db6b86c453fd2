// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/interfaces/mechanical_state.h"

namespace stroma {

// A state whose positions follow linearly from another's: x_out = J x_in + c, v_out = J v_in, and
// forces travel back by the exact transpose, f_in += J^T f_out.
class Mapping : public Component {
 public:
  static constexpr std::string_view role = "Mapping";

  Attribute<bool> visual{
      this, "visual", false,
      "The output is only looked at: it follows at the visual rate. One that carries "
      "forces follows in every step all the same."};

  [[nodiscard]] virtual MechanicalState& input() const = 0;
  [[nodiscard]] virtual MechanicalState& output() const = 0;
  virtual void apply(ConstVec3Span in, Vec3Span out) const = 0;
  virtual void applyJ(ConstVec3Span in, Vec3Span out) const = 0;
  virtual void addTransposed(ConstVec3Span out, Vec3Span in) const = 0;

  void schedule(Schedule& schedule) override;
  // Whether forces act on what it maps to (core only: known when the system is built).
  void setMechanical(bool mechanical) { mechanical_ = mechanical; }

 private:
  void follow(const StepContext& step);
  bool mechanical_ = false;
};

}  // namespace stroma
