// SPDX-License-Identifier: Apache-2.0
// What a solver sees: the positions and velocities of all independent states it governs, in one
// allocation, with the forces, constraints and mappings that act on them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/block_matrix.h"
#include "core/interfaces/force_field.h"
#include "core/interfaces/mapping.h"
#include "core/interfaces/mass.h"
#include "core/interfaces/mechanical_state.h"
#include "core/interfaces/projective_constraint.h"

namespace stroma {

class Integrator;
class Node;

class System {
 public:
  // Gathers what the integrator governs: its node and everything below, down to the next
  // integrator. Problems (a mass on a mapped state, ...) are reported at the components concerned.
  explicit System(Integrator& integrator);

  // Number of particles of the independent states, concatenated in document order.
  [[nodiscard]] Index size() const { return size_; }
  [[nodiscard]] Vec3Span x() { return x_; }
  [[nodiscard]] Vec3Span v() { return v_; }
  [[nodiscard]] Vec3Span f() { return f_; }
  [[nodiscard]] ConstVec3Span rest() const { return rest_; }
  [[nodiscard]] std::span<const double> mass() const { return mass_; }  // kg
  [[nodiscard]] std::span<const double> inverseMass() const {
    return inverseMass_;
  }  // 0 for mass 0
  // First massless particle, -1 if there is none. Integrators that need masses report it.
  [[nodiscard]] Index masslessParticle() const;
  // "/cornea/particles, particle 17" for a particle of the system.
  [[nodiscard]] std::string particleName(Index particle) const;

  // f = all forces, gravity included, at a trial state; not projected.
  void computeForce(const StateView& at, Vec3Span f);
  // Potential energy of all forces and of gravity (J).
  [[nodiscard]] double potentialEnergy(const StateView& at);
  [[nodiscard]] double kineticEnergy(ConstVec3Span v) const;
  // Prepares the derivatives at a state.
  void linearize(const StateView& at);
  // df += stiffness (df/dx) dx + damping (df/dv) dx, for the state last prepared.
  void addTangentProduct(ConstVec3Span dx, double stiffness, double damping, Vec3Span df) const;

  // Removes the components along held directions.
  void project(Vec3Span a) const;
  // Held directions, at most one entry a particle, in the system's numbering.
  [[nodiscard]] const std::vector<ParticleProjector>& projectors() const { return projectors_; }

  // Pattern of the assembled derivative; parts that cannot be assembled (forces on mapped states,
  // force fields without blocks) are left out, and `complete` tells.
  [[nodiscard]] BlockPattern pattern(bool& complete) const;
  void addTangent(BlockMatrix& matrix, double stiffness, double damping) const;

  // Adds the mappings' calls, every input before its outputs.
  void scheduleMappings(Schedule& schedule) const;

  // A mapped state gets more particles at the end (at rest where given); their positions and
  // velocities are for its mapping to set. False when the state is not a mapped one of this system.
  bool grow(MechanicalState& state, ConstVec3Span rest);
  void dropAppended();
  // States, positions and velocities back to the start of the scene.
  void reset();
  // Positions and velocities of mapped states from the current independent ones.
  void updateMapped();

  [[nodiscard]] Integrator& integrator() const { return *integrator_; }
  [[nodiscard]] std::vector<ForceField*> forceFields() const;
  [[nodiscard]] std::vector<MechanicalState*> states() const;
  // States that follow others by mappings (their storage belongs to the system, too).
  [[nodiscard]] std::vector<MechanicalState*> mappedStates() const;
  // Index of the state's first particle in the system; -1 for mapped or foreign states.
  [[nodiscard]] Index offsetOf(const MechanicalState& state) const;

 private:
  struct Slot {
    MechanicalState* state = nullptr;
    Index offset = 0;  // of an independent state
    bool mapped = false;
    Vec3 gravity = Vec3::Zero();
    std::vector<ForceField*> forceFields;
    // of a mapped state, which may grow: its storage, and scratch
    std::vector<Vec3> x, v, f;
    mutable std::vector<Vec3> dx, df;
    void resize();
    // The first count() of a vector of a mapped state, nothing of an independent one.
    [[nodiscard]] Vec3Span scratch(std::vector<Vec3>& values) const {
      return mapped ? Vec3Span(values).first(count()) : Vec3Span();
    }
    [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(state->size()); }
  };
  struct MappingEntry {
    Mapping* mapping;
    std::size_t in, out;  // slots
    bool mechanical;      // forces act on what it maps to
  };

  void gather(Node& top);
  void orderMappings(std::vector<Mapping*> mappings);
  void layOut();
  [[nodiscard]] std::size_t slotOf(const MechanicalState& state) const;
  template <class Span>
  [[nodiscard]] Span part(const Slot& slot, Span whole, Span mapped) const {
    return slot.mapped ? mapped
                       : whole.subspan(static_cast<std::size_t>(slot.offset), slot.count());
  }
  [[nodiscard]] StateView viewOf(const Slot& slot, const StateView& at) const;
  void mapDown(const StateView& at) const;

  Integrator* integrator_;
  std::vector<Slot> slots_;
  std::vector<MappingEntry> mappings_;  // every input before its outputs
  std::vector<Mass*> masses_;
  std::vector<ProjectiveConstraint*> constraints_;
  Index size_ = 0;
  std::vector<Vec3> storage_;
  Vec3Span x_, v_, f_;
  std::vector<Vec3> rest_;
  std::vector<double> mass_, inverseMass_;
  std::vector<ParticleProjector> projectors_;
};

// The matrix of an implicit step, A = mass M - damping df/dv - stiffness df/dx, restricted to the
// free directions (identity on the held ones). It refers to the state last given to
// System::linearize.
struct SystemMatrix {
  System& system;
  double mass, damping, stiffness;

  // out = A in, for an `in` without components along held directions.
  void multiply(ConstVec3Span in, Vec3Span out) const;
  // Assembled lower triangle of what can be assembled; `matrix` has the system's pattern.
  void assemble(BlockMatrix& matrix) const;
};

}  // namespace stroma
