// SPDX-License-Identifier: Apache-2.0
// What scenes written for SOFA call things: renamed components, and elements and attributes that
// are accepted without effect here.
#pragma once

#include <string_view>

namespace stroma::sofa {

// Current name of a component that SOFA once called otherwise; the name itself when it is not
// renamed.
[[nodiscard]] std::string_view currentName(std::string_view component);

// Elements that concern SOFA's display and book-keeping, or a split of its solvers that this one
// does not have (constraint corrections).
[[nodiscard]] bool isIgnoredElement(std::string_view component);

// Attributes of nodes and of any component that have no meaning here.
[[nodiscard]] bool isIgnoredNodeAttribute(std::string_view name);
[[nodiscard]] bool isIgnoredAttribute(std::string_view component, std::string_view name);

}  // namespace stroma::sofa
