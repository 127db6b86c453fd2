// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/random_scenes/campaign.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace stroma::fuzz {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Child {
  pid_t pid = -1;
  int pipe = -1;
  std::uint64_t seed = 0;
  std::string report;
  Clock::time_point begin = Clock::now();
  bool overdue = false;
};

std::string logOf(const CampaignPlan& plan, std::uint64_t seed) {
  return (plan.out / (std::to_string(seed) + ".log")).string();
}

// One line each: what the scene is made of, how it ended, why, its steps, its topology changes;
// then limiters.
std::string reportOf(const RandomScene& scene, const Outcome& outcome) {
  std::string story = outcome.story;
  for (char& c : story) c = c == '\n' ? ' ' : c;
  std::string text = scene.elasticity + "\n" + scene.integrator + "\n" +
                     std::string(nameOf(outcome.ending)) + "\n" + story + "\n" +
                     std::to_string(outcome.steps) + "\n" + std::to_string(outcome.cuts) + "\n";
  for (const auto& [name, count] : outcome.limiters) {
    text += name + " " + std::to_string(count) + "\n";
  }
  return text + "end\n";
}

void readReport(const std::string& text, SceneResult& result) {
  std::istringstream lines(text);
  std::string ending, steps, line;
  std::getline(lines, result.elasticity);
  std::getline(lines, result.integrator);
  std::getline(lines, ending);
  std::getline(lines, result.outcome.story);
  std::getline(lines, steps);
  result.outcome.ending = endingOf(ending);
  result.outcome.steps = std::atoi(steps.c_str());
  std::getline(lines, steps);
  result.outcome.cuts = std::atoi(steps.c_str());
  while (std::getline(lines, line) && line != "end") {
    const auto blank = line.rfind(' ');
    result.outcome.limiters.emplace_back(line.substr(0, blank),
                                         std::stoull(line.substr(blank + 1)));
  }
  if (line != "end") result.outcome = {Ending::failed, "no report", 0, 0, {}};
}

void writeAll(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n <= 0) return;
    done += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void runChild(const Catalogue& catalogue, const CampaignPlan& plan, std::uint64_t seed,
                           int pipe) {
  const int log = open(logOf(plan, seed).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(log, STDERR_FILENO);
  dup2(log, STDOUT_FILENO);
  RandomScene scene;
  const Outcome outcome = runBounded(catalogue, plan, seed, scene);
  writeAll(pipe, reportOf(scene, outcome));
  _exit(0);
}

Child startChild(const Catalogue& catalogue, const CampaignPlan& plan, std::uint64_t seed) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("cannot start a process");
  if (pid == 0) runChild(catalogue, plan, seed, ends[1]);
  close(ends[1]);
  return {pid, ends[0], seed, {}, Clock::now(), false};
}

// What the process left on its standard error that a sanitizer or the library's checks wrote.
std::string complaintIn(const std::string& log) {
  std::ifstream stream(log);
  for (std::string line; std::getline(stream, line);) {
    for (const char* mark : {"runtime error:", "Sanitizer", "Assertion", "terminate called"}) {
      if (line.find(mark) != std::string::npos) return line;
    }
  }
  return "";
}

SceneResult endChild(const Child& child, const CampaignPlan& plan) {
  SceneResult result;
  result.seed = child.seed;
  int status = 0;
  rusage usage{};
  wait4(child.pid, &status, 0, &usage);
  close(child.pipe);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  result.cpuSeconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  readReport(child.report, result);
  Outcome& outcome = result.outcome;
  if (child.overdue || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
    outcome = {Ending::failed,
               "hangs: not done after " + std::to_string(plan.timeLimit) + " s of CPU time",
               0,
               0,
               {}};
  } else if (WIFSIGNALED(status)) {
    outcome = {
        Ending::failed, std::string("ended by a signal: ") + strsignal(WTERMSIG(status)), 0, 0, {}};
  } else if (WEXITSTATUS(status) != 0) {
    outcome = {Ending::failed, "ended with code " + std::to_string(WEXITSTATUS(status)), 0, 0, {}};
  }
  const std::string log = logOf(plan, child.seed);
  const std::string complaint = complaintIn(log);
  if (!complaint.empty()) {
    outcome.story = outcome.ending == Ending::failed ? outcome.story + "; " + complaint : complaint;
    outcome.ending = Ending::failed;
  }
  if (outcome.ending != Ending::failed) fs::remove(keptScene(plan, child.seed));
  if (outcome.ending != Ending::failed || fs::file_size(log) == 0) fs::remove(log);
  return result;
}

}  // namespace

fs::path keptScene(const CampaignPlan& plan, std::uint64_t seed) {
  return plan.out / (std::to_string(seed) + ".xml");
}

Outcome runBounded(const Catalogue& catalogue, const CampaignPlan& plan, std::uint64_t seed,
                   RandomScene& scene) {
  const auto seconds = static_cast<rlim_t>(std::ceil(plan.timeLimit));
  const rlimit time{seconds, seconds + 1};
  setrlimit(RLIMIT_CPU, &time);
#ifndef __SANITIZE_ADDRESS__  // which reserves more addresses than there is memory
  const rlimit memory{plan.memory, plan.memory};
  setrlimit(RLIMIT_AS, &memory);
#endif
  const rlimit core{0, 0};
  setrlimit(RLIMIT_CORE, &core);
  const auto keep = [&](const std::string& text) {
    std::ofstream stream(keptScene(plan, seed));
    stream << text << "<!-- stroma run " << keptScene(plan, seed).string() << " --data "
           << plan.folders.meshes.string() << " -->\n";
  };
  if (plan.files.empty()) {
    scene = randomScene(catalogue, plan.folders, seed, keep);
    keep(scene.text);
  } else {
    std::ifstream stream(plan.files[seed - plan.firstSeed], std::ios::binary);
    scene.text.assign(std::istreambuf_iterator<char>(stream), {});
    scene.steps = 40;
    scene.elasticity = scene.integrator = "given";
  }
  return runTrial(scene, plan.folders, plan.stepTime);
}

void runCampaign(const Catalogue& catalogue, const CampaignPlan& plan,
                 const std::function<void(const SceneResult&)>& done) {
  std::vector<Child> children;
  int started = 0;
  while (started < plan.count || !children.empty()) {
    while (started < plan.count && static_cast<int>(children.size()) < plan.jobs) {
      children.push_back(
          startChild(catalogue, plan, plan.firstSeed + static_cast<std::uint64_t>(started)));
      ++started;
    }
    std::vector<pollfd> ends;
    for (const Child& child : children) ends.push_back({child.pipe, POLLIN, 0});
    poll(ends.data(), ends.size(), 1000);
    for (std::size_t i = ends.size(); i-- > 0;) {
      Child& child = children[i];
      // one that sleeps uses no CPU time
      if (!child.overdue &&
          Clock::now() - child.begin > std::chrono::duration<double>(20 * plan.timeLimit)) {
        child.overdue = true;
        kill(child.pid, SIGKILL);
      }
      if (ends[i].revents == 0) continue;
      std::array<char, 4096> buffer{};
      const ssize_t n = read(child.pipe, buffer.data(), buffer.size());
      if (n > 0) {
        child.report.append(buffer.data(), static_cast<std::size_t>(n));
        continue;
      }
      done(endChild(child, plan));
      children.erase(children.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

}  // namespace stroma::fuzz
