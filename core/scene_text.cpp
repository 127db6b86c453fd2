// SPDX-License-Identifier: Apache-2.0
#include "core/scene_text.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/xml_problem.h"

namespace stroma {
namespace fs = std::filesystem;
namespace {

constexpr int deepestInclude = 16;

// tinyxml2 keeps one copy of the text and points into it, but tells only lines. The first '<'
// anchors its pointers to our offsets; a pointer that does not fit falls back to the line.
class Locator {
 public:
  Locator(const tinyxml2::XMLDocument& document, std::shared_ptr<const SourceText> source)
      : source_(std::move(source)) {
    const tinyxml2::XMLNode* first = document.FirstChild();
    const std::size_t open = source_->text().find('<');
    if (!first || open == std::string_view::npos) return;
    const std::size_t mark = first->ToElement()       ? 1
                             : first->ToComment()     ? 4
                             : first->ToDeclaration() ? 2
                             : first->ToUnknown()     ? 2
                                                      : 0;
    if (mark == 0) return;
    anchor_ = first->Value();
    anchorOffset_ = open + mark;
  }
  [[nodiscard]] SourceRange at(const char* text, int line) const {
    const std::string_view whole = source_->text();
    if (anchor_) {
      const auto offset = static_cast<std::ptrdiff_t>(anchorOffset_) + (text - anchor_);
      const std::size_t length = std::strlen(text);
      // entities and line ends are rewritten in place, so only the beginning must agree
      if (offset >= 0 && static_cast<std::size_t>(offset) + length <= whole.size()) {
        const auto start = static_cast<std::size_t>(offset);
        const std::size_t same = std::min<std::size_t>(length, 1);
        if (whole.substr(start, same) == std::string_view(text, same) || whole[start] == '&' ||
            whole[start] == '\r') {
          return {source_, start, length};
        }
      }
    }
    const std::string_view lineText = source_->line(line);
    return {source_, static_cast<std::size_t>(lineText.data() - whole.data()), lineText.size()};
  }

 private:
  std::shared_ptr<const SourceText> source_;
  const char* anchor_ = nullptr;
  std::size_t anchorOffset_ = 0;
};

void convert(const tinyxml2::XMLElement& from, const Locator& locator, Diagnostics& diagnostics,
             SceneElement& to) {
  to.tag = from.Value();
  to.at = locator.at(from.Value(), from.GetLineNum());
  for (const auto* a = from.FirstAttribute(); a; a = a->Next()) {
    to.attributes.push_back({a->Name(), a->Value(), locator.at(a->Name(), a->GetLineNum()),
                             locator.at(a->Value(), a->GetLineNum())});
  }
  for (const auto* child = from.FirstChild(); child; child = child->NextSibling()) {
    if (const auto* element = child->ToElement()) {
      convert(*element, locator, diagnostics, to.children.emplace_back());
    } else if (const auto* text = child->ToText(); text && !text->CData()) {
      const std::string_view value = text->Value();
      const std::size_t begin = value.find_first_not_of(" \t\r\n");
      if (begin == std::string_view::npos) continue;
      const std::size_t length = value.find_last_not_of(" \t\r\n") + 1 - begin;
      SourceRange at = locator.at(text->Value(), text->GetLineNum());
      at.offset += begin;
      at.length = length;
      diagnostics.error(
          "xml-text",
          "text between elements has no meaning here: " + quoted(value.substr(begin, length)), at);
    }
  }
}

// What tinyxml2 found, in words and at the place where it is.
void reportSyntax(const tinyxml2::XMLDocument& document,
                  const std::shared_ptr<const SourceText>& source, Diagnostics& diagnostics) {
  using namespace tinyxml2;
  const XMLError kind = document.ErrorID();
  if (kind == XML_ERROR_EMPTY_DOCUMENT) {
    diagnostics.error("xml-syntax", "the file has no elements", {source, 0, 1});
    return;
  }
  const bool deep = kind == XML_ELEMENT_DEPTH_EXCEEDED;
  if (const auto problem = deep ? std::nullopt : findXmlProblem(*source)) {
    diagnostics.error("xml-syntax", problem->message, {source, problem->offset, problem->length},
                      problem->hint);
    return;
  }
  const std::string message = deep ? "elements are nested too deeply" : "not well-formed XML";
  const int line = std::clamp(document.ErrorLineNum(), 1, std::max(1, source->lineCount()));
  const std::string_view text = source->line(line);
  std::size_t offset = static_cast<std::size_t>(text.data() - source->text().data());
  const std::size_t indent = std::min(text.find_first_not_of(" \t"), text.size());
  diagnostics.error("xml-syntax", message,
                    {source, offset + indent, std::max<std::size_t>(1, text.size() - indent)});
}

class Includer {
 public:
  Includer(const std::vector<fs::path>& dataFolders, Diagnostics& diagnostics)
      : dataFolders_(dataFolders), diagnostics_(diagnostics) {}

  void expand(SceneElement& element, const fs::path& file, int depth) {
    std::vector<SceneElement> children;
    for (SceneElement& child : element.children) {
      if (child.tag != "include") {
        expand(child, file, depth);
        children.push_back(std::move(child));
      } else {
        include(child, file, depth, children);
      }
    }
    element.children = std::move(children);
  }

 private:
  void include(const SceneElement& include, const fs::path& file, int depth,
               std::vector<SceneElement>& into) {
    const SceneAttribute* href = include.find("href");
    if (!href) {
      diagnostics_.error("include-href", "include needs href=\"file.xml\"", include.at);
      return;
    }
    std::string searched;
    const auto found = findFile(href->value, file.parent_path(), dataFolders_, searched);
    if (!found) {
      diagnostics_.error("file-missing", "cannot find the scene to include, '" + href->value + "'",
                         href->valueAt, "searched: " + searched);
      return;
    }
    if (depth >= deepestInclude) {
      diagnostics_.error("include-depth",
                         "includes are nested more than " + std::to_string(deepestInclude) +
                             " deep: does a scene include itself?",
                         href->valueAt);
      return;
    }
    std::ifstream stream(*found, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    auto root = parseSceneText(std::make_shared<SourceText>(found->string(), text), diagnostics_);
    if (!root) return;
    std::string name;
    for (const SceneAttribute& a : include.attributes) {
      if (a.name == "href") continue;
      if (a.name == "name") {
        name = a.value;
      } else if (a.name.starts_with("param.")) {
        const std::string key = "${" + a.name.substr(6) + "}";
        if (substitute(*root, key, a.value) == 0) {
          diagnostics_.error("include-unused", "'" + href->value + "' has no " + key, a.nameAt);
        }
      } else {
        const std::size_t split = a.name.find("__");
        const std::string only = split == std::string::npos ? "" : a.name.substr(0, split);
        SceneAttribute replacement = a;
        if (split != std::string::npos) replacement.name = a.name.substr(split + 2);
        if (replace(*root, only, replacement) == 0) {
          std::vector<std::string> names;
          collectNames(*root, names);
          diagnostics_.error("include-unused",
                             "no element of '" + href->value + "'" +
                                 (only.empty() ? "" : " called '" + only + "'") +
                                 " has the attribute '" + replacement.name + "'",
                             a.nameAt, didYouMean(replacement.name, names));
        }
      }
    }
    expand(*root, *found, depth + 1);
    const SceneAttribute* own = root->find("name");
    const std::string shown = !name.empty() ? name : own ? own->value : "";
    if (shown == "Group" || shown == "_Group_") {
      for (SceneElement& child : root->children) into.push_back(std::move(child));
      return;
    }
    if (!name.empty()) setName(*root, *include.find("name"));
    into.push_back(std::move(*root));
  }

  static void setName(SceneElement& element, const SceneAttribute& name) {
    for (SceneAttribute& a : element.attributes) {
      if (a.name == "name") {
        a = name;
        return;
      }
    }
    element.attributes.push_back(name);
  }

  // These return how often they changed something.
  static int substitute(SceneElement& element, const std::string& key, const std::string& value) {
    int count = 0;
    for (SceneAttribute& a : element.attributes) {
      for (std::size_t at = a.value.find(key); at != std::string::npos;
           at = a.value.find(key, at + value.size())) {
        a.value.replace(at, key.size(), value);
        ++count;
      }
    }
    for (SceneElement& child : element.children) count += substitute(child, key, value);
    return count;
  }

  static int replace(SceneElement& element, const std::string& onlyNamed,
                     const SceneAttribute& value) {
    int count = 0;
    const SceneAttribute* name = element.find("name");
    if (onlyNamed.empty() || (name && name->value == onlyNamed)) {
      for (SceneAttribute& a : element.attributes) {
        if (a.name != value.name) continue;
        a = value;
        ++count;
      }
    }
    for (SceneElement& child : element.children) count += replace(child, onlyNamed, value);
    return count;
  }

  static void collectNames(const SceneElement& element, std::vector<std::string>& names) {
    for (const SceneAttribute& a : element.attributes) names.push_back(a.name);
    for (const SceneElement& child : element.children) collectNames(child, names);
  }

  const std::vector<fs::path>& dataFolders_;
  Diagnostics& diagnostics_;
};

}  // namespace

const SceneAttribute* SceneElement::find(std::string_view name) const {
  const auto found = std::ranges::find(attributes, name, &SceneAttribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

std::optional<SceneElement> parseSceneText(std::shared_ptr<const SourceText> source,
                                           Diagnostics& diagnostics) {
  const std::size_t zero = source->text().find('\0');
  if (zero != std::string_view::npos) {
    diagnostics.error("xml-syntax", "the file holds a zero byte: it is not XML text",
                      {source, zero, 1});
    return std::nullopt;
  }
  tinyxml2::XMLDocument document;
  if (document.Parse(source->text().data(), source->text().size()) != tinyxml2::XML_SUCCESS) {
    reportSyntax(document, source, diagnostics);
    return std::nullopt;
  }
  const Locator locator(document, source);
  const tinyxml2::XMLElement* root = document.RootElement();
  if (!root) {
    diagnostics.error("xml-syntax", "the file has no elements", {source, 0, 1});
    return std::nullopt;
  }
  bool good = true;
  if (const auto* second = root->NextSiblingElement()) {
    diagnostics.error(
        "xml-two-roots",
        "a scene has one root element; '" + std::string(second->Value()) + "' is a second one",
        locator.at(second->Value(), second->GetLineNum()), "put both into one Node");
    good = false;
  }
  SceneElement element;
  const int before = diagnostics.errorCount();
  convert(*root, locator, diagnostics, element);
  if (!good || diagnostics.errorCount() > before) return std::nullopt;
  return element;
}

std::optional<fs::path> findFile(const std::string& name, const fs::path& relativeTo,
                                 const std::vector<fs::path>& dataFolders, std::string& searched) {
  std::vector<fs::path> candidates;
  if (fs::path(name).is_absolute()) {
    candidates.push_back(name);
  } else {
    candidates.push_back(relativeTo / name);
    for (const fs::path& folder : dataFolders) candidates.push_back(folder / name);
  }
  for (const fs::path& candidate : candidates) {
    std::error_code failure;
    if (fs::is_regular_file(candidate, failure)) return candidate.lexically_normal();
    searched += (searched.empty() ? "" : ", ") + candidate.lexically_normal().string();
  }
  return std::nullopt;
}

std::optional<SceneElement> readSceneText(std::string text, const fs::path& file,
                                          const std::vector<fs::path>& dataFolders,
                                          Diagnostics& diagnostics) {
  auto root =
      parseSceneText(std::make_shared<SourceText>(file.string(), std::move(text)), diagnostics);
  if (root) Includer(dataFolders, diagnostics).expand(*root, file, 0);
  return root;
}

std::optional<SceneElement> readSceneFile(const fs::path& file,
                                          const std::vector<fs::path>& dataFolders,
                                          Diagnostics& diagnostics) {
  std::error_code failure;
  std::ifstream stream;
  if (fs::is_regular_file(file, failure)) stream.open(file, std::ios::binary);
  if (!stream.is_open()) {
    diagnostics.error("file-missing", "cannot read the scene '" + file.string() + "'");
    return std::nullopt;
  }
  return readSceneText({std::istreambuf_iterator<char>(stream), {}}, file, dataFolders,
                       diagnostics);
}

}  // namespace stroma
