// SPDX-License-Identifier: Apache-2.0
// What the paths of measures name in a scene.
#pragma once

#include <string>

#include "core/scene.h"

namespace stroma::study {

// What a path names: a component, or a numeric attribute of one or of a node.
struct Target {
  Component* component = nullptr;
  AttributeBase* attribute = nullptr;
};

// Null where there is none, which `problem` then tells, with a hint where a name is near.
[[nodiscard]] Target targetOf(Scene& scene, const std::string& path, bool isAttribute,
                              std::string& problem, std::string& hint);

// The component there, null and a problem where it is none of type T.
template <class T>
[[nodiscard]] T* componentAt(Scene& scene, const std::string& path, std::string& problem,
                             std::string& hint) {
  Component* component = targetOf(scene, path, false, problem, hint).component;
  T* wanted = dynamic_cast<T*>(component);
  if (component && !wanted) {
    problem = stroma::quoted(path) + " is a " + component->type() + "; a " + std::string(T::role) +
              " is wanted";
  }
  return wanted;
}

}  // namespace stroma::study
