// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/study/names.h"
#include "tools/study/study.h"

namespace stroma::study {

// The tags of edits, in the order of Edit::Kind.
inline const Names editTags{"Set", "Replace", "Remove", "Insert"};

// Reads an element that has one of these tags; `methods` are the names of the question's methods.
[[nodiscard]] Edit readEdit(const SceneElement& element, const Names& methods,
                            Diagnostics& diagnostics);

}  // namespace stroma::study
