// SPDX-License-Identifier: Apache-2.0
#include "core/system.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/interfaces/integrator.h"
#include "core/parallel.h"
#include "core/traverse.h"

namespace stroma {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);
// Vector units may read past the last particle's xyz.
constexpr std::size_t spare = 2;

// Projector onto the directions that both leave free.
Mat3 intersection(const Mat3& a, const Mat3& b) {
  const Mat3 held = (Mat3::Identity() - a) + (Mat3::Identity() - b);
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(held);
  Mat3 free = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (eigen.eigenvalues()[i] < 1e-9) {
      free += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose();
    }
  }
  return free;
}

}  // namespace

System::System(Integrator& integrator) : integrator_(&integrator) {
  gather(integrator.node());
  layOut();
}

void System::gather(Node& top) {
  std::vector<Mapping*> mappings;
  std::vector<ForceField*> forceFields;
  const auto visit = [&](auto&& self, Node& node) -> void {
    if (&node != &top && !collectHere<Integrator>(node).empty()) return;
    for (const auto& component : node.components()) {
      Component* c = component.get();
      if (auto* state = dynamic_cast<MechanicalState*>(c)) {
        slots_.emplace_back().state = state;
      }
      if (auto* mapping = dynamic_cast<Mapping*>(c)) mappings.push_back(mapping);
      if (auto* force = dynamic_cast<ForceField*>(c)) forceFields.push_back(force);
      if (auto* mass = dynamic_cast<Mass*>(c)) masses_.push_back(mass);
      if (auto* held = dynamic_cast<ProjectiveConstraint*>(c)) constraints_.push_back(held);
    }
    for (const auto& child : node.children()) self(self, *child);
  };
  visit(visit, top);

  for (Mapping* mapping : mappings) {
    const std::size_t out = slotOf(mapping->output());
    if (out != none) slots_[out].mapped = true;
  }
  for (ForceField* force : forceFields) {
    const std::size_t slot = slotOf(force->state());
    if (slot == none) {
      force->error("state-ungoverned", "acts on '" + force->state().path() +
                                           "', which the solver '" + integrator_->path() +
                                           "' does not govern");
      continue;
    }
    slots_[slot].forceFields.push_back(force);
  }
  orderMappings(std::move(mappings));
}

void System::orderMappings(std::vector<Mapping*> mappings) {
  // repeatedly take the mappings whose input is independent or already mapped
  std::vector<bool> ready(slots_.size());
  for (std::size_t s = 0; s < slots_.size(); ++s) ready[s] = !slots_[s].mapped;
  bool progress = true;
  while (progress && !mappings.empty()) {
    progress = false;
    for (auto it = mappings.begin(); it != mappings.end();) {
      const std::size_t in = slotOf((*it)->input()), out = slotOf((*it)->output());
      if (in == none || out == none) {
        (*it)->error("state-ungoverned",
                     "maps a state that the solver '" + integrator_->path() + "' does not govern");
        it = mappings.erase(it);
      } else if (ready[out]) {
        (*it)->error("mapping-second", "maps to '" + (*it)->output().path() +
                                           "', which another mapping moves already");
        it = mappings.erase(it);
      } else if (ready[in]) {
        mappings_.push_back({*it, in, out, false});
        ready[out] = true;
        progress = true;
        it = mappings.erase(it);
      } else {
        ++it;
      }
    }
  }
  for (Mapping* mapping : mappings) {
    mapping->error("mapping-cycle", "is part of a cycle of mappings");
  }
  // a mapping is mechanical when forces act on its output or further down
  std::vector<bool> carries(slots_.size());
  for (std::size_t s = 0; s < slots_.size(); ++s) carries[s] = !slots_[s].forceFields.empty();
  for (auto it = mappings_.rbegin(); it != mappings_.rend(); ++it) {
    it->mechanical = carries[it->out];
    it->mapping->setMechanical(it->mechanical);
    if (it->mechanical) carries[it->in] = true;
  }
}

void System::layOut() {
  for (Slot& slot : slots_) {
    if (slot.mapped) continue;
    slot.offset = size_;
    size_ += slot.state->size();
  }
  const auto n = static_cast<std::size_t>(size_);
  storage_.assign(3 * n + spare, Vec3::Zero());
  x_ = Vec3Span(storage_).subspan(0, n);
  v_ = Vec3Span(storage_).subspan(n, n);
  f_ = Vec3Span(storage_).subspan(2 * n, n);
  rest_.resize(n);
  mass_.assign(n, 0.0);

  for (Slot& slot : slots_) {
    const std::size_t count = slot.count();
    if (slot.mapped) {
      slot.resize();
    } else {
      const auto at = static_cast<std::size_t>(slot.offset);
      slot.state->place(x_.subspan(at, count), v_.subspan(at, count), f_.subspan(at, count));
      std::ranges::copy(slot.state->rest(), rest_.begin() + slot.offset);
    }
  }
  for (Mass* mass : masses_) {
    const std::size_t slot = slotOf(mass->state());
    if (slot == none || slots_[slot].mapped) {
      mass->error("mass-mapped", "acts on '" + mass->state().path() +
                                     "', which follows another state: give the mass to that one");
      continue;
    }
    slots_[slot].gravity = mass->node().gravityHere();
    mass->addMasses(std::span(mass_).subspan(static_cast<std::size_t>(slots_[slot].offset),
                                             slots_[slot].count()));
  }
  inverseMass_.resize(n);
  for (std::size_t i = 0; i < n; ++i) inverseMass_[i] = mass_[i] > 0 ? 1 / mass_[i] : 0;

  std::vector<Mat3> free(n, Mat3::Identity());
  std::vector<bool> held(n);
  std::vector<ParticleProjector> own;
  for (ProjectiveConstraint* constraint : constraints_) {
    const std::size_t slot = slotOf(constraint->state());
    if (slot == none || slots_[slot].mapped) {
      constraint->error("constraint-mapped", "holds '" + constraint->state().path() +
                                                 "', which follows another state: hold that one");
      continue;
    }
    own.clear();
    constraint->addProjectors(own);
    for (const ParticleProjector& p : own) {
      const auto i = static_cast<std::size_t>(slots_[slot].offset + p.particle);
      free[i] = held[i] ? intersection(free[i], p.projector) : p.projector;
      held[i] = true;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (held[i]) projectors_.push_back({static_cast<Index>(i), free[i]});
  }
  reset();
}

void System::scheduleMappings(Schedule& schedule) const {
  for (const MappingEntry& entry : mappings_) entry.mapping->schedule(schedule);
}

void System::Slot::resize() {
  for (auto* values : {&x, &v, &f, &dx, &df}) values->resize(count() + spare, Vec3::Zero());
  const auto span = [&](std::vector<Vec3>& values) { return Vec3Span(values).first(count()); };
  state->place(span(x), span(v), span(f));
}

bool System::grow(MechanicalState& state, ConstVec3Span rest) {
  const std::size_t slot = slotOf(state);
  if (slot == none || !slots_[slot].mapped) return false;
  state.append(rest);
  slots_[slot].resize();
  return true;
}

void System::dropAppended() {
  for (Slot& slot : slots_) {
    if (!slot.mapped) continue;
    slot.state->dropAppended();
    slot.resize();
  }
}

void System::reset() {
  for (Slot& slot : slots_) {
    if (slot.mapped) continue;
    std::ranges::copy(slot.state->initialPositions(), slot.state->x().begin());
    std::ranges::copy(slot.state->initialVelocities(), slot.state->v().begin());
    std::ranges::fill(slot.state->f(), Vec3::Zero());
  }
  updateMapped();
}

void System::updateMapped() {
  for (const MappingEntry& entry : mappings_) {
    const MechanicalState &in = *slots_[entry.in].state, &out = *slots_[entry.out].state;
    entry.mapping->apply(in.x(), out.x());
    entry.mapping->applyJ(in.v(), out.v());
  }
}

std::size_t System::slotOf(const MechanicalState& state) const {
  const auto at = std::ranges::find(slots_, &state, [](const Slot& s) { return s.state; });
  return at == slots_.end() ? none : static_cast<std::size_t>(at - slots_.begin());
}

Index System::offsetOf(const MechanicalState& state) const {
  const std::size_t slot = slotOf(state);
  return slot == none || slots_[slot].mapped ? -1 : slots_[slot].offset;
}

Index System::masslessParticle() const {
  const auto at = std::ranges::find_if(mass_, [](double m) { return !(m > 0); });
  return at == mass_.end() ? -1 : static_cast<Index>(at - mass_.begin());
}

std::string System::particleName(Index particle) const {
  for (const Slot& slot : slots_) {
    if (!slot.mapped && particle >= slot.offset && particle < slot.offset + slot.state->size()) {
      return slot.state->path() + ", particle " + std::to_string(particle - slot.offset);
    }
  }
  return "particle " + std::to_string(particle);
}

StateView System::viewOf(const Slot& slot, const StateView& at) const {
  return {part<ConstVec3Span>(slot, at.x, slot.state->x()),
          part<ConstVec3Span>(slot, at.v, slot.state->v()), at.time};
}

void System::mapDown(const StateView& at) const {
  for (const MappingEntry& entry : mappings_) {
    if (!entry.mechanical) continue;
    const StateView in = viewOf(slots_[entry.in], at);
    const MechanicalState& out = *slots_[entry.out].state;
    entry.mapping->apply(in.x, out.x());
    entry.mapping->applyJ(in.v, out.v());
  }
}

void System::computeForce(const StateView& at, Vec3Span f) {
  mapDown(at);
  for (const Slot& slot : slots_) {
    const Vec3Span own = part<Vec3Span>(slot, f, slot.state->f());
    if (slot.mapped || slot.gravity.isZero()) {
      std::ranges::fill(own, Vec3::Zero());
    } else {
      const double* m = mass_.data() + slot.offset;
      parallelFor(slot.state->size(),
                  [&](Index i) { own[static_cast<std::size_t>(i)] = m[i] * slot.gravity; });
    }
  }
  for (const Slot& slot : slots_) {
    const Vec3Span own = part<Vec3Span>(slot, f, slot.state->f());
    for (ForceField* force : slot.forceFields) force->addForce(viewOf(slot, at), own);
  }
  for (auto entry = mappings_.rbegin(); entry != mappings_.rend(); ++entry) {
    if (!entry->mechanical) continue;
    const Slot& in = slots_[entry->in];
    entry->mapping->addTransposed(slots_[entry->out].state->f(),
                                  part<Vec3Span>(in, f, in.state->f()));
  }
}

double System::potentialEnergy(const StateView& at) {
  mapDown(at);
  double energy = 0;
  for (const Slot& slot : slots_) {
    const StateView own = viewOf(slot, at);
    for (ForceField* force : slot.forceFields) energy += force->potentialEnergy(own);
    if (slot.mapped || slot.gravity.isZero()) continue;
    const double* m = mass_.data() + slot.offset;
    energy -= parallelSum(slot.state->size(), 0.0, [&](Index begin, Index end) {
      double sum = 0;
      for (Index i = begin; i < end; ++i)
        sum += m[i] * slot.gravity.dot(own.x[static_cast<std::size_t>(i)]);
      return sum;
    });
  }
  return energy;
}

double System::kineticEnergy(ConstVec3Span v) const {
  return parallelSum(size_, 0.0, [&](Index begin, Index end) {
    double sum = 0;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      sum += 0.5 * mass_[i] * v[i].squaredNorm();
    }
    return sum;
  });
}

void System::linearize(const StateView& at) {
  mapDown(at);
  for (const Slot& slot : slots_) {
    for (ForceField* force : slot.forceFields) force->linearize(viewOf(slot, at));
  }
}

void System::addTangentProduct(ConstVec3Span dx, double stiffness, double damping,
                               Vec3Span df) const {
  for (const MappingEntry& entry : mappings_) {
    if (!entry.mechanical) continue;
    const Slot &in = slots_[entry.in], &out = slots_[entry.out];
    entry.mapping->applyJ(part<ConstVec3Span>(in, dx, in.scratch(in.dx)), out.scratch(out.dx));
  }
  for (const Slot& slot : slots_) {
    std::ranges::fill(slot.df, Vec3::Zero());
    for (const ForceField* force : slot.forceFields) {
      force->addTangentProduct(part<ConstVec3Span>(slot, dx, slot.scratch(slot.dx)), stiffness,
                               damping, part<Vec3Span>(slot, df, slot.scratch(slot.df)));
    }
  }
  for (auto entry = mappings_.rbegin(); entry != mappings_.rend(); ++entry) {
    if (!entry->mechanical) continue;
    const Slot& in = slots_[entry->in];
    const Slot& out = slots_[entry->out];
    entry->mapping->addTransposed(out.scratch(out.df), part<Vec3Span>(in, df, in.scratch(in.df)));
  }
}

void System::project(Vec3Span a) const {
  for (const ParticleProjector& p : projectors_) {
    Vec3& value = a[static_cast<std::size_t>(p.particle)];
    value = p.projector * value;
  }
}

BlockPattern System::pattern(bool& complete) const {
  BlockPattern pattern(size_);
  complete = true;
  for (const Slot& slot : slots_) {
    for (const ForceField* force : slot.forceFields) {
      if (slot.mapped || !force->addPattern(pattern, slot.offset)) complete = false;
    }
  }
  return pattern;
}

void System::addTangent(BlockMatrix& matrix, double stiffness, double damping) const {
  for (const Slot& slot : slots_) {
    if (slot.mapped) continue;
    for (const ForceField* force : slot.forceFields) {
      force->addTangent(matrix, slot.offset, stiffness, damping);
    }
  }
}

std::vector<ForceField*> System::forceFields() const {
  std::vector<ForceField*> all;
  for (const Slot& slot : slots_) {
    all.insert(all.end(), slot.forceFields.begin(), slot.forceFields.end());
  }
  return all;
}

std::vector<MechanicalState*> System::states() const {
  std::vector<MechanicalState*> all;
  for (const Slot& slot : slots_) {
    if (!slot.mapped) all.push_back(slot.state);
  }
  return all;
}

std::vector<MechanicalState*> System::mappedStates() const {
  std::vector<MechanicalState*> all;
  for (const Slot& slot : slots_) {
    if (slot.mapped) all.push_back(slot.state);
  }
  return all;
}

void SystemMatrix::multiply(ConstVec3Span in, Vec3Span out) const {
  const auto m = system.mass();
  const double factor = mass;
  parallelFor(system.size(), [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    out[i] = factor * m[i] * in[i];
  });
  system.addTangentProduct(in, -stiffness, -damping, out);
  system.project(out);
}

void SystemMatrix::assemble(BlockMatrix& matrix) const {
  matrix.setZero();
  const auto m = system.mass();
  for (Index i = 0; i < system.size(); ++i)
    matrix.addDiagonal(i, mass * m[static_cast<std::size_t>(i)]);
  system.addTangent(matrix, -stiffness, -damping);
  for (const ParticleProjector& p : system.projectors()) matrix.project(p.particle, p.projector);
}

}  // namespace stroma
