// SPDX-License-Identifier: Apache-2.0
// random-scenes: makes random scenes and runs each in a process of its own.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>

#include "tests/fuzz/random_scenes/summary.h"

namespace stroma::fuzz {
namespace {
namespace fs = std::filesystem;

constexpr const char* introduction =
    "Makes random scenes from what the components say of themselves and runs each in a process of\n"
    "its own. Each must end in one of three ways: a diagnostic before the first step, finite to "
    "the\n"
    "end, or a stop by the guard with its explanation. Anything else is a failure: its seed and "
    "the\n"
    "command that repeats it are printed, and the scene is kept.";

constexpr const char* closing =
    "With --one the scene is run in this process (for a debugger): it ends with 2 when it was\n"
    "diagnosed, 0 when it stayed finite, 3 when the guard stopped it, 1 when something is wrong.\n"
    "Otherwise the exit code is 1 when any scene failed, else 0.\n"
    "Examples:\n"
    "  random-scenes --count 10000 --jobs 2\n"
    "  random-scenes --one 1234\n"
    "  gdb --args random-scenes --one 1234";

// Progress on standard error: a line that is redrawn on a terminal, one now and then in a log.
class Progress {
 public:
  explicit Progress(int count) : count_(count) {}

  void show(const Summary& summary) {
    const auto now = Clock::now();
    const bool last = summary.scenes() == count_;
    if (!last && now - shown_ < std::chrono::milliseconds(terminal_ ? 200 : 30000)) return;
    shown_ = now;
    const double elapsed = std::chrono::duration<double>(now - begin_).count();
    const auto left =
        static_cast<long>(elapsed * (count_ - summary.scenes()) / summary.scenes() + 0.5);
    std::fprintf(stderr, "%s%d of %d scenes, %d failed, %.0f s, %ld:%02ld left%s",
                 terminal_ ? "\r" : "", summary.scenes(), count_, summary.failed(), elapsed,
                 left / 60, left % 60, terminal_ && !last ? "\033[K" : "\n");
  }
  void clear() const {
    if (terminal_) std::fputs("\r\033[K", stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  int count_;
  bool terminal_ = isatty(STDERR_FILENO) == 1;
  Clock::time_point begin_ = Clock::now(), shown_ = begin_;
};

int runOne(const Catalogue& catalogue, const CampaignPlan& plan, std::uint64_t seed) {
  RandomScene scene;
  const Outcome outcome = runBounded(catalogue, plan, seed, scene);
  std::cout << keptScene(plan, seed).string() << " (" << scene.manner << ", " << scene.elasticity
            << ", " << scene.integrator << ")\n";
  std::cout << nameOf(outcome.ending) << " after " << outcome.steps << " of " << scene.steps
            << " steps" << (outcome.story.empty() ? "" : ": ") << outcome.story << "\n";
  for (const auto& [name, times] : outcome.limiters) std::cout << name << " " << times << "\n";
  constexpr std::array<int, 4> codes = {0, 2, 3, 1};  // of finite, diagnosed, stopped, failed
  return codes[static_cast<std::size_t>(outcome.ending)];
}

int runMany(const Catalogue& catalogue, const CampaignPlan& plan, const std::string& program) {
  Summary summary;
  Progress progress(plan.count);
  std::ofstream table(plan.out / "scenes.txt");  // every scene: seed, ending, CPU time, why
  runCampaign(catalogue, plan, [&](const SceneResult& result) {
    summary.add(result);
    const Outcome& outcome = result.outcome;
    table << result.seed << " " << nameOf(outcome.ending) << " " << result.cpuSeconds << " "
          << outcome.story << "\n";
    if (outcome.ending == Ending::failed) {
      progress.clear();
      const bool given = !plan.files.empty();
      const std::string scene = given ? plan.files[result.seed - plan.firstSeed].string()
                                      : keptScene(plan, result.seed).string();
      std::cout << "FAILED " << (given ? "scene" : "seed " + std::to_string(result.seed)) << ": "
                << outcome.story << "\n  again: " << program
                << (given ? " --scenes " + scene : " --one " + std::to_string(result.seed))
                << "\n  scene: " << scene << std::endl;
    }
    progress.show(summary);
  });
  std::cout << summary.text() << std::flush;
  return summary.failed() > 0 ? 1 : 0;
}

}  // namespace
}  // namespace stroma::fuzz

int main(int argc, char** argv) {
  using namespace stroma::fuzz;
  CampaignPlan plan;
  plan.out = "out/random_scenes";
  plan.folders = {STROMA_TEST_MODULES, STROMA_MESHES};
  std::uint64_t one = 0;
  CLI::App app(introduction, "random-scenes");
  app.footer(closing);
  app.add_option("--count", plan.count, "Scenes to make")
      ->option_text("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seed", plan.firstSeed, "Seed of the first scene; the others follow it")
      ->option_text("S")
      ->capture_default_str();
  app.add_option("--jobs", plan.jobs, "Scenes at the same time")
      ->option_text("J")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  const auto* oneOption =
      app.add_option("--one", one, "Makes only the scene of this seed, and keeps it")
          ->option_text("SEED");
  app.add_option("--scenes", plan.files, "Runs these files instead of random scenes")
      ->option_text("FILE...")
      ->check(CLI::ExistingFile);
  app.add_option("--time-limit", plan.timeLimit,
                 "CPU time (s) after which a scene counts as hanging")
      ->option_text("T")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  app.add_option("--out", plan.out, "Folder for what failed")
      ->option_text("DIR")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    fs::create_directories(plan.out);
    const Catalogue catalogue(plan.folders.modules);
    for (const std::string& problem : catalogue.problems()) std::cerr << problem << "\n";
    if (catalogue.kinds().empty()) {
      std::cerr << "random-scenes: no components in " << plan.folders.modules << "\n";
      return 1;
    }
    if (!plan.files.empty()) plan.count = static_cast<int>(plan.files.size());
    return oneOption->count() > 0 ? runOne(catalogue, plan, one)
                                  : runMany(catalogue, plan, argv[0]);
  } catch (const std::exception& problem) {
    std::cerr << "random-scenes: " << problem.what() << "\n";
    return 1;
  }
}
