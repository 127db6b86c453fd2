// SPDX-License-Identifier: Apache-2.0
// `stroma run SCENE`: makes the steps of a scene and reports what they did.
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <iostream>
#include <memory>

#include "core/interfaces/observer.h"
#include "core/parallel.h"
#include "core/rate_keeper.h"
#include "core/traverse.h"
#include "tools/stroma/command.h"
#include "tools/stroma/interrupt.h"
#include "tools/stroma/progress_bar.h"
#include "tools/stroma/run_report.h"

namespace stroma::cli {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string scene, out, resume;
  SceneFlags flags;
  std::uint64_t steps = 0;
  std::string time, checkpointEvery;  // durations; bare numbers are seconds
  bool stepsGiven = false, profile = false, json = false, realTime = false;
  int threads = 1;
};

double milliseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

double cpuMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// Why nothing can be written into the folder, which is made if need be; empty when it can.
std::string folderProblem(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (!fs::is_directory(folder)) {
    return "cannot make the folder '" + folder.string() + "': " + failure.message();
  }
  const bool writable = access(folder.c_str(), W_OK | X_OK) == 0;
  return writable ? "" : "cannot write into '" + folder.string() + "'";
}

bool isFinite(const Scene& scene) {
  for (const auto& system : scene.systems()) {
    for (const Vec3Span values : {system->x(), system->v()}) {
      for (const Vec3& value : values) {
        if (!value.allFinite()) return false;
      }
    }
  }
  return true;
}

class Run {
 public:
  explicit Run(const Options& options) : options_(options) {
    const fs::path stem = fs::path(options.scene).stem();
    out_ = options.out.empty() ? fs::path("out") / stem : fs::path(options.out);
    checkpoint_ = out_ / (stem.string() + ".checkpoint");
  }

  int execute() {
    if (!readDurations()) return wrongUsage;
    if (!filesArePossible()) return fileTrouble;
    setThreadCount(options_.threads);
    const auto begin = Clock::now();
    SceneOptions sceneOptions = options_.flags.options();
    sceneOptions.outputFolder = out_;
    sceneOptions.realTime = options_.realTime;
    Scene scene(std::move(sceneOptions));
    const bool loaded = scene.load(options_.scene) && scene.initialise();
    report_.loadMs = milliseconds(Clock::now() - begin);
    std::cerr << scene.diagnostics().text();
    if (!loaded) {
      if (options_.json) std::cout << scene.diagnostics().json() << "\n";
      return outputFailed(scene) ? fileTrouble : sceneInvalid;
    }
    if (!options_.resume.empty() && !resume(scene)) return fileTrouble;
    scene.profiler().setEnabled(options_.profile);
    listenForInterrupts();
    advance(scene);
    return finish(scene);
  }

 private:
  bool readDurations() {
    const auto read = [](const std::string& text, const char* flag, double& value) {
      if (text.empty()) return true;
      const auto problem = ValueTraits<double>::parse(text, {"s", UnitSystem{}}, value);
      if (!problem && std::isfinite(value) && value > 0) return true;
      std::cerr << "stroma: " << flag << ": "
                << (problem ? problem->message : "must be greater than 0") << "\n";
      return false;
    };
    return read(options_.time, "--time", time_) &&
           read(options_.checkpointEvery, "--checkpoint-every", checkpointEvery_);
  }

  // Trouble with files is found before hours of computing, where it can be. The standard folder is
  // made only when something is written.
  bool filesArePossible() {
    std::error_code failure;
    if (!options_.resume.empty() && !fs::is_regular_file(options_.resume, failure)) {
      return complain("there is no checkpoint '" + options_.resume + "'");
    }
    if (options_.out.empty() && options_.checkpointEvery.empty()) return true;
    const std::string problem = folderProblem(out_);
    return problem.empty() || complain("--out: " + problem);
  }

  bool complain(const std::string& problem) {
    std::cerr << "stroma: " << problem << "\n";
    fileTrouble_ = true;
    return false;
  }

  // Exporters report with this id that they cannot write.
  static bool outputFailed(Scene& scene) {
    for (const Diagnostic& d : scene.diagnostics().all()) {
      if (d.severity == Severity::error && d.id == "output") return true;
    }
    return false;
  }

  bool resume(Scene& scene) {
    Snapshot snapshot;
    const std::string problem = readCheckpoint(options_.resume, snapshot, scene.contentHash());
    if (!problem.empty()) return complain(problem);
    return scene.restore(snapshot) || complain("'" + options_.resume + "' does not fit this scene");
  }

  [[nodiscard]] std::uint64_t lastStep(const Scene& scene, double duration) const {
    if (options_.stepsGiven) return options_.steps;
    const double wanted = time_ > 0 ? time_ : duration;
    return static_cast<std::uint64_t>(std::ceil(wanted / scene.dt() - 1e-9));
  }

  void writeState(const Scene& scene, const fs::path& file) {
    std::error_code failure;
    fs::create_directories(file.parent_path(), failure);
    const std::string problem = writeCheckpoint(file.string(), scene.save(), scene.contentHash());
    if (!problem.empty()) {
      complain(problem);
    } else if (report_.files.empty() || report_.files.back() != file.string()) {
      report_.files.push_back(file.string());
    }
  }

  void advance(Scene& scene) {
    const std::uint64_t first = scene.stepCount();
    const std::uint64_t last = lastStep(scene, scene.root().duration);
    const auto every =
        checkpointEvery_ > 0
            ? static_cast<std::uint64_t>(std::max(1.0, std::round(checkpointEvery_ / scene.dt())))
            : 0;
    // in real time a step begins when the wall clock is there; one that is late does not hurry the
    // next
    RateKeeper pace(1 / scene.dt(), scene.dt());
    pace.start();
    ProgressBar bar(first, last, scene.root().time + static_cast<double>(last) * scene.dt());
    const double cpu = cpuMilliseconds();
    const auto begin = Clock::now();
    const Diagnostics& diagnostics = scene.diagnostics();
    // an error while running: an exporter cannot write any more
    while (scene.stepCount() < last && interruptSignal() == 0 && diagnostics.errorCount() == 0) {
      if (options_.realTime) pace.wait();
      if (!scene.step()) break;
      const std::uint64_t step = scene.stepCount();
      bar.show(step, scene.time());
      if (every > 0 && step % every == 0) {
        writeState(scene, checkpoint_);
        if (fileTrouble_) break;
      }
    }
    report_.wallMs = milliseconds(Clock::now() - begin);
    report_.cpuMs = cpuMilliseconds() - cpu;
    report_.steps = scene.stepCount() - first;
    bar.clear();
  }

  int finish(Scene& scene) {
    report_.scene = options_.scene;
    report_.interrupted = interruptSignal() != 0;
    scene.stop();
    if (scene.divergence()) {
      std::cerr << "stroma: diverged: " << scene.divergence()->message << "\n";
      if (isFinite(scene)) writeState(scene, out_ / "last_good.checkpoint");
    }
    if (scene.diagnostics().errorCount() > 0) std::cerr << scene.diagnostics().text();
    report_.collectFrom(scene);
    for (const auto& [path, check] : report_.checks) {
      if (check.passed) continue;
      std::cerr << format({Severity::error,
                           "check-failed",
                           path + ": " + check.criterion + " is " + check.message,
                           check.where,
                           {}});
    }
    (options_.json ? std::cerr : std::cout) << (options_.profile ? scene.profiler().text() : "");
    std::cout << (options_.json ? report_.json() : report_.text()) << std::flush;
    if (scene.divergence()) return diverged;
    if (fileTrouble_ || outputFailed(scene)) return fileTrouble;
    if (scene.diagnostics().errorCount() > 0) return sceneInvalid;
    if (report_.interrupted) return 128 + interruptSignal();
    return report_.passed() ? done : checkFailed;
  }

  const Options& options_;
  fs::path out_, checkpoint_;
  double time_ = 0, checkpointEvery_ = 0;  // s, 0 = not given
  bool fileTrouble_ = false;
  RunReport report_;
};

}  // namespace

void addRun(CLI::App& app, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("run", "Run a scene");
  command->add_option("SCENE", options->scene, "Scene file")->required();
  auto* steps = command->add_option("--steps", options->steps,
                                    "Steps to make, counted from the start of the scene");
  auto* time = command->add_option("--time", options->time,
                                   "Simulated time to reach, such as 0.5 or \"20 ms\"; without it "
                                   "and --steps the scene's duration");
  steps->option_text("N")->excludes(time);
  time->option_text("T");
  options->flags.addTo(*command);
  command->add_option("--out", options->out, "Folder for results; out/<scene> without it")
      ->option_text("DIR");
  command
      ->add_option("--threads", options->threads,
                   "Threads; the results have the same bits with any number. Default 1: the "
                   "fastest for small scenes")
      ->option_text("N")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--profile", options->profile, "Time every call and print the table");
  command->add_flag("--real-time", options->realTime,
                    "Keep pace with the wall clock: haptic devices are served by threads of their "
                    "own; results then depend on timing");
  command->add_flag("--json", options->json, "Print one JSON object on standard output");
  command->add_option("--resume", options->resume, "Continue from a checkpoint of this scene")
      ->option_text("FILE");
  command
      ->add_option("--checkpoint-every", options->checkpointEvery,
                   "Write OUT/<scene>.checkpoint so often (simulated time)")
      ->option_text("T");
  command->footer(
      "--steps and --time count from the start of the scene, also after --resume.\n"
      "An interrupt (Ctrl-C) finishes the step, closes the files and prints the summary.\n"
      "A scene may hold criteria (StabilityCheck): a run that misses one ends with exit code 5.\n"
      "A run that diverges leaves its last good positions and velocities in "
      "OUT/last_good.checkpoint,\n"
      "to look at: resuming it unchanged diverges again.\n"
      "Examples:\n"
      "  stroma run scenes/cornea/pull.xml\n"
      "  stroma run scenes/cornea/pull.xml --time \"200 ms\" --set \"/cornea/grip.scale=-1\"\n"
      "  stroma run scenes/beam/fixbeam_E6000.xml --checkpoint-every 0.5 --out out/beam\n"
      "  stroma run scenes/beam/fixbeam_E6000.xml --out out/beam \\\n"
      "         --resume out/beam/fixbeam_E6000.checkpoint --json");
  command->callback([options, steps, &exitCode] {
    options->stepsGiven = steps->count() > 0;
    exitCode = Run(*options).execute();
  });
}

}  // namespace stroma::cli
