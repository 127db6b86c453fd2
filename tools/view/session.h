// SPDX-License-Identifier: Apache-2.0
// A scene that a person watches and works on: it is played at the pace of the wall clock, changed,
// gone back in, and read again when its file changes. What cannot be loaded leaves the last good
// scene running.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "core/interfaces/viewer.h"
#include "core/scene.h"
#include "tools/view/file_watch.h"
#include "tools/view/scene_changes.h"

namespace stroma::view {

class Session {
 public:
  // `options` are those of every scene that is loaded.
  Session(std::filesystem::path file, SceneOptions options, Viewer& viewer);

  // Loads the file for the first time; false when there were errors (diagnostics()).
  [[nodiscard]] bool open();
  // Plays and serves requests until `ends` says so.
  void run(bool playing, const std::function<bool()>& ends);
  // Makes steps as fast as they go to this time (s), as long as `goesOn`, which is asked after
  // each; false when the time could not be reached.
  [[nodiscard]] bool advanceTo(
      double time,
      const std::function<bool(const Scene&)>& goesOn = [](const Scene&) { return true; });
  // Serves what was asked for; picture() is the last picture that came, or why there is none.
  void serve();
  struct Picture {
    std::string png, problem;
  };
  [[nodiscard]] const Picture& picture() const { return picture_; }
  // Those of the last scene that was read, taken or not.
  [[nodiscard]] const Diagnostics& diagnostics() const;
  [[nodiscard]] Scene& scene() { return *scene_; }
  [[nodiscard]] const SessionState& state() const { return state_; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Keep { state, nothing };

  // Reads the file with the changes; the problems go to the viewer. Null with errors.
  [[nodiscard]] std::unique_ptr<Scene> read(const SceneChanges& changes);
  // Shows a scene made with the changes instead of the present one, from its state where it fits.
  // What went wrong, or "".
  [[nodiscard]] std::string rebuild(SceneChanges changes, Keep keep);
  void handle(const ViewerRequest& request);
  [[nodiscard]] std::string change(SceneChange change);
  [[nodiscard]] std::string setValue(const ViewerRequest& request);
  [[nodiscard]] std::string undo();
  [[nodiscard]] std::string rewind(double time);
  [[nodiscard]] std::string sceneText();
  void restart();
  void play(bool playing);
  void makeStep();
  void keepState();
  void showKept();

  std::filesystem::path file_;
  SceneOptions options_;
  Viewer& viewer_;
  std::unique_ptr<Scene> scene_, failed_;
  SceneChanges changes_;
  FileWatch watch_;
  SessionState state_;
  std::deque<Snapshot> kept_;
  Picture picture_;
  std::uint64_t stepsToMake_ = 0;  // of a request, while paused
  Clock::time_point anchor_{}, nextKeep_{}, measured_{};
  double anchorTime_ = 0, measuredTime_ = 0;  // s, simulated
};

}  // namespace stroma::view
