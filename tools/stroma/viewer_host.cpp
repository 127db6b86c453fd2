// SPDX-License-Identifier: Apache-2.0
#include "tools/stroma/viewer_host.h"

#include <iostream>

#include "core/traverse.h"
#include "core/xml_text.h"

namespace stroma::cli {
namespace {

SceneOptions hostOptions(const SceneOptions& options) {
  SceneOptions own;
  own.pluginFolders = options.pluginFolders;
  return own;
}

}  // namespace

ViewerHost::ViewerHost(const SceneOptions& options) : scene_(hostOptions(options)) {}
ViewerHost::~ViewerHost() { scene_.stop(); }

Viewer* ViewerHost::open(const std::string& type,
                         const std::map<std::string, std::string>& attributes) {
  std::string text = "<Node name=\"viewer\"><" + type;
  for (const auto& [name, value] : attributes) text += " " + name + "=\"" + xmlText(value) + "\"";
  text += "/></Node>";
  const bool good = scene_.loadText(std::move(text), "(viewer)") && scene_.initialise();
  const auto viewers = collect<Viewer>(scene_.root());
  if (good && !viewers.empty()) return viewers.front();
  if (good) scene_.diagnostics().error("viewer-type", stroma::quoted(type) + " is no viewer");
  std::cerr << scene_.diagnostics().text();
  return nullptr;
}

}  // namespace stroma::cli
