// SPDX-License-Identifier: Apache-2.0
// Says what is wrong with a text that the XML parser refused, in words and at the right place: the
// parser itself knows only a kind and a line.
#pragma once

#include <optional>
#include <string>

#include "core/source.h"

namespace stroma {

struct XmlProblem {
  std::string message;
  std::size_t offset = 0, length = 1;
  std::string hint;
};

// The first problem found; none when the text looks well-formed. Elements, attributes, quotes and
// comments are looked at; that there is one root is not.
[[nodiscard]] std::optional<XmlProblem> findXmlProblem(const SourceText& source);

}  // namespace stroma
