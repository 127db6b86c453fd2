// SPDX-License-Identifier: Apache-2.0
// The elements of a scene file with the place of every name and value, includes and parameters
// expanded.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/source.h"

namespace stroma {

struct SceneAttribute {
  std::string name, value;
  SourceRange nameAt, valueAt;  // valueAt covers the text between the quotes
};

struct SceneElement {
  std::string tag;
  SourceRange at;  // the tag's name
  std::vector<SceneAttribute> attributes;
  std::vector<SceneElement> children;

  [[nodiscard]] const SceneAttribute* find(std::string_view name) const;
};

// Parses XML text. Syntax errors, several roots and text between elements are reported; null then.
[[nodiscard]] std::optional<SceneElement> parseSceneText(std::shared_ptr<const SourceText> source,
                                                         Diagnostics& diagnostics);

// Looks a file up: as it is when absolute, else beside `relativeTo`, then in the data folders. On
// failure `searched` lists the places.
[[nodiscard]] std::optional<std::filesystem::path> findFile(
    const std::string& name, const std::filesystem::path& relativeTo,
    const std::vector<std::filesystem::path>& dataFolders, std::string& searched);

// Reads a scene file and expands its includes:
//   <include href="file.xml" name="X" attr="v" Child__attr="v" param.p="v"/>
// The included root becomes a node X; when its name is Group or _Group_ its children are spliced
// in. `attr` replaces that attribute in every element below that has it, `Child__attr` only in
// elements named Child, and `param.p` replaces ${p} in values.
[[nodiscard]] std::optional<SceneElement> readSceneFile(
    const std::filesystem::path& file, const std::vector<std::filesystem::path>& dataFolders,
    Diagnostics& diagnostics);
// The same for text; `file` names it in messages and is the place that includes are relative to.
[[nodiscard]] std::optional<SceneElement> readSceneText(
    std::string text, const std::filesystem::path& file,
    const std::vector<std::filesystem::path>& dataFolders, Diagnostics& diagnostics);

}  // namespace stroma
