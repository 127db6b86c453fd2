// SPDX-License-Identifier: Apache-2.0
// Does to a scene what its diagnostics ask for, as a patient user would: gives attributes that are
// missing, writes links that are not clear, takes out what has no meaning. Without it few scenes
// out of random parts would come to their first step.
#pragma once

#include <functional>

#include "tests/fuzz/random_scenes/catalogue.h"
#include "tests/fuzz/random_scenes/element.h"
#include "tests/fuzz/random_scenes/random_value.h"

namespace stroma::fuzz {

struct TrialFolders {
  std::filesystem::path modules, meshes;
};

[[nodiscard]] SceneOptions optionsOf(const TrialFolders& folders);

class Mending {
 public:
  using LookAt = std::function<void(const std::string& text)>;

  // `before` is told every text that is about to be loaded.
  Mending(const Catalogue& catalogue, const TrialFolders& folders, Dice& dice,
          const Proportions& body, LookAt before)
      : catalogue_(catalogue),
        folders_(folders),
        dice_(dice),
        body_(body),
        before_(std::move(before)) {}

  // Until the scene loads, or so many times, or where nothing helps.
  void mend(Element& root, int rounds);

 private:
  struct Place {  // what a diagnostic points at
    std::string element, attribute;
  };
  [[nodiscard]] static Place placeOf(const Diagnostic& diagnostic);
  bool follow(Element& root, const Diagnostic& diagnostic);
  bool give(Element& element, const Kind& kind, const std::vector<std::string>& names);
  bool link(Element& root, Element& element, const Kind& kind,
            const std::vector<std::string>& names);

  const Catalogue& catalogue_;
  const TrialFolders& folders_;
  Dice& dice_;
  Proportions body_;
  LookAt before_;
};

}  // namespace stroma::fuzz
