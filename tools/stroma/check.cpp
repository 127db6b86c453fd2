// SPDX-License-Identifier: Apache-2.0
// `stroma check SCENE...`: loads and initialises scenes without running them or writing anything.
// Of studies, all scenes are read.
#include <iostream>
#include <memory>

#include "core/json.h"
#include "core/scene_text.h"
#include "tools/stroma/command.h"
#include "tools/study/plan.h"

namespace stroma::cli {
namespace {

struct Options {
  std::vector<std::string> scenes;
  SceneFlags flags;
  bool json = false;
};

bool isStudy(const std::string& file) {
  Diagnostics ignored;
  const auto text = study::readFile(file);
  if (!text) return false;
  const auto root = parseSceneText(std::make_shared<SourceText>(file, *text), ignored);
  return root && root->tag == "Study";
}

bool checkStudy(const std::string& file, const Options& options, JsonWriter& json) {
  Diagnostics diagnostics;
  const study::Study study = study::readStudy(file, diagnostics);
  std::size_t runs = 0;
  if (diagnostics.errorCount() == 0) {
    runs = study::makePlan(study, {"out", "out", options.flags.plugins, options.flags.data},
                           diagnostics)
               .size();
  }
  const bool valid = diagnostics.errorCount() == 0;
  if (options.json) {
    json.beginObject().member("study", file).member("valid", valid).member("runs", runs);
    json.key("report").raw(diagnostics.json());
    json.endObject();
  } else {
    std::cerr << diagnostics.text();
    std::cout << file << ": " << (valid ? "valid" : "INVALID");
    if (valid) std::cout << ", a study of " << runs << " runs";
    std::cout << std::endl;
  }
  return valid;
}

bool checkOne(const std::string& file, const Options& options, JsonWriter& json) {
  if (isStudy(file)) return checkStudy(file, options, json);
  SceneOptions sceneOptions = options.flags.options();
  sceneOptions.writesOutput = false;
  Scene scene(std::move(sceneOptions));
  const bool valid = scene.load(file) && scene.initialise();
  if (options.json) {
    json.beginObject().member("scene", file).member("valid", valid);
    json.member("particles", scene.particleCount());
    json.key("report").raw(scene.diagnostics().json());
    json.endObject();
  } else {
    std::cerr << scene.diagnostics().text();
    std::cout << file << ": " << (valid ? "valid" : "INVALID");
    if (valid) std::cout << ", " << scene.particleCount() << " particles";
    std::cout << std::endl;
  }
  return valid;
}

}  // namespace

void addCheck(CLI::App& app, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("check", "Load scenes and studies and report what is wrong");
  command->add_option("SCENE", options->scenes, "Scene or study files")->required();
  command->add_flag("--json", options->json, "Print one JSON array on standard output");
  options->flags.addTo(*command);
  command->footer(
      "Nothing is run and nothing is written. Exit code 2 when a scene is invalid.\n"
      "Examples:\n"
      "  stroma check scenes/cornea/pull.xml\n"
      "  stroma check scenes/*/*.xml --json");
  command->callback([options, &exitCode] {
    JsonWriter json;
    json.beginArray();
    for (const std::string& file : options->scenes) {
      if (!checkOne(file, *options, json)) exitCode = sceneInvalid;
    }
    json.endArray();
    if (options->json) std::cout << json.text() << "\n";
  });
}

}  // namespace stroma::cli
