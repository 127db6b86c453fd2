// SPDX-License-Identifier: Apache-2.0
// `stroma schema`: an XML Schema of scenes, for editors.
#include "core/schema.h"

#include <memory>

#include "tools/stroma/command.h"

namespace stroma::cli {

void addSchema(CLI::App& app, int& exitCode) {
  struct Options {
    std::string out;
    std::vector<std::string> plugins;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("schema", "Write an XML Schema of scenes, for editors");
  command->add_option("--out", options->out, "File to write; standard output without it")
      ->option_text("FILE");
  addRepeated(*command, "--plugins", options->plugins,
              "Folder with further modules; may be repeated")
      ->option_text("DIR");
  command->footer(
      "An editor that knows the schema completes components and attributes and shows their help.\n"
      "Examples:\n"
      "  stroma schema --out stroma.xsd\n"
      "  xmllint --noout --schema stroma.xsd scenes/cornea/pull.xml");
  command->callback([options, &exitCode] {
    SceneFlags flags;
    flags.plugins = options->plugins;
    Scene scene(flags.options());
    loadAllModules(scene);
    if (!writeText(options->out, schemaXsd(scene))) exitCode = fileTrouble;
  });
}

}  // namespace stroma::cli
