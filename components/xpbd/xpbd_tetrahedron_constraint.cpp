// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/xpbd_tetrahedron_constraint.h"

#include "components/material/lame.h"

namespace stroma {

void XpbdTetrahedra::bind() {
  const auto elements = topology->tetrahedra();
  if (!checkElements(elements.size(), "tetrahedra")) return;
  const ConstVec3Span rest = mechanicalState->rest();
  const TetrahedronPairs::Flaw flaw = TetrahedronPairs::findFlaw(rest, elements);
  if (flaw.count > 0) {
    std::string nodes;
    for (const Index i : elements[static_cast<std::size_t>(flaw.first)])
      nodes += (nodes.empty() ? "" : " ") + std::to_string(i);
    error(topology, "element-inverted",
          "'" + topology->path() + "' has " + std::to_string(flaw.count) + " of " +
              std::to_string(elements.size()) +
              " tetrahedra inverted or without volume; the first is number " +
              std::to_string(flaw.first) + " (" + nodes + ")",
          "the first three nodes are counter-clockwise seen from the fourth: exchange two");
    return;
  }
  warnOfLooseNodes({elements.front().data(), 4 * elements.size()});
  pairs_.emplace(rest, elements);
  pairs_->setModuli(moduli());
  colours.set(pairs_->colours());
}

TetrahedronModuli XpbdTetrahedronConstraint::moduli() const {
  const Lame lame(youngModulus, poissonRatio);
  return {lame.mu, lame.lambda + lame.mu};
}

}  // namespace stroma
