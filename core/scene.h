// SPDX-License-Identifier: Apache-2.0
// A scene: the tree, its diagnostics, the compiled schedule, the clock and the snapshots. It is the
// one object that an application holds; several may live in a process.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/finite_guard.h"
#include "core/interfaces/animation_loop.h"
#include "core/node.h"
#include "core/plugin.h"
#include "core/profiler.h"
#include "core/registry.h"
#include "core/schedule.h"
#include "core/snapshot.h"
#include "core/system.h"
#include "core/topology_change.h"

namespace stroma {

struct SceneElement;

struct SceneOptions {
  std::vector<std::filesystem::path> pluginFolders = ModuleIndex::defaultFolders();
  std::vector<std::filesystem::path>
      dataFolders;                           // where meshes and included scenes are looked for
  std::vector<std::string> overrides;        // "/path.attribute=value", as --set gives them
  std::filesystem::path outputFolder = ".";  // where exporters write
  bool writesOutput = true;                  // false: exporters stay silent (checks, benchmarks)
  bool lenient = false;                      // unknown elements and attributes only warn
  // Steps are made as the wall clock goes: whoever serves devices does so in threads of its own.
  // False: everything happens in the steps, deterministically.
  bool realTime = false;
};

class Scene {
 public:
  explicit Scene(SceneOptions options = {});
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  // Reads a scene; false when there were errors (see diagnostics()).
  [[nodiscard]] bool load(const std::filesystem::path& file);
  // The same from elements that have been read, and perhaps edited: readSceneFile(file, ...).
  [[nodiscard]] bool load(const SceneElement& root, const std::filesystem::path& file);
  // The same from text; `file` names it and is the place that meshes are relative to.
  [[nodiscard]] bool loadText(std::string text, const std::filesystem::path& file);
  // Configures and binds the components in order of their links, compiles the schedule, starts.
  // False when there were errors.
  [[nodiscard]] bool initialise();

  // Makes one step. False when the state is no longer finite: divergence() then tells, and the last
  // good state is back in place where one was kept.
  [[nodiscard]] bool step();
  [[nodiscard]] const std::optional<Divergence>& divergence() const { return divergence_; }
  // Ends the run: components close their files. Called by the destructor if need be.
  void stop();
  // Back to the start of the scene.
  void reset();

  // A topology modifier has divided a body: its surface's state grows, and every component follows
  // (Component::topologyChanged).
  void changeTopology(const TopologyChange& change);
  // What components find wrong with a body that has been cut. Slow.
  void checkTopology(TopologyCheck& check) const;

  [[nodiscard]] Snapshot save() const;
  // False when the snapshot does not fit this scene; the state is then unchanged.
  [[nodiscard]] bool restore(const Snapshot& snapshot);
  // Identifies what was loaded: scene text, includes, overrides and, once initialised, input files.
  [[nodiscard]] std::uint64_t contentHash() const { return contentHash_; }
  // FNV-1a over the bits of all positions and velocities.
  [[nodiscard]] std::uint64_t stateHash() const;

  // Sets a run-time attribute; the reason when that is not possible. Takes effect at once: call it
  // between steps.
  [[nodiscard]] std::optional<std::string> setAttribute(const std::string& path,
                                                        const std::string& value);

  [[nodiscard]] Node& root() { return *root_; }
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
  [[nodiscard]] Registry& registry() { return registry_; }
  [[nodiscard]] ModuleIndex& modules() { return modules_; }
  [[nodiscard]] const Schedule& schedule() const { return schedule_; }
  [[nodiscard]] Profiler& profiler() { return profiler_; }
  [[nodiscard]] const SceneOptions& options() const { return options_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::vector<std::unique_ptr<System>>& systems() const { return systems_; }
  // The system that holds the state, with its integrator; null for states nothing governs.
  [[nodiscard]] System* systemOf(const MechanicalState& state) const;
  [[nodiscard]] const Rates& rates() const { return rates_; }

  [[nodiscard]] double dt() const { return root_->dt; }
  [[nodiscard]] double time() const { return timeAt(step_); }
  [[nodiscard]] std::uint64_t stepCount() const { return step_; }
  [[nodiscard]] Index particleCount() const;

  // Finds an input file (a mesh, a table): beside the scene, then in the data folders. Reports at
  // the attribute when there is none.
  [[nodiscard]] std::optional<std::filesystem::path> findInput(
      Component& component, const Attribute<FilePath>& attribute);

 private:
  friend class SceneReader;
  [[nodiscard]] double timeAt(std::uint64_t step) const;
  [[nodiscard]] bool readInto(const std::optional<SceneElement>& element);
  // Components such that everything a component links to comes before it; cycles are reported.
  [[nodiscard]] std::vector<Component*> dependencyOrder();
  void compile();
  void restoreTopology();

  SceneOptions options_;
  std::filesystem::path file_;
  Registry registry_;
  ModuleIndex modules_;
  Diagnostics diagnostics_;
  std::unique_ptr<Node> root_;
  std::vector<Component*> followers_;  // in the order in which they follow a cut
  std::vector<std::unique_ptr<System>> systems_;
  std::vector<FiniteGuard> guards_;
  Schedule schedule_;
  Profiler profiler_;
  Rates rates_;
  std::uint64_t step_ = 0;
  std::uint64_t contentHash_ = 0;
  std::optional<Divergence> divergence_;
  bool running_ = false;
  bool topologyChanged_ = false;  // since the start
};

}  // namespace stroma
