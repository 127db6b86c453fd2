// SPDX-License-Identifier: Apache-2.0
#include "tools/study/job_pool.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <thread>

namespace stroma::study {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

struct Place {
  std::vector<int> cores{};
  const Job* job = nullptr;  // null: free
  pid_t process = 0;
  Clock::time_point begun{};
};

std::string listOf(const std::vector<int>& cores) {
  std::string text;
  for (const int core : cores) text += (text.empty() ? "" : ",") + std::to_string(core);
  return text;
}

class Pool {
 public:
  Pool(const PoolOptions& options, const PoolEvents& events) : options_(options), events_(events) {
    for (const auto& cores : options.cores) places_.push_back({.cores = cores});
  }

  bool run(const std::vector<const Job*>& jobs) {
    std::size_t next = 0, busy = 0;
    auto ticked = Clock::now();
    while (next < jobs.size() || busy > 0) {
      if (events_.stop()) return endAll();
      busy = 0;
      for (Place& place : places_) {
        if (place.job) lookAt(place);
        if (!place.job && next < jobs.size() && !start(place, *jobs[next++])) return endAll();
        busy += place.job ? 1 : 0;
      }
      if (Clock::now() - ticked > std::chrono::milliseconds(200)) {
        events_.tick();
        ticked = Clock::now();
      }
      if (busy > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }

 private:
  bool start(Place& place, const Job& job) {
    const fs::path file = options_.folder / "jobs" / (job.id + ".json");
    const fs::path log = options_.folder / "logs" / (job.id + ".txt");
    std::error_code failure;
    fs::remove(job.result, failure);  // what is there later comes from this process
    if (!replaceFile(file, toJson(job).dump(1))) return false;
    std::vector<std::string> words{options_.program.string(),
                                   options_.command,
                                   "--one",
                                   file.string(),
                                   "--cores",
                                   listOf(place.cores),
                                   "--parent",
                                   std::to_string(getpid())};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    const int problem = posix_spawn(&place.process, words.front().c_str(), &actions, nullptr,
                                    arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) return false;
    place.job = &job;
    place.begun = Clock::now();
    events_.started(job);
    return true;
  }

  void lookAt(Place& place) {
    int status = 0;
    const pid_t ended = waitpid(place.process, &status, WNOHANG);
    if (ended == 0) {
      const double seconds = std::chrono::duration<double>(Clock::now() - place.begun).count();
      if (seconds < place.job->timeout) return;
      kill(place.process, SIGKILL);
      waitpid(place.process, &status, 0);
      std::array<char, 80> text{};
      std::snprintf(text.data(), text.size(), "not done after %.4g s", place.job->timeout);
      return finish(place, "timed out", text.data());
    }
    if (WIFSIGNALED(status)) {
      return finish(place, "crashed",
                    "ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                        strsignal(WTERMSIG(status)) + ")");
    }
    finish(place, "crashed",
           "ended without a result, exit code " + std::to_string(WEXITSTATUS(status)) +
               ": see logs/" + place.job->id + ".txt");
  }

  // A result that is there is whole: the process wrote it at once.
  void finish(Place& place, const char* otherwise, const std::string& message) {
    const Job& job = *place.job;
    place.job = nullptr;
    Json result = readJson(job.result);
    if (result.is_null()) {
      result = {{"id", job.id}, {"label", job.label}, {"status", otherwise}, {"message", message}};
      (void)replaceFile(job.result, result.dump(1));
    }
    events_.finished(job, result);
  }

  bool endAll() {
    for (const Place& place : places_) {
      if (place.job) kill(place.process, SIGKILL);
    }
    for (const Place& place : places_) {
      if (place.job) waitpid(place.process, nullptr, 0);
    }
    return false;
  }

  const PoolOptions& options_;
  const PoolEvents& events_;
  std::vector<Place> places_;
};

}  // namespace

bool runJobs(const std::vector<const Job*>& jobs, const PoolOptions& options,
             const PoolEvents& events) {
  return Pool(options, events).run(jobs);
}

bool isFinal(const Json& result) {
  if (!result.is_object() || !result.contains("status")) return false;
  const Json& status = result["status"];
  return status == "done" || status == "diverged" || status == "failed";
}

}  // namespace stroma::study
