// SPDX-License-Identifier: Apache-2.0
// `stroma describe LIBRARY --out FILE`: the manifest of a module; the build calls it.
#include <iostream>
#include <memory>

#include "tools/stroma/command.h"

namespace stroma::cli {

void addDescribe(CLI::App& app, int& exitCode) {
  struct Options {
    std::string library, out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("describe", "Write the manifest of a module");
  command->add_option("LIBRARY", options->library, "The module's shared library")->required();
  command->add_option("--out", options->out, "File to write; standard output without it");
  command->footer("Example:\n  stroma describe build/example.so --out build/example.plugin.json");
  command->callback([options, &exitCode] {
    std::string problem;
    const PluginDescriptor* descriptor = loadPlugin(options->library, problem);
    if (!descriptor) {
      std::cerr << "stroma: " << problem << "\n";
      exitCode = sceneInvalid;
      return;
    }
    if (!writeText(options->out, manifestText(*descriptor, options->library))) {
      exitCode = fileTrouble;
    }
  });
}

}  // namespace stroma::cli
