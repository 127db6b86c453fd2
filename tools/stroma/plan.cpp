// SPDX-License-Identifier: Apache-2.0
// `stroma plan SCENE`: what one step of a scene does, in order, and with whose code.
#include <iostream>
#include <memory>

#include "core/interfaces/integrator.h"
#include "tools/stroma/command.h"

namespace stroma::cli {
namespace {

void printSystem(const System& system) {
  const Integrator& solver = system.integrator();
  std::cout << solver.path() << " (" << solver.type() << "): " << system.size() << " particles\n";
  const auto list = [](const char* what, const auto& components, auto remark) {
    for (const auto* component : components) {
      std::cout << "  " << what << "  " << component->path() << " (" << component->type() << ")"
                << remark(*component) << "\n";
    }
  };
  const auto size = [](const MechanicalState& s) { return ": " + std::to_string(s.size()); };
  list("state       ", system.states(), size);
  list("mapped state", system.mappedStates(), size);
  list("force field ", system.forceFields(),
       [](const ForceField& field) { return " on " + field.state().path(); });
}

void printPlan(Scene& scene) {
  std::cout << "One step of " << scene.dt() << " s\n\n" << scene.schedule().text();
  const Rates& rates = scene.rates();
  if (rates.visual > 0) std::cout << "visual rate: " << rates.visual << " a second\n";
  if (rates.haptic > 0) std::cout << "haptic rate: " << rates.haptic << " a second\n";
  std::cout << "\nWhat the solvers govern\n\n";
  for (const auto& system : scene.systems()) printSystem(*system);
  std::cout << "\nModules loaded\n\n";
  for (const std::string& name : scene.modules().loaded()) {
    const ModuleManifest* module = scene.modules().module(name);
    std::cout << name << " " << module->version << "  " << module->library.string() << "\n";
  }
  std::cout << std::flush;
}

}  // namespace

void addPlan(CLI::App& app, int& exitCode) {
  struct Options {
    std::string scene;
    SceneFlags flags;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plan", "Show what one step of a scene does");
  command->add_option("SCENE", options->scene, "Scene file")->required();
  options->flags.addTo(*command);
  command->footer(
      "Shows the calls of a step by stage with their rates, the particles and force fields that\n"
      "each solver governs, and the modules that were loaded.\n"
      "Example:\n  stroma plan scenes/cornea/pull.xml");
  command->callback([options, &exitCode] {
    SceneOptions sceneOptions = options->flags.options();
    sceneOptions.writesOutput = false;
    Scene scene(std::move(sceneOptions));
    const bool valid = scene.load(options->scene) && scene.initialise();
    std::cerr << scene.diagnostics().text();
    if (!valid) {
      exitCode = sceneInvalid;
      return;
    }
    printPlan(scene);
  });
}

}  // namespace stroma::cli
