// SPDX-License-Identifier: Apache-2.0
// What the declarations of components say about themselves, as text: the reference (for terminals
// and as Markdown pages) and an XML Schema that editors complete and check scenes with. Nothing
// here is written by hand twice: names, types, units, ranges, defaults and help are those that the
// reader works with.
#pragma once

#include <string>

#include "core/registry.h"

namespace stroma {

class Scene;

// The roles (ForceField, Topology, ...) that a component can play in links, "Component" where none.
[[nodiscard]] std::string rolesOf(const Component& component);

// "number, Pa, > 0, default 5000": all but the help.
[[nodiscard]] std::string attributeSummary(const AttributeBase& attribute);

// Reference of one component: what it does, attributes, links, limiters.
[[nodiscard]] std::string referenceText(const Registry& registry, const ComponentEntry& entry);
[[nodiscard]] std::string referenceMarkdown(const Registry& registry, const ComponentEntry& entry);

// XML Schema 1.0 of scenes with the components in the scene's registry. Values are checked as far
// as a pattern can tell; links and units stay the reader's business.
[[nodiscard]] std::string schemaXsd(Scene& scene);

}  // namespace stroma
