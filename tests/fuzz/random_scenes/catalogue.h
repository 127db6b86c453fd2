// SPDX-License-Identifier: Apache-2.0
// The components that there are, each with one to ask: what attributes and links it has, and what
// roles it can play. Nothing here knows a component by name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene.h"

namespace stroma::fuzz {

struct Kind {
  std::string name;
  std::string module;
  std::unique_ptr<Component> prototype;
};

class Catalogue {
 public:
  // Loads every module of the folder, which stay loaded for the scenes to come.
  explicit Catalogue(const std::filesystem::path& modules);

  [[nodiscard]] const std::vector<Kind>& kinds() const { return kinds_; }
  // Null when there is none.
  [[nodiscard]] const Kind* find(std::string_view name) const;
  template <class Role>
  [[nodiscard]] std::vector<const Kind*> playing() const {
    std::vector<const Kind*> found;
    for (const Kind& kind : kinds_) {
      if (dynamic_cast<const Role*>(kind.prototype.get())) found.push_back(&kind);
    }
    return found;
  }
  // Deform a body: force fields that work on a mesh of their own node, and for integrators that
  // bring constraints of their own, these.
  [[nodiscard]] std::vector<const Kind*> elasticities(const Kind& integrator) const;
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  Scene scene_;
  std::vector<Kind> kinds_;
  std::vector<std::string> problems_;
};

}  // namespace stroma::fuzz
