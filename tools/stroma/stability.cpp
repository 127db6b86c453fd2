// SPDX-License-Identifier: Apache-2.0
// `stroma stability SUITE`: runs hard cases with every method and says which of them hold.
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <memory>

#include "tools/stability/run_case.h"
#include "tools/stability/suite_results.h"
#include "tools/stroma/command.h"
#include "tools/stroma/interrupt.h"
#include "tools/stroma/study_one.h"
#include "tools/study/job_pool.h"
#include "tools/study/machine.h"
#include "tools/study/report.h"

namespace stroma::cli {
namespace {
namespace fs = std::filesystem;
using study::Json;

struct Options {
  std::string suite, out;
  std::vector<std::string> plugins, data, cases, methods;
  int jobs = 1;
  bool quick = false, check = false, json = false;
  OneJob one;
};

class StabilityRun {
 public:
  explicit StabilityRun(const Options& options) : options_(options) {
    out_ = options.out.empty() ? fs::path("out") / fs::path(options.suite).stem()
                               : fs::path(options.out);
    out_ = fs::absolute(out_);
  }

  int execute() {
    Diagnostics diagnostics;
    suite_ = stability::readSuite(options_.suite, diagnostics);
    if (diagnostics.errorCount() == 0) {
      cells_ = stability::makePlan(
          suite_,
          {out_, options_.plugins, options_.data, options_.quick, options_.cases, options_.methods},
          diagnostics);
    }
    std::cerr << diagnostics.text();
    if (diagnostics.errorCount() > 0) return sceneInvalid;
    if (options_.check) {
      std::cout << options_.suite << ": valid, " << suite_.cases.size() << " cases and "
                << suite_.methods.size() << " methods" << std::endl;
      return done;
    }
    for (const stability::Cell& cell : cells_) {
      if (!cell.skipped && cell.notApplicable.empty()) todo_.push_back(&cell.job);
    }
    if (todo_.empty()) {
      std::cerr << "stroma: no run is left: see --case and --method\n";
      return wrongUsage;
    }
    const auto places = placesOnCores(options_.jobs, 1);
    if (places.empty()) return wrongUsage;
    if (!writeScenes()) return fileTrouble;
    listenForInterrupts();
    if (!runAll(places)) return fileTrouble;
    return report();
  }

 private:
  bool writeScenes() {
    for (const char* part : {"scenes", "jobs", "logs", "results"}) {
      std::error_code failure;
      fs::create_directories(out_ / part, failure);
    }
    for (const stability::Cell& cell : cells_) {
      if (cell.sceneText.empty() || study::replaceFile(cell.job.scene, cell.sceneText)) continue;
      std::cerr << "stroma: cannot write '" << cell.job.scene << "'\n";
      return false;
    }
    return true;
  }

  bool runAll(const std::vector<std::vector<int>>& places) {
    study::PoolEvents events;
    events.started = [](const study::Job&) {};
    events.finished = [&](const study::Job& job, const Json& result) {
      results_[job.id] = result;
      const double seconds = result.value("seconds", 0.0);
      std::fprintf(stderr, "%zu/%zu  %s  %s  %.2g s\n", results_.size(), todo_.size(),
                   job.label.c_str(), result.value("status", "crashed").c_str(), seconds);
    };
    events.stop = [] { return interruptSignal() != 0; };
    events.tick = [] {};
    std::error_code failure;
    const fs::path program = fs::read_symlink("/proc/self/exe", failure);
    const bool ended = study::runJobs(todo_, {program, out_, places, "stability"}, events);
    if (ended || interruptSignal() != 0) return true;
    std::cerr << "stroma: cannot start processes, or write into '" << out_.string() << "'\n";
    return false;
  }

  int report() {
    const Json summary = stability::summarise(suite_, cells_, results_, study::describeMachine());
    std::string problem;
    const auto page = stability::pageOf(summary, results_, study::reportFolder(), problem);
    if (!page) {
      std::cerr << "stroma: " << problem << "\n";
      return fileTrouble;
    }
    const std::string json = summary.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    const std::string text = stability::textOf(summary);
    const bool written = study::replaceFile(out_ / "results.json", json) &&
                         study::replaceFile(out_ / "table.txt", text) &&
                         study::replaceFile(out_ / "table.html", *page);
    if (!written) {
      std::cerr << "stroma: cannot write into '" << out_.string() << "'\n";
      return fileTrouble;
    }
    std::cerr << "page: " << (out_ / "table.html").string() << "\n";
    std::cout << (options_.json ? json : text) << std::flush;
    if (interruptSignal() != 0) return 128 + interruptSignal();
    return summary["totals"]["failed"] == 0 ? done : checkFailed;
  }

  const Options& options_;
  fs::path out_;
  stability::Suite suite_;
  std::vector<stability::Cell> cells_;
  std::vector<const study::Job*> todo_;
  stability::Results results_;
};

}  // namespace

void addStability(CLI::App& app, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "stability", "Run hard cases with every method: which of them hold, by criteria in numbers");
  command->add_option("SUITE", options->suite, "Suite file");
  command->add_flag("--quick", options->quick, "Only the quick methods and cases");
  command
      ->add_option("--jobs", options->jobs,
                   "Runs side by side, each on a core of its own. Default 1")
      ->option_text("N")
      ->check(CLI::Range(1, 1024));
  addRepeated(*command, "--case", options->cases,
              "Only this case, also a long one; * at the end stands for anything; may be repeated")
      ->option_text("NAME");
  addRepeated(*command, "--method", options->methods, "Only this method, in the same way")
      ->option_text("NAME");
  command
      ->add_option("--out", options->out,
                   "Folder for the table, the results and the scenes that were run; out/<suite> "
                   "without it")
      ->option_text("DIR");
  command->add_flag("--check", options->check, "Read the suite and its scenes, and run nothing");
  command->add_flag("--json", options->json, "Print results.json on standard output");
  addFolders(*command, options->plugins, options->data);
  addOneJob(*command, options->one);
  command->footer(
      "DIR/table.html shows every end; table.txt and results.json have the same. DIR/scenes has\n"
      "every scene that was run: its _run says how to run it by hand.\n"
      "Exit codes: 0 all cases passed, 1 wrong usage, 2 the suite or a scene is invalid, 4 "
      "trouble\n"
      "with files, 5 a case failed, 130 interrupted: what was finished is kept and reported.\n"
      "Examples:\n"
      "  stroma stability tests/stability/suite.xml --quick --jobs 2\n"
      "  stroma stability tests/stability/suite.xml --case \"flat*\" --method MLS --out out/flat");
  command->callback([options, &exitCode] {
    if (!options->one.file.empty()) {
      exitCode = runOne(options->one, stability::runCase);
    } else if (options->suite.empty()) {
      throw CLI::RequiredError("SUITE");
    } else {
      exitCode = StabilityRun(*options).execute();
    }
  });
}

}  // namespace stroma::cli
