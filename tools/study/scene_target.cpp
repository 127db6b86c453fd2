// SPDX-License-Identifier: Apache-2.0
#include "tools/study/scene_target.h"

#include "core/path.h"

namespace stroma::study {

Target targetOf(Scene& scene, const std::string& path, bool isAttribute, std::string& problem,
                std::string& hint) {
  const PathParts parts = isAttribute ? splitPath(path) : PathParts{path, {}};
  const PathTarget found = resolvePath(scene.root(), nullptr, parts.object, problem, hint);
  if (!found) return {};
  if (!isAttribute) {
    if (!found.component) problem = stroma::quoted(path) + " is a node; a component is wanted";
    return {found.component, nullptr};
  }
  AttributeOwner& owner =
      found.component ? static_cast<AttributeOwner&>(*found.component) : *found.node;
  AttributeBase* attribute = owner.attribute(parts.attribute);
  if (!attribute) {
    problem = owner.describe() + " has no attribute " + stroma::quoted(parts.attribute);
    std::vector<std::string> names;
    for (const AttributeBase* a : owner.attributes()) names.emplace_back(a->name());
    hint = didYouMean(parts.attribute, names);
  } else if (!attribute->number()) {
    problem = stroma::quoted(path) + " is not a number but " + attribute->typeName();
    attribute = nullptr;
  }
  return {found.component, attribute};
}

}  // namespace stroma::study
