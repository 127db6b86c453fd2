// SPDX-License-Identifier: Apache-2.0
#include "tools/view/session.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/path.h"
#include "core/scene_text.h"
#include "tools/study/scene_edit.h"
#include "tools/view/carried_state.h"

namespace stroma::view {
namespace {

using Kind = ViewerRequest::Kind;
using Seconds = std::chrono::duration<double>;

constexpr std::size_t mostKept = 20;
constexpr double keepEvery = 0.1;                           // s, simulated
constexpr auto keepPause = std::chrono::milliseconds(200);  // at least, by the wall clock
constexpr auto idle = std::chrono::milliseconds(4);
// A simulation that is so far behind the clock does not try to catch up.
constexpr double mostLag = 0.1;  // s

void collectFiles(const SceneElement& element, std::vector<std::filesystem::path>& files) {
  const std::filesystem::path file = element.at.source ? element.at.source->name() : "";
  if (!file.empty() && std::ranges::find(files, file) == files.end()) files.push_back(file);
  for (const SceneElement& child : element.children) collectFiles(child, files);
}

std::string firstError(const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::error) return d.message;
  }
  return "";
}

}  // namespace

Session::Session(std::filesystem::path file, SceneOptions options, Viewer& viewer)
    : file_(std::move(file)), options_(std::move(options)), viewer_(viewer) {}

const Diagnostics& Session::diagnostics() const {
  return failed_ ? failed_->diagnostics() : scene_->diagnostics();
}

std::unique_ptr<Scene> Session::read(const SceneChanges& changes) {
  SceneOptions options = options_;
  for (std::string& assignment : changes.overrides()) {
    options.overrides.push_back(std::move(assignment));
  }
  auto scene = std::make_unique<Scene>(std::move(options));
  auto root = readSceneFile(file_, options_.dataFolders, scene->diagnostics());
  std::vector<std::filesystem::path> files{file_};
  if (root) collectFiles(*root, files);
  watch_.watch(std::move(files));
  if (root) changes.apply(*root, *scene, scene->diagnostics());
  const bool good = root && scene->diagnostics().errorCount() == 0 && scene->load(*root, file_) &&
                    scene->initialise();
  failed_.reset();
  if (!good) failed_ = std::move(scene);
  viewer_.report(failed_ ? failed_->diagnostics() : scene->diagnostics());
  return scene;
}

bool Session::open() { return rebuild({}, Keep::nothing).empty(); }

std::string Session::rebuild(SceneChanges changes, Keep keep) {
  std::unique_ptr<Scene> scene = read(changes);
  if (!scene) return firstError(failed_->diagnostics());
  const bool carried = keep == Keep::state && scene_ && carryState(*scene_, *scene);
  changes_ = std::move(changes);
  if (!carried) state_.stopped.clear();
  kept_.clear();
  viewer_.show(*scene, changes_.describe());
  scene_ = std::move(scene);
  restart();
  return "";
}

void Session::restart() {
  anchor_ = measured_ = Clock::now();
  nextKeep_ = anchor_;
  anchorTime_ = measuredTime_ = scene_->time();
  state_.realTimeFactor = 0;
  keepState();
}

void Session::play(bool playing) {
  state_.playing = playing && state_.stopped.empty();
  anchor_ = measured_ = Clock::now();
  anchorTime_ = measuredTime_ = scene_->time();
  if (!state_.playing) state_.realTimeFactor = 0;
}

void Session::run(bool playing, const std::function<bool()>& ends) {
  play(playing);
  while (!ends()) {
    serve();
    if (watch_.changed()) {
      // a file that cannot be taken is reported; the next good one is taken
      static_cast<void>(rebuild(changes_, Keep::state));
    }
    const double wanted = anchorTime_ + Seconds(Clock::now() - anchor_).count() * state_.speed;
    if (stepsToMake_ > 0) {
      --stepsToMake_;
      makeStep();
    } else if (!state_.playing) {
      std::this_thread::sleep_for(idle);
    } else if (scene_->time() + scene_->dt() <= wanted) {
      makeStep();
      if (wanted - scene_->time() > mostLag * state_.speed) {
        anchor_ = Clock::now();
        anchorTime_ = scene_->time();
      }
    } else {
      const Seconds ahead((scene_->time() + scene_->dt() - wanted) / state_.speed);
      std::this_thread::sleep_for(std::min(ahead, Seconds(idle)));
    }
    viewer_.publish(state_);
  }
}

bool Session::advanceTo(double time, const std::function<bool(const Scene&)>& goesOn) {
  while (scene_->time() + 0.5 * scene_->dt() < time) {
    makeStep();
    if (!state_.stopped.empty() || !goesOn(*scene_)) return false;
  }
  return true;
}

void Session::makeStep() {
  const auto begin = Clock::now();
  if (!scene_->step()) {
    state_.stopped = scene_->divergence() ? scene_->divergence()->message : "it has diverged";
    stepsToMake_ = 0;
    play(false);
    return;
  }
  const auto end = Clock::now();
  const double cost = Seconds(end - begin).count();
  state_.stepTime += (cost - state_.stepTime) * 0.05;
  keepState();
  const double passed = Seconds(end - measured_).count();
  if (state_.playing && passed > 0.5) {
    state_.realTimeFactor = (scene_->time() - measuredTime_) / passed;
    measured_ = end;
    measuredTime_ = scene_->time();
  }
}

void Session::keepState() {
  const auto now = Clock::now();
  const bool due =
      kept_.empty() || (now >= nextKeep_ && scene_->time() - kept_.back().time >= keepEvery - 1e-9);
  if (!due) return;
  nextKeep_ = now + keepPause;
  kept_.push_back(scene_->save());
  if (kept_.size() > mostKept) kept_.pop_front();
  showKept();
}

void Session::showKept() {
  state_.kept.clear();
  for (const Snapshot& snapshot : kept_) state_.kept.push_back(snapshot.time);
}

void Session::serve() {
  for (const ViewerRequest& request : viewer_.takeRequests()) handle(request);
}

void Session::handle(const ViewerRequest& request) {
  std::string problem, text;
  switch (request.kind) {
    case Kind::play:
      play(true);
      if (!state_.playing) problem = state_.stopped;
      break;
    case Kind::pause:
      play(false);
      break;
    case Kind::step:
      play(false);
      if (state_.stopped.empty()) stepsToMake_ = static_cast<std::uint64_t>(request.number);
      problem = state_.stopped;
      break;
    case Kind::reset:
      scene_->reset();
      state_.stopped.clear();
      kept_.clear();
      restart();
      break;
    case Kind::rewind:
      problem = rewind(request.number);
      break;
    case Kind::speed:
      state_.speed = request.number;
      play(state_.playing);
      break;
    case Kind::set:
      problem = setValue(request);
      break;
    case Kind::replace:
      problem = change({SceneChange::Kind::replace, request.path, request.text});
      break;
    case Kind::insert:
      problem = change({SceneChange::Kind::insert, request.path, request.text});
      break;
    case Kind::undo:
      problem = undo();
      break;
    case Kind::reload:
      problem = rebuild(changes_, Keep::state);
      break;
    case Kind::revert:
      problem = rebuild({}, Keep::nothing);
      break;
    case Kind::sceneText:
      text = sceneText();
      break;
    case Kind::picture:
      picture_ = {request.text, request.path};
      break;
  }
  viewer_.answer(request.ticket, problem.empty(), problem.empty() ? text : problem);
}

std::string Session::change(SceneChange change) {
  SceneChanges changes = changes_;
  changes.add(std::move(change));
  return rebuild(std::move(changes), Keep::state);
}

std::string Session::undo() {
  SceneChanges changes = changes_;
  return changes.undo() ? rebuild(std::move(changes), Keep::state) : "there is nothing to undo";
}

std::string Session::setValue(const ViewerRequest& request) {
  std::string problem, hint;
  const AttributeBase* attribute =
      findAttribute(scene_->root(), request.path, problem, hint).attribute;
  if (attribute && !attribute->info().runtime) {
    return change({SceneChange::Kind::set, request.path, request.text});
  }
  if (auto refused = scene_->setAttribute(request.path, request.text)) return *refused;
  changes_.add({SceneChange::Kind::set, request.path, request.text});
  if (failed_) {  // what was refused before is not asked for any more
    failed_.reset();
    viewer_.report(scene_->diagnostics());
  }
  return "";
}

std::string Session::rewind(double time) {
  if (kept_.empty()) return "no state is kept";
  const auto distance = [&](const Snapshot& s) { return std::abs(s.time - time); };
  const auto nearest = std::ranges::min_element(kept_, {}, distance);
  if (!scene_->restore(*nearest)) return "the kept state does not fit";
  kept_.erase(nearest + 1, kept_.end());
  showKept();
  state_.stopped.clear();
  play(state_.playing);
  return "";
}

std::string Session::sceneText() {
  Scene& scene = *scene_;
  Diagnostics problems;
  auto root = readSceneFile(file_, options_.dataFolders, problems);
  if (!root) return "";
  changes_.apply(*root, scene, problems);
  std::vector<std::string> assignments = options_.overrides;
  for (std::string& own : changes_.overrides()) assignments.push_back(std::move(own));
  SceneChanges::write(*root, assignments);
  return study::sceneText(*root);
}

}  // namespace stroma::view
