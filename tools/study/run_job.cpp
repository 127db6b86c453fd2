// SPDX-License-Identifier: Apache-2.0
#include "tools/study/run_job.h"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iostream>
#include <numeric>

#include "core/parallel.h"
#include "tools/study/content_hash.h"
#include "tools/study/job_scene.h"
#include "tools/study/machine.h"
#include "tools/study/measures.h"
#include "tools/study/picture.h"

namespace stroma::study {
namespace {

using Clock = std::chrono::steady_clock;

// Together the timed runs last at least so long, that short ones are not lost in the clock's noise.
constexpr double leastTimedMs = 200;
constexpr int mostRuns = 100;
constexpr double inTime = 0.8;  // part of the timeout that is planned with

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// Of this thread alone: what the system does beside it does not count.
double threadCpuMs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const double place = std::ceil(fraction * static_cast<double>(values.size())) - 1;
  return values[static_cast<std::size_t>(std::max(place, 0.0))];
}

// A body that went so many times its own size away did not go there by its own forces.
constexpr double blownUp = 10'000;

// The largest displacement, over the size of all bodies at rest; 0 for a single point.
double spread(Scene& scene) {
  double largest = 0;
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const auto& system : scene.systems()) {
    for (std::size_t i = 0; i < system->x().size(); ++i) {
      largest = std::max(largest, (system->x()[i] - system->rest()[i]).norm());
      low = low.cwiseMin(system->rest()[i]);
      high = high.cwiseMax(system->rest()[i]);
    }
  }
  const double size = (high - low).maxCoeff();
  return size > 0 ? largest / size : 0;
}

class Runner {
 public:
  explicit Runner(const Job& job) : job_(job) {}

  Json run() {
    result_ = {{"id", job_.id}, {"label", job_.label}, {"status", "failed"}, {"message", ""}};
    setThreadCount(job_.threads);
    const auto text = readFile(job_.scene);
    if (!text) return fail("cannot read '" + job_.scene + "'");
    const auto begin = Clock::now();
    Scene scene(optionsOf(job_));
    const bool ready = scene.loadText(*text, job_.base) && scene.initialise();
    result_["load_ms"] = millisecondsSince(begin);
    if (!ready) {
      std::cerr << scene.diagnostics().text();
      return fail(firstError(scene.diagnostics(), job_.scene));
    }
    steps_ = stepsOf(scene);
    result_["particles"] = scene.particleCount();
    result_["dt"] = scene.dt();
    result_["steps"] = steps_;
    if (!runOnce(scene)) return endEarly(scene);
    result_["first_run_ms_per_step"] = timeOfRun() / static_cast<double>(steps_);
    if (!(spread(scene) <= blownUp)) {
      result_["status"] = "diverged";
      return fail("at the end a particle was more than 10,000 times the body's size away");
    }
    measure(scene);
    repeat(scene);
    writeTimes(scene);
    result_["status"] = "done";
    return result_;
  }

 private:
  Json fail(const std::string& message) {
    result_["message"] = message;
    return result_;
  }

  [[nodiscard]] std::uint64_t stepsOf(Scene& scene) const {
    if (job_.steps > 0) return job_.steps;
    return stepsIn(job_.time.value_or(scene.root().duration), scene);
  }

  bool runOnce(Scene& scene) {
    perStep_.clear();
    const auto begin = Clock::now();
    while (scene.stepCount() < steps_) {
      const auto stepBegin = Clock::now();
      const double cpu = threadCpuMs();
      if (!scene.step() || scene.diagnostics().errorCount() > 0) return false;
      perStep_.push_back(job_.threads == 1 ? threadCpuMs() - cpu : millisecondsSince(stepBegin));
    }
    wallMs_ = millisecondsSince(begin);
    return true;
  }

  Json endEarly(Scene& scene) {
    if (!scene.divergence()) return fail(firstError(scene.diagnostics(), job_.scene));
    result_["status"] = "diverged";
    result_["diverged_at_step"] = scene.divergence()->step;
    return fail("at step " + std::to_string(scene.divergence()->step) + ": " +
                scene.divergence()->message);
  }

  void measure(Scene& scene) {
    Json measures = Json::object();
    for (const Measure& m : job_.measures) measures[m.name] = evaluate(scene, m);
    result_["measures"] = std::move(measures);
    result_["state_hash"] = hexText(scene.stateHash());
    result_["limiters"] = limitersOf(scene);
    result_["modules"] = scene.modules().loaded();
    result_["picture"] = pictureOf(scene);
  }

  void repeat(Scene& scene) {
    const std::uint64_t hash = scene.stateHash();
    for (int s = 0; s < stageCount; ++s)
      stagesBefore_.push_back(scene.profiler().stage(s).totalMs());
    const auto begin = Clock::now();
    double timed = 0;
    const double left = inTime * 1e3 * job_.timeout - millisecondsSince(start_);
    // nobody asks how long a reference run takes, and a run that may not end in time is not made
    if (job_.repeats == 1 || wallMs_ > left) take();
    while (job_.repeats > 1 && static_cast<int>(means_.size()) < mostRuns) {
      if (wallMs_ > inTime * 1e3 * job_.timeout - millisecondsSince(start_)) break;
      const bool enough =
          static_cast<int>(means_.size()) + 1 >= job_.repeats && timed >= leastTimedMs;
      const bool late = millisecondsSince(begin) > 1e3 * job_.timeBudget;
      if (!means_.empty() && (enough || late)) break;
      scene.reset();
      const bool ended = runOnce(scene);
      agree_ = ended && scene.stateHash() == hash && agree_;
      timed += take();
      if (!ended) break;
    }
  }

  // Of all steps of the run just made (ms).
  [[nodiscard]] double timeOfRun() const {
    return std::accumulate(perStep_.begin(), perStep_.end(), 0.0);
  }

  // Counts the run just made; its time (ms).
  double take() {
    const double sum = timeOfRun();
    const auto steps = static_cast<double>(std::max<std::size_t>(perStep_.size(), 1));
    means_.push_back(sum / steps);
    walls_.push_back(wallMs_ / steps);
    all_.insert(all_.end(), perStep_.begin(), perStep_.end());
    return sum;
  }

  void writeTimes(Scene& scene) {
    const double ms = median(means_);
    const auto [least, largest] = std::ranges::minmax(means_);
    result_["threads"] = job_.threads;
    result_["ms_per_step"] = {
        {"median", ms},          {"min", least},
        {"max", largest},        {"p99", percentile(all_, 0.99)},
        {"runs", means_.size()}, {"clock", job_.threads == 1 ? "cpu" : "wall"}};
    result_["wall_ms_per_step"] = median(walls_);
    // a single step is a solve, which has no pace
    if (steps_ > 1 && ms > 0) result_["real_time_factor"] = 1e3 * scene.dt() / ms;
    const double runs = static_cast<double>(means_.size()) * static_cast<double>(steps_);
    Json stages = Json::object();
    for (int s = 0; s < stageCount; ++s) {
      const double total =
          scene.profiler().stage(s).totalMs() - stagesBefore_[static_cast<std::size_t>(s)];
      if (total > 0) stages[std::string(stageName(static_cast<Stage>(s)))] = total / runs;
    }
    result_["stages"] = std::move(stages);
    result_["repeats_agree"] = agree_;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    result_["peak_memory_mb"] = static_cast<double>(usage.ru_maxrss) / 1024;
    result_["processor"] = processorName();
    result_["side_by_side"] = job_.sideBySide;
  }

  const Job& job_;
  const Clock::time_point start_ = Clock::now();
  Json result_;
  std::uint64_t steps_ = 0;
  std::vector<double> perStep_, all_;  // ms, of the last run and of all timed ones
  std::vector<double> means_, walls_;  // ms a step, of each timed run
  std::vector<double> stagesBefore_;   // ms
  double wallMs_ = 0;
  bool agree_ = true;  // all runs ended with the same bits
};

}  // namespace

Json runJob(const Job& job) { return Runner(job).run(); }

bool pinToCores(const std::vector<int>& cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int core : cores) CPU_SET(static_cast<std::size_t>(core), &set);
  return sched_setaffinity(0, sizeof set, &set) == 0;
}

std::vector<int> allowedCores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return {0};
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  }
  return cores;
}

}  // namespace stroma::study
