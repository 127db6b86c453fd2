// SPDX-License-Identifier: Apache-2.0
#include "components/xpbd/xpbd_tetrahedron_constraint.h"

#include "components/material/lame.h"
#include "core/element_body.h"

namespace stroma {

void XpbdTetrahedra::bind() {
  const auto elements = topology->tetrahedra();
  if (!checkElements(*this, topology, *mechanicalState, elements.size(), "tetrahedra")) return;
  const ConstVec3Span rest = mechanicalState->rest();
  const ElementFlaw flaw = TetrahedronPairs::findFlaw(rest, elements);
  if (flaw.count > 0) {
    refuseFlaw(*this, topology, flaw, elements.size(), "tetrahedra",
               elements[static_cast<std::size_t>(flaw.first)],
               "the first three nodes are counter-clockwise seen from the fourth: exchange two");
    return;
  }
  warnOfLoose({elements.front().data(), 4 * elements.size()});
  pairs_.emplace(rest, elements);
  pairs_->setModuli(moduli());
  colours.set(pairs_->colours());
}

TetrahedronModuli XpbdTetrahedronConstraint::moduli() const {
  const Lame lame(youngModulus, poissonRatio);
  return {lame.mu, lame.lambda + lame.mu};
}

}  // namespace stroma
