// SPDX-License-Identifier: Apache-2.0
// Edits of a scene's elements, before it is read. Includes are expanded by then, so what they bring
// can be edited, too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/study/study.h"

namespace stroma::study {

// Makes the edits that replace, remove or insert elements, in their order; what a `set` changes is
// left to the scene's overrides. Elements are found by path ("/beam/elasticity"); one without a
// name goes by its tag. Problems are reported at the edit.
void edit(SceneElement& root, const std::vector<Edit>& edits, Diagnostics& diagnostics);

// The name by which paths find an element: one without a name goes by its tag.
[[nodiscard]] std::string nameOf(const SceneElement& element);
// The element that a path ("/beam/elasticity") names; null where there is none.
[[nodiscard]] SceneElement* elementAt(SceneElement& root, std::string_view path);

// The elements as XML text.
[[nodiscard]] std::string sceneText(const SceneElement& root);

}  // namespace stroma::study
