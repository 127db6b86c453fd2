// SPDX-License-Identifier: Apache-2.0
#include "tools/stroma/command.h"

#include <fstream>
#include <iostream>

namespace stroma::cli {

CLI::Option* addRepeated(CLI::App& app, const std::string& flag, std::vector<std::string>& values,
                         const std::string& help) {
  return app.add_option(flag, values, help)
      ->type_size(1)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void addFolders(CLI::App& app, std::vector<std::string>& plugins, std::vector<std::string>& data) {
  addRepeated(app, "--plugins", plugins, "Folder with further modules; may be repeated")
      ->option_text("DIR");
  addRepeated(app, "--data", data,
              "Folder to look for scenes, meshes and includes in; may be repeated")
      ->option_text("DIR");
}

void SceneFlags::addTo(CLI::App& app) {
  addRepeated(app, "--set", overrides, "Set an attribute of the scene; may be repeated")
      ->option_text("/path.attribute=value");
  addFolders(app, plugins, data);
  app.add_flag("--lenient", lenient, "Unknown elements and attributes only warn");
}

SceneOptions SceneFlags::options() const {
  SceneOptions options;
  options.overrides = overrides;
  options.pluginFolders.insert(options.pluginFolders.begin(), plugins.begin(), plugins.end());
  options.dataFolders.assign(data.begin(), data.end());
  options.lenient = lenient;
  return options;
}

void loadAllModules(Scene& scene) {
  for (const ModuleManifest& module : scene.modules().modules()) {
    std::string problem;
    if (!scene.modules().load(module, scene.registry(), problem)) {
      std::cerr << "warning: " << problem << "\n";
    }
  }
}

bool writeText(const std::string& file, const std::string& text) {
  if (file.empty()) {
    std::cout << text << std::flush;
    return static_cast<bool>(std::cout);
  }
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) std::cerr << "stroma: cannot write '" << file << "'\n";
  return static_cast<bool>(stream);
}

}  // namespace stroma::cli
