// SPDX-License-Identifier: Apache-2.0
#include "components/fem/mesh_spring_force_field.h"

#include <algorithm>

#include "core/element_body.h"

namespace stroma {

std::array<MeshSpringForceField::Kind, 5> MeshSpringForceField::kinds() const {
  return {{{linesStiffness, linesDamping},
           {trianglesStiffness, trianglesDamping},
           {quadsStiffness, quadsDamping},
           {tetrahedraStiffness, tetrahedraDamping},
           {cubesStiffness, cubesDamping}}};
}

void MeshSpringForceField::configure() {
  const auto given = [](const Kind& kind) { return kind.stiffness.isSet(); };
  if (stiffness.isSet() || std::ranges::any_of(kinds(), given)) return;
  error("attr-required",
        "needs 'stiffness', or that of a kind of element such as 'linesStiffness'");
}

template <std::size_t N>
void MeshSpringForceField::connect(const Kind& kind, std::span<const std::array<Index, N>> elements,
                                   std::set<Edge>& known, std::vector<Spring>& springs) const {
  const double k = kind.stiffness.isSet() ? *kind.stiffness : *stiffness;
  const double d = kind.damping.isSet() ? *kind.damping : *damping;
  if (k == 0 && d == 0) return;
  const ConstVec3Span rest = mechanicalState->rest();
  for (const auto& element : elements)
    for (std::size_t a = 0; a < N; ++a)
      for (std::size_t b = a + 1; b < N; ++b) {
        const auto [low, high] = std::minmax(element[a], element[b]);
        if (!known.insert({low, high}).second) continue;
        const double length =
            (rest[static_cast<std::size_t>(high)] - rest[static_cast<std::size_t>(low)]).norm();
        springs.push_back({{low, high}, k / length, d / length, length});
      }
}

void MeshSpringForceField::bind() {
  if (!checkPoints(*this, topology, *mechanicalState)) return;
  std::set<Edge> known;
  std::vector<Spring> springs;
  const std::array<Kind, 5> kind = kinds();
  connect(kind[0], topology->edges(), known, springs);
  connect(kind[1], topology->triangles(), known, springs);
  connect(kind[2], topology->quads(), known, springs);
  connect(kind[3], topology->tetrahedra(), known, springs);
  connect(kind[4], topology->hexahedra(), known, springs);
  if (springs.empty()) {
    error(topology, "spring-none",
          "'" + topology->path() + "' has no elements of a kind that is given a stiffness");
    return;
  }
  const auto point = std::ranges::find_if(springs, [](const Spring& s) { return !(s.length > 0); });
  if (point != springs.end()) {
    error("spring-length", "particles " + std::to_string(point->ends[0]) + " and " +
                               std::to_string(point->ends[1]) +
                               " lie at the same place: a spring between them has no length");
    return;
  }
  springs_ = std::make_unique<MeshSprings>(mechanicalState->size(), springs, noCompression);
  springCount.set(springs_->springCount());
  Index loose = 0;
  for (Index i = 0; i < mechanicalState->size(); ++i) loose += springs_->springsOf(i) == 0;
  warnOfLooseParticles(*this, loose, mechanicalState->size(), "spring");
}

void MeshSpringForceField::start() {
  refuseCuts(*this, *mechanicalState, *topology, "MLSForceField follows them");
}

}  // namespace stroma
