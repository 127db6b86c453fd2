// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/interfaces/viewer.h"
#include "core/scene.h"

namespace stroma::cli {

// A viewer in a scene of its own, which outlives the scenes that it shows. Its module is found and
// its attributes are checked as those of any component.
class ViewerHost {
 public:
  // Of the options, those that tell where modules are.
  explicit ViewerHost(const SceneOptions& options);
  ~ViewerHost();

  // Null, with a message on standard error, when there is no such viewer or it cannot start.
  [[nodiscard]] Viewer* open(const std::string& type,
                             const std::map<std::string, std::string>& attributes);

 private:
  Scene scene_;
};

}  // namespace stroma::cli
