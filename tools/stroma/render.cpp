// SPDX-License-Identifier: Apache-2.0
// `stroma render SCENE`: a picture of a scene at a time, without anybody at the screen. The page of
// the viewer draws it in a browser without a window and sends it back.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <thread>

#include "core/parallel.h"
#include "tools/stroma/command.h"
#include "tools/stroma/interrupt.h"
#include "tools/stroma/progress_bar.h"
#include "tools/stroma/viewer_host.h"
#include "tools/view/session.h"

namespace stroma::cli {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string scene, out, time = "0", camera, colour, theme = "light", browser;
  SceneFlags flags;
  int width = 1280, height = 800, patience = 120;
  bool particles = false, bare = false;
};

// The first that there is; Debian's package chromium-headless-shell has the smallest.
std::string findBrowser(const std::string& given) {
  std::vector<std::string> names{"chromium-headless-shell", "chromium", "chromium-browser",
                                 "google-chrome", "chrome"};
  if (!given.empty()) names = {given};
  if (!given.empty() && given.find('/') != std::string::npos) return given;
  const char* path = std::getenv("PATH");
  for (const std::string& name : names) {
    for (std::string_view rest = path ? path : "/usr/bin"; !rest.empty();) {
      const std::size_t end = std::min(rest.find(':'), rest.size());
      const fs::path file = fs::path(rest.substr(0, end)) / name;
      if (access(file.c_str(), X_OK) == 0) return file.string();
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  return "";
}

// A browser without a window, with a profile of its own that goes when it ends.
class Browser {
 public:
  Browser(const std::string& program, const std::string& address, int width, int height) {
    profile_ = (fs::temp_directory_path() / "stroma-render-XXXXXX").string();
    if (!mkdtemp(profile_.data())) profile_.clear();
    std::vector<std::string> arguments{
        program, "--headless", "--use-gl=angle", "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader", "--no-first-run", "--disable-quic",
        "--disable-background-networking", "--disable-component-update", "--disable-sync",
        "--hide-scrollbars",
        "--window-size=" + std::to_string(width) + "," + std::to_string(height),
        "--user-data-dir=" + profile_,
        // DevTools keep the browser open until it is told to end
        "--remote-debugging-port=0"};
    if (geteuid() == 0) arguments.push_back("--no-sandbox");  // it refuses to run as root otherwise
    arguments.push_back(address);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int stream : {1, 2}) {
      posix_spawn_file_actions_addopen(&files, stream, "/dev/null", 1, 0);
    }
    // a group of its own: the program is a script that starts others
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    if (posix_spawn(&process_, program.c_str(), &files, &attributes, argv.data(), environ) != 0) {
      process_ = -1;
    }
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  ~Browser() {
    if (process_ > 0) {
      kill(-process_, SIGTERM);
      waitpid(process_, nullptr, 0);
    }
    std::error_code ignored;
    if (!profile_.empty()) fs::remove_all(profile_, ignored);
  }
  [[nodiscard]] bool runs() {
    if (process_ > 0 && waitpid(process_, nullptr, WNOHANG) == process_) process_ = -1;
    return process_ > 0;
  }

 private:
  std::string profile_;
  pid_t process_ = -1;
};

int failed(const std::string& problem, int code) {
  std::cerr << "stroma: " << problem << "\n";
  return code;
}

std::string pageAddress(const Options& options, const Viewer& viewer) {
  std::string address = viewer.address() + "&picture=1&width=" + std::to_string(options.width) +
                        "&height=" + std::to_string(options.height) + "&theme=" + options.theme;
  if (!options.camera.empty()) address += "&camera=" + options.camera;
  if (!options.colour.empty()) address += "&colour=" + options.colour;
  if (options.particles) address += "&particles=1";
  if (options.bare) address += "&context=0";
  return address;
}

int render(const Options& options) {
  double time = 0;
  const auto problem = ValueTraits<double>::parse(options.time, {"s", UnitSystem{}}, time);
  if (problem || !(time >= 0)) {
    return failed("--at: " + (problem ? problem->message : "must not be negative"), wrongUsage);
  }
  const std::string browser = findBrowser(options.browser);
  if (browser.empty() || access(browser.c_str(), X_OK) != 0) {
    return failed(
        "no browser is found: install Debian's chromium-headless-shell, or name one with --browser",
        fileTrouble);
  }
  ViewerHost host(options.flags.options());
  Viewer* viewer = host.open("BrowserViewer", {{"port", "0"}, {"pictures", "true"}});
  if (!viewer) return fileTrouble;
  SceneOptions sceneOptions = options.flags.options();
  sceneOptions.writesOutput = false;
  view::Session session(options.scene, std::move(sceneOptions), *viewer);
  const bool good = session.open();
  std::cerr << session.diagnostics().text();
  if (!good) return sceneInvalid;
  listenForInterrupts();
  ProgressBar bar(0, static_cast<std::uint64_t>(std::ceil(time / session.scene().dt())), time);
  const bool reached = session.advanceTo(time, [&](const Scene& scene) {
    bar.show(scene.stepCount(), scene.time());
    return interruptSignal() == 0;
  });
  bar.clear();
  if (interruptSignal() != 0) return 128 + interruptSignal();
  if (!reached) return failed("diverged: " + session.state().stopped, diverged);

  Browser window(browser, pageAddress(options, *viewer), options.width, options.height);
  const auto last = Clock::now() + std::chrono::seconds(options.patience);
  session.run(false, [&] {
    const view::Session::Picture& picture = session.picture();
    return !picture.png.empty() || !picture.problem.empty() || !window.runs() || Clock::now() > last ||
           interruptSignal() != 0;
  });
  if (interruptSignal() != 0) return 128 + interruptSignal();
  if (!session.picture().problem.empty()) return failed(session.picture().problem, wrongUsage);
  if (session.picture().png.empty()) {
    return failed("no picture came from '" + browser + "'" +
                      (window.runs() ? " within " + std::to_string(options.patience) + " s" : ""),
                  fileTrouble);
  }
  std::ofstream file(options.out, std::ios::binary);
  file << session.picture().png;
  file.close();
  if (!file) return failed("cannot write '" + options.out + "'", fileTrouble);
  std::cout << options.out << ": " << options.width << " x " << options.height << " at "
            << session.scene().time() << " s\n";
  return done;
}

}  // namespace

void addRender(CLI::App& app, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("render", "Make a picture of a scene");
  command->add_option("SCENE", options->scene, "Scene file")->required();
  command->add_option("--out", options->out, "The picture, a PNG file")
      ->option_text("FILE")
      ->required();
  command
      ->add_option("--at", options->time,
                   "Simulated time, such as 0.2 or \"200 ms\"; the start without it")
      ->option_text("T");
  command
      ->add_option("--camera", options->camera,
                   "Where it stands and what it looks at (m), and its angle of view (degrees)")
      ->option_text("x,y,z,tx,ty,tz[,angle]");
  command->add_option("--colour", options->colour, "Field to colour by, such as displacement")
      ->option_text("FIELD");
  command->add_option("--width", options->width, "Its width; 1280 without it")
      ->option_text("PIXELS")
      ->check(CLI::Range(16, 8192));
  command->add_option("--height", options->height, "Its height; 800 without it")
      ->option_text("PIXELS")
      ->check(CLI::Range(16, 8192));
  command->add_option("--theme", options->theme, "light (without it) or dark")
      ->option_text("NAME")
      ->check(CLI::IsMember({"light", "dark"}));
  command->add_flag("--particles", options->particles, "With the particles");
  command->add_flag("--bare", options->bare, "The bodies alone, without the eye behind a cornea");
  command->add_option("--browser", options->browser, "Chromium, where it is not found by itself")
      ->option_text("PROGRAM");
  command
      ->add_option("--patience", options->patience,
                   "Seconds to wait for the picture; 120 without it")
      ->option_text("S")
      ->check(CLI::Range(1, 3600));
  options->flags.addTo(*command);
  command->footer(
      "Needs Chromium (Debian's package chromium-headless-shell); it draws without a screen.\n"
      "Examples:\n"
      "  stroma render scenes/cornea/cut.xml --at \"300 ms\" --out cut.png\n"
      "  stroma render scenes/liver/cut.xml --at 0.2 --colour displacement --theme dark --out "
      "l.png");
  command->callback([options, &exitCode] { exitCode = render(*options); });
}

}  // namespace stroma::cli
