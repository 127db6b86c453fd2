// SPDX-License-Identifier: Apache-2.0
#include "components/solver/stability_estimate.h"

#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace stroma {
namespace {

// Change of the eigenvalue in an iteration that ends it; a few per cent are then still missing.
constexpr double relativeChange = 1e-3;

double massNorm(const System& system, ConstVec3Span a) {
  return std::sqrt(2 * system.kineticEnergy(a));
}

// Signs that look random and have a part along every mode.
std::vector<Vec3> startVector(const System& system) {
  std::vector<Vec3> vector(static_cast<std::size_t>(system.size()));
  std::uint64_t bits = 0x9e3779b97f4a7c15ULL;
  for (Vec3& value : vector) {
    for (int axis = 0; axis < 3; ++axis) {
      // xorshift64 (Marsaglia 2003)
      bits ^= bits << 13;
      bits ^= bits >> 7;
      bits ^= bits << 17;
      value[axis] = static_cast<double>(bits >> 11) * 0x1p-52 - 1;
    }
  }
  system.project(vector);
  return vector;
}

}  // namespace

double StabilityEstimate::largestEigenvalue(const System& system, double stiffness, double damping,
                                            int iterations, std::vector<Vec3>& vector) {
  if (vector.size() != static_cast<std::size_t>(system.size())) vector = startVector(system);
  image_.resize(vector.size());
  const auto inverseMass = system.inverseMass();
  double eigenvalue = 0, size = massNorm(system, vector);
  for (int iteration = 0; iteration < iterations && size > 0; ++iteration) {
    std::ranges::fill(image_, Vec3::Zero());
    system.addTangentProduct(vector, stiffness, damping, image_);
    system.project(image_);
    parallelFor(system.size(), [&](Index k) {
      const auto i = static_cast<std::size_t>(k);
      image_[i] *= inverseMass[i];
    });
    const double last = eigenvalue, imageSize = massNorm(system, image_);
    eigenvalue = imageSize / size;
    if (!(eigenvalue > 0)) {
      vector.clear();  // an image of zero says nothing about a later state
      return 0;
    }
    parallelFor(system.size(), [&](Index k) {
      const auto i = static_cast<std::size_t>(k);
      vector[i] = image_[i] / imageSize;
    });
    size = 1;
    if (std::abs(eigenvalue - last) <= relativeChange * eigenvalue) break;
  }
  return eigenvalue;
}

void StabilityEstimate::update(const System& system, double rayleighMass, double rayleighStiffness,
                               int iterations) {
  stiffness_ = largestEigenvalue(system, 1, 0, iterations, stiffnessVector_);
  damping_ = rayleighMass + rayleighStiffness * stiffness_ +
             largestEigenvalue(system, 0, 1, iterations, dampingVector_);
}

void StabilityEstimate::disturb(const System& system) {
  constexpr double part = 0.3;
  for (std::vector<Vec3>* vector : {&stiffnessVector_, &dampingVector_}) {
    if (vector->size() != static_cast<std::size_t>(system.size())) continue;
    const std::vector<Vec3> all = startVector(system);
    const double size = massNorm(system, *vector), other = massNorm(system, all);
    if (size > 0 && other > 0)
      flat(Vec3Span(*vector)) += part * size / other * flat(ConstVec3Span(all));
  }
}

double StabilityEstimate::largestStep() const {
  if (stiffness_ <= 0 && damping_ <= 0) return std::numeric_limits<double>::infinity();
  return 4 / (damping_ + std::sqrt(damping_ * damping_ + 4 * stiffness_));
}

void StabilityEstimate::save(StateWriter& writer) const {
  writer.write("stability.stiffness", stiffness_);
  writer.write("stability.damping", damping_);
  writer.write("stability.stiffnessVector", ConstVec3Span(stiffnessVector_));
  writer.write("stability.dampingVector", ConstVec3Span(dampingVector_));
}

void StabilityEstimate::restore(StateReader& reader) {
  const auto vector = [&](std::string_view name, std::vector<Vec3>& values) {
    values.resize(reader.count<double>(name) / 3);
    if (!reader.read(name, Vec3Span(values))) values.clear();
  };
  const bool known =
      reader.read("stability.stiffness", stiffness_) && reader.read("stability.damping", damping_);
  if (!known) return;
  vector("stability.stiffnessVector", stiffnessVector_);
  vector("stability.dampingVector", dampingVector_);
}

}  // namespace stroma
