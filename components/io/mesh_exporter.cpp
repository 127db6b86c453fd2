// SPDX-License-Identifier: Apache-2.0
#include "components/io/mesh_exporter.h"

#include <algorithm>
#include <cstdio>

namespace stroma {

void MeshExporter::bind() {
  elements_ = mesh ? mesh.get() : topology.get();
  if (!elements_ || elements_->triangles().empty()) {
    error("export-elements",
          "has no triangles to write: add a topology to the node, or mesh=\"@...\"");
    return;
  }
  Index last = 0;
  for (const Triangle& t : elements_->triangles()) last = std::max(last, std::ranges::max(t));
  if (last >= mechanicalState->size()) {
    error("export-elements", "writes triangles that use point " + std::to_string(last) +
                                 "; the state has " + std::to_string(mechanicalState->size()));
  }
}

void MeshExporter::topologyChanged(const TopologyChange& change) {
  checkFollows(change, *mechanicalState, elements_);
}

void MeshExporter::reset() {
  ended_ = false;
  Recorder::reset();
}

void MeshExporter::stop() {
  ended_ = true;
  setLastStep(std::nullopt);
  Recorder::stop();
}

void MeshExporter::record(double, std::uint64_t step) {
  char number[32] = "";
  if (!ended_)
    std::snprintf(number, sizeof number, "_%06llu", static_cast<unsigned long long>(step));
  const std::string ending = number + ("." + ValueTraits<SurfaceFormat>::print(format));
  replaceFile(outputFile(ending),
              surfaceFile(format, mechanicalState->x(), elements_->triangles()));
}

}  // namespace stroma
