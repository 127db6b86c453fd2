// SPDX-License-Identifier: Apache-2.0
#include "core/interfaces/mapping.h"

#include "core/schedule.h"

namespace stroma {

void Mapping::schedule(Schedule& schedule) {
  schedule.add<&Mapping::follow>(Stage::Map, *this, "follow",
                                 visual && !mechanical_ ? Rate::visual : Rate::step);
}

void Mapping::follow(const StepContext&) {
  apply(input().x(), output().x());
  applyJ(input().v(), output().v());
}

}  // namespace stroma
