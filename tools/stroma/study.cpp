// SPDX-License-Identifier: Apache-2.0
// `stroma study STUDY`: runs the variations of a study and reports what accuracy costs in time.
#include <unistd.h>

#include <iostream>
#include <memory>

#include "tools/stroma/command.h"
#include "tools/stroma/interrupt.h"
#include "tools/stroma/study_one.h"
#include "tools/stroma/study_progress.h"
#include "tools/study/job_pool.h"
#include "tools/study/machine.h"
#include "tools/study/report.h"
#include "tools/study/run_job.h"
#include "tools/study/slurm.h"

namespace stroma::cli {
namespace {
namespace fs = std::filesystem;
using study::Json;

struct Options {
  std::string study, out, cache;
  std::vector<std::string> plugins, data;
  int jobs = 1;
  bool again = false, slurm = false, json = false;
  OneJob one;
};

fs::path standardCache() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) {
    return fs::path(cache) / "stroma";
  }
  const char* home = std::getenv("HOME");
  return fs::path(home && *home ? home : ".") / ".cache" / "stroma";
}

class StudyRun {
 public:
  explicit StudyRun(const Options& options) : options_(options) {
    out_ = options.out.empty() ? fs::path("out") / fs::path(options.study).stem()
                               : fs::path(options.out);
    out_ = fs::absolute(out_);
    cache_ = options.cache.empty() ? standardCache() : fs::path(options.cache);
  }

  int execute() {
    Diagnostics diagnostics;
    study_ = study::readStudy(options_.study, diagnostics);
    if (diagnostics.errorCount() == 0) {
      plan_ = study::makePlan(study_, {out_, cache_, options_.plugins, options_.data}, diagnostics);
    }
    std::cerr << diagnostics.text();
    if (diagnostics.errorCount() > 0) return sceneInvalid;
    const auto places = placesOnCores(options_.jobs, study_.threads);
    if (places.empty()) return wrongUsage;
    if (!makeFolders() || !writeScenes()) return fileTrouble;
    collect();
    if (options_.slurm) return writeSlurm();
    listenForInterrupts();
    if (!todo_.empty() && !runTodo(places)) return fileTrouble;
    return report();
  }

 private:
  bool makeFolders() {
    bool hasReferences = false;
    for (const study::Variation& v : plan_) hasReferences |= v.isReference;
    std::vector<fs::path> folders{out_ / "scenes", out_ / "jobs", out_ / "logs", out_ / "results"};
    if (hasReferences) folders.push_back(cache_);
    for (const fs::path& folder : folders) {
      std::error_code failure;
      fs::create_directories(folder, failure);
      if (fs::is_directory(folder) && access(folder.c_str(), W_OK | X_OK) == 0) continue;
      std::cerr << "stroma: cannot write into '" << folder.string() << "'\n";
      return false;
    }
    return true;
  }

  bool writeScenes() {
    for (const study::Variation& v : plan_) {
      if (study::replaceFile(v.job.scene, v.sceneText)) continue;
      std::cerr << "stroma: cannot write '" << v.job.scene << "'\n";
      return false;
    }
    return true;
  }

  // What is done already, and what is not.
  void collect() {
    for (study::Variation& v : plan_) {
      Json result = options_.again ? Json() : study::readJson(v.job.result);
      if (study::isFinal(result) && result.value("id", "") == v.job.id) {
        results_[v.job.id] = std::move(result);
      } else {
        todo_.push_back(&v.job);
      }
    }
    for (study::Job* job : todo_) {
      job->sideBySide = std::min(options_.jobs, static_cast<int>(todo_.size()));
    }
    std::cerr << plan_.size() << (plan_.size() == 1 ? " run" : " runs");
    if (!results_.empty()) std::cerr << ", " << results_.size() << " of them done before";
    std::cerr << std::endl;
  }

  [[nodiscard]] std::vector<const study::Job*> todo() const { return {todo_.begin(), todo_.end()}; }

  bool runTodo(const std::vector<std::vector<int>>& places) {
    StudyProgress progress(todo_.size());
    study::PoolEvents events;
    events.started = [&](const study::Job& job) { progress.started(job); };
    events.finished = [&](const study::Job& job, const Json& result) {
      results_[job.id] = result;
      progress.finished(job, result);
    };
    events.stop = [] { return interruptSignal() != 0; };
    events.tick = [&] { progress.tick(); };
    std::error_code failure;
    const fs::path program = fs::read_symlink("/proc/self/exe", failure);
    const bool ended = study::runJobs(todo(), {program, out_, places}, events);
    progress.clear();
    if (ended || interruptSignal() != 0) return true;
    std::cerr << "stroma: cannot start processes, or write into '" << out_.string() << "'\n";
    return false;
  }

  int writeSlurm() {
    if (todo_.empty()) {
      std::cerr << "everything is done; without --slurm the report is written\n";
      return done;
    }
    std::string list;
    for (const study::Job* job : todo_) {
      const fs::path file = out_ / "jobs" / (job->id + ".json");
      list += file.string() + "\n";
      if (!study::replaceFile(file, toJson(*job).dump(1))) return fileTrouble;
    }
    std::error_code failure;
    const fs::path program = fs::read_symlink("/proc/self/exe", failure);
    const fs::path script = out_ / "job.sbatch";
    const bool written =
        study::replaceFile(out_ / "job.list", list) &&
        study::replaceFile(script,
                           study::slurmScript(todo(), program, out_ / "job.list", out_ / "logs"));
    if (!written) return fileTrouble;
    std::cout << "sbatch " << study::shellWord(script.string()) << "\n";
    std::cerr << "Submit this, wait until the array has ended, then run the same command without "
                 "--slurm: it makes the report, and runs here what the array left.\n";
    return done;
  }

  int report() {
    const Json summary = study::summarise(study_, plan_, results_, study::describeMachine());
    std::string problem;
    const auto page = study::reportPage(summary, results_, study::reportFolder(), problem);
    if (!page) {
      std::cerr << "stroma: " << problem << "\n";
      return fileTrouble;
    }
    const std::string json = summary.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    const bool written = study::replaceFile(out_ / "results.json", json) &&
                         study::replaceFile(out_ / "results.csv", study::csvOf(summary)) &&
                         study::replaceFile(out_ / "report.html", *page);
    if (!written) {
      std::cerr << "stroma: cannot write into '" << out_.string() << "'\n";
      return fileTrouble;
    }
    std::cout << (options_.json ? json
                                : study::textOf(summary) +
                                      "\nreport: " + (out_ / "report.html").string() + "\n")
              << std::flush;
    if (interruptSignal() != 0) return 128 + interruptSignal();
    for (const auto& [id, result] : results_) {
      if (result["status"] != "done") return diverged;
    }
    return done;
  }

  const Options& options_;
  fs::path out_, cache_;
  study::Study study_;
  std::vector<study::Variation> plan_;
  study::Results results_;
  std::vector<study::Job*> todo_;
};

}  // namespace

void addStudy(CLI::App& app, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("study", "Run the variations of a study: what accuracy costs in time");
  command->add_option("STUDY", options->study, "Study file");
  command
      ->add_option("--out", options->out,
                   "Folder for the report, the results and the scenes that were run; out/<study> "
                   "without it")
      ->option_text("DIR");
  command
      ->add_option("--cache", options->cache,
                   "Folder where reference runs are kept; $XDG_CACHE_HOME/stroma or "
                   "~/.cache/stroma without it")
      ->option_text("DIR");
  command
      ->add_option("--jobs", options->jobs,
                   "Variations to run side by side, each on cores of its own; the report says so, "
                   "since they share the memory. Default 1: the truest times")
      ->option_text("N")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--again", options->again, "Run also what is done already");
  command->add_flag("--slurm", options->slurm,
                    "Write DIR/job.sbatch, a job array that runs what is not done yet");
  command->add_flag("--json", options->json, "Print results.json on standard output");
  addFolders(*command, options->plugins, options->data);
  addOneJob(*command, options->one);
  command->footer(
      "DIR/report.html shows it all; results.csv and results.json are for other programs.\n"
      "A study that was stopped goes on where it was; what diverged or failed stays in the table,\n"
      "what crashed or took too long is tried again.\n"
      "Exit codes: 0 all variations are done, 2 the study or a scene is invalid, 3 the report is\n"
      "complete but a variation diverged, failed, crashed or took too long, 4 trouble with files,\n"
      "130 interrupted: what was finished is kept and reported.\n"
      "Examples:\n"
      "  stroma study scenes/studies/bending.xml\n"
      "  stroma study scenes/studies/cantilever.xml --jobs 2 --out out/beam\n"
      "  stroma study scenes/studies/cantilever.xml --out out/beam --json > beam.json\n"
      "  stroma study big.xml --slurm --out out/big && sbatch out/big/job.sbatch");
  command->callback([options, &exitCode] {
    if (!options->one.file.empty()) {
      exitCode = runOne(options->one, study::runJob);
    } else if (options->study.empty()) {
      throw CLI::RequiredError("STUDY");
    } else {
      exitCode = StudyRun(*options).execute();
    }
  });
}

}  // namespace stroma::cli
