// SPDX-License-Identifier: Apache-2.0
#include "tools/study/edit_reader.h"

#include "tools/study/element_reader.h"

namespace stroma::study {

Edit readEdit(const SceneElement& element, const Names& methods, Diagnostics& diagnostics) {
  Edit edit;
  edit.kind = static_cast<Edit::Kind>(std::ranges::find(editTags, element.tag) - editTags.begin());
  const bool sets = edit.kind == Edit::Kind::set;
  ElementReader reader(element, diagnostics);
  const char* name = sets ? "attribute" : edit.kind == Edit::Kind::insert ? "into" : "element";
  edit.target = reader.required(name);
  edit.targetAt = reader.placeOf(name);
  if (!edit.target.empty() && !edit.target.starts_with('/')) {
    reader.error(edit.targetAt, "path", "a path begins with '/', the root of the scene");
  }
  if (sets) {
    const SceneAttribute* value = reader.find("value");
    if (!value) reader.error(element.at, "attr-required", "'value' is required");
    if (value) edit.value = value->value;
    edit.valueAt = reader.placeOf("value");
  }
  edit.methods = reader.names("method");
  for (const std::string& method : edit.methods) {
    if (isAmong(method, methods)) continue;
    reader.error(reader.placeOf("method"), "method-unknown",
                 "there is no method " + stroma::quoted(method), didYouMean(method, methods));
  }
  const bool holds = edit.kind == Edit::Kind::replace || edit.kind == Edit::Kind::insert;
  edit.elements = element.children;
  if (holds && element.children.empty()) {
    reader.error(element.at, "edit-empty", "holds no element to put there");
  }
  if (!holds && !element.children.empty()) {
    reader.error(element.children.front().at, "edit-children", "holds no elements");
  }
  return edit;
}

}  // namespace stroma::study
