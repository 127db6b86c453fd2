// SPDX-License-Identifier: Apache-2.0
// What a person changes of a scene while it runs, kept apart from its file: the file is read again
// and the changes are made again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene.h"
#include "core/scene_text.h"

namespace stroma::view {

struct SceneChange {
  enum class Kind { set, replace, insert };
  Kind kind = Kind::set;
  std::string path;  // of an attribute, a component or a node
  std::string text;  // value, type or element, elements
  // "/cornea/elasticity.youngModulus = 3 kPa"
  [[nodiscard]] std::string describe() const;
};

class SceneChanges {
 public:
  void add(SceneChange change);
  // False when there is nothing to undo.
  bool undo();
  void clear() { changes_.clear(); }
  [[nodiscard]] bool empty() const { return changes_.empty(); }
  [[nodiscard]] std::vector<std::string> describe() const;

  // Makes those that replace and insert; problems are reported. `scene` knows the components that
  // exist.
  void apply(SceneElement& root, Scene& scene, Diagnostics& diagnostics) const;
  // Those that set, as SceneOptions::overrides has them.
  [[nodiscard]] std::vector<std::string> overrides() const;
  // Writes values that were set into the elements themselves.
  static void write(SceneElement& root, const std::vector<std::string>& overrides);

 private:
  std::vector<SceneChange> changes_;
};

}  // namespace stroma::view
