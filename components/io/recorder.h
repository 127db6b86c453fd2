// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/interfaces/mesh.h"
#include "core/interfaces/observer.h"
#include "core/schedule.h"
#include "core/topology_change.h"

namespace stroma {

// What writes files while a scene runs: when it does, where, and what happens when it cannot.
// Files lie below the scene's output folder; nothing is written where the scene writes no output.
// The first failure is reported and ends this component's writing: the run itself goes on, and its
// summary tells.
class Recorder : public Observer {
  // first, since the attributes below are initialised with them
  int defaultEvery_;
  bool defaultBegin_;

 public:
  Attribute<FilePath> filename{
      this, "filename", {}, "File below the output folder; the component's name if not given."};
  Attribute<int> everySteps{this,
                            "exportEveryNumberOfSteps",
                            defaultEvery_,
                            "Writes after every so many steps, 0 = not while running.",
                            {.min = 0, .aliases = "every"}};
  Attribute<double> period{this,
                           "period",
                           0.0,
                           "Writes whenever so much time has passed, instead of counting steps.",
                           {.unit = "s", .min = 0}};
  Attribute<bool> atBegin{this, "exportAtBegin", defaultBegin_, "Writes before the first step."};
  Attribute<bool> atEnd{this, "exportAtEnd", false, "Writes when the run ends."};

  void configure() override;
  void schedule(Schedule& schedule) override;
  void reset() override;
  void stop() override;
  [[nodiscard]] std::vector<std::filesystem::path> files() const override { return files_; }
  [[nodiscard]] std::string trouble() const override { return trouble_; }

 protected:
  // With the defaults of its rhythm.
  explicit Recorder(int everyStepsDefault = 0, bool atBeginDefault = false)
      : defaultEvery_(everyStepsDefault), defaultBegin_(atBeginDefault) {}

  // Writes what is to be seen now. `time` in s, `step` counted from the start of the scene.
  virtual void record(double time, std::uint64_t step) = 0;

  // The output file without or with another extension (".vtp"), below the output folder.
  [[nodiscard]] std::filesystem::path outputFile(const std::string& extension) const;
  [[nodiscard]] bool writes() const;
  // Replaces a file at once: readers see the old contents or the new, also after a crash.
  void replaceFile(const std::filesystem::path& file, std::string_view bytes);
  void fail(std::string reason);
  // A body has been cut: the elements of its surface (none: null) can be written with the surface's
  // own nodes only. Otherwise the recording fails, or warns that what it shows is not cut.
  void checkFollows(const TopologyChange& change, const MechanicalState& nodes,
                    const Mesh* elements);
  void addFile(const std::filesystem::path& file);
  // The step that was recorded last.
  [[nodiscard]] std::optional<std::uint64_t> lastStep() const { return lastStep_; }
  void setLastStep(std::optional<std::uint64_t> step) { lastStep_ = step; }

 private:
  void begin(const StepContext& step);
  void publish(const StepContext& step);
  void recordOnce(double time, std::uint64_t step);

  std::vector<std::filesystem::path> files_;
  std::string trouble_;
  bool warnedOfCut_ = false;
  std::optional<std::uint64_t> lastStep_;
};

}  // namespace stroma
