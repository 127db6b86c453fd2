// SPDX-License-Identifier: Apache-2.0
// What the subcommands of `stroma` share: exit codes and the options that say where things are
// found.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.h"

namespace stroma::cli {

enum ExitCode : int {
  done = 0,
  wrongUsage = 1,
  sceneInvalid = 2,  // a missing mesh included
  diverged = 3,
  fileTrouble = 4,  // output or checkpoint files
  checkFailed = 5,  // the run misses a criterion of the scene
};

// --set, --plugins, --data and --lenient.
struct SceneFlags {
  std::vector<std::string> overrides, plugins, data;
  bool lenient = false;

  void addTo(CLI::App& app);
  // The folders of --plugins and --data are searched first, in the order given.
  [[nodiscard]] SceneOptions options() const;
};

// An option that may be given several times, one value each time.
CLI::Option* addRepeated(CLI::App& app, const std::string& flag, std::vector<std::string>& values,
                         const std::string& help);

// --plugins and --data.
void addFolders(CLI::App& app, std::vector<std::string>& plugins, std::vector<std::string>& data);

// Loads every module on the search path into the scene's registry; those that cannot be loaded are
// reported on standard error.
void loadAllModules(Scene& scene);

// Writes text to a file, or to standard output when the name is empty. False with a message on
// failure.
[[nodiscard]] bool writeText(const std::string& file, const std::string& text);

// Each adds its subcommand; when that is chosen, `exitCode` is set.
void addRun(CLI::App& app, int& exitCode);
void addCheck(CLI::App& app, int& exitCode);
void addPlan(CLI::App& app, int& exitCode);
void addComponents(CLI::App& app, int& exitCode);
void addSchema(CLI::App& app, int& exitCode);
void addStudy(CLI::App& app, int& exitCode);
void addStability(CLI::App& app, int& exitCode);
void addView(CLI::App& app, int& exitCode);
void addRender(CLI::App& app, int& exitCode);
void addDescribe(CLI::App& app, int& exitCode);

}  // namespace stroma::cli
