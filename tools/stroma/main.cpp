// SPDX-License-Identifier: Apache-2.0
// The command line. Each subcommand is one file beside this one.
#include <exception>
#include <iostream>

#include "tools/stroma/command.h"

namespace {

constexpr const char* introduction =
    "Stroma: real-time deformation of soft tissue, point-based.\n"
    "Reads a scene (XML), makes its time steps and writes what the scene asks for.";

constexpr const char* closing =
    "Examples:\n"
    "  stroma run scenes/cornea/pull.xml\n"
    "  stroma run scenes/cornea/pull.xml --time 0.5 --set /cornea/grip.scale=-1 --out out/push\n"
    "  stroma view scenes/cornea/interactive.xml\n"
    "  stroma check scenes/*/*.xml\n"
    "  stroma study scenes/studies/bending.xml\n"
    "  stroma components MLSForceField\n"
    "`stroma COMMAND --help` tells more.\n\n"
    "Exit codes: 0 done, 1 wrong usage, 2 scene invalid, 3 diverged, 4 trouble with output or\n"
    "checkpoint files, 5 a criterion of the scene is missed, 130 interrupted.\n"
    "STROMA_PLUGIN_PATH: folders with further modules, separated by colons.";

}  // namespace

int main(int argc, char** argv) {
  namespace cli = stroma::cli;
  CLI::App app(introduction, "stroma");
  app.footer(closing);
  app.set_version_flag("--version",
                       "stroma " STROMA_VERSION "\n" + std::string(stroma::coreBuildId()));
  app.require_subcommand(1);
  // the library's own text for a wrong command only says that one is wanted
  app.failure_message([argc, argv](const CLI::App* failed, const CLI::Error& problem) {
    std::string text = "stroma: " + std::string(problem.what()) + "\n";
    if (argc > 1 && argv[1][0] != '-' && failed->get_subcommands().empty()) {
      std::vector<std::string> names;
      for (const CLI::App* command : failed->get_subcommands({})) {
        names.push_back(command->get_name());
      }
      const std::string hint = stroma::didYouMean(argv[1], names);
      text = "stroma: there is no command " + stroma::quoted(argv[1]) +
             (hint.empty() ? "" : ": " + hint) + "\n";
    }
    return text + "stroma --help tells more.\n";
  });
  int exitCode = cli::done;
  cli::addRun(app, exitCode);
  cli::addCheck(app, exitCode);
  cli::addPlan(app, exitCode);
  cli::addView(app, exitCode);
  cli::addRender(app, exitCode);
  cli::addStudy(app, exitCode);
  cli::addStability(app, exitCode);
  cli::addComponents(app, exitCode);
  cli::addSchema(app, exitCode);
  cli::addDescribe(app, exitCode);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? cli::done : cli::wrongUsage;
  } catch (const std::exception& problem) {
    std::cerr << "stroma: " << problem.what() << "\n";
    return cli::fileTrouble;
  }
  return exitCode;
}
