// SPDX-License-Identifier: Apache-2.0
#include "tools/study/scene_target.h"

#include "core/path.h"

namespace stroma::study {

Target targetOf(Scene& scene, const std::string& path, bool isAttribute, std::string& problem,
                std::string& hint) {
  if (!isAttribute) {
    const PathTarget found = resolvePath(scene.root(), nullptr, path, problem, hint);
    if (found && !found.component) {
      problem = stroma::quoted(path) + " is a node; a component is wanted";
    }
    return {found.component, nullptr};
  }
  auto [component, attribute] = findAttribute(scene.root(), path, problem, hint);
  if (attribute && !attribute->number()) {
    problem = stroma::quoted(path) + " is not a number but " + attribute->typeName();
    attribute = nullptr;
  }
  return {component, attribute};
}

}  // namespace stroma::study
