// SPDX-License-Identifier: Apache-2.0
// `stroma view SCENE`: runs a scene while somebody watches it in a browser and works on it.
#include <iostream>
#include <memory>

#include "core/interfaces/viewer.h"
#include "core/parallel.h"
#include "tools/stroma/command.h"
#include "tools/stroma/interrupt.h"
#include "tools/stroma/viewer_host.h"
#include "tools/view/session.h"

namespace stroma::cli {
namespace {

struct Options {
  std::string scene, out, address = "127.0.0.1", viewer = "BrowserViewer";
  std::vector<std::string> hosts;
  SceneFlags flags;
  int port = 8090, threads = 1;
  bool paused = false, realTime = false;
};

int view(const Options& options) {
  setThreadCount(options.threads);
  ViewerHost host(options.flags.options());
  std::map<std::string, std::string> attributes{{"port", std::to_string(options.port)},
                                                {"address", options.address}};
  for (const std::string& name : options.hosts) attributes["hosts"] += name + " ";
  Viewer* viewer = host.open(options.viewer, attributes);
  if (!viewer) return fileTrouble;

  SceneOptions sceneOptions = options.flags.options();
  sceneOptions.writesOutput = !options.out.empty();
  sceneOptions.outputFolder = options.out.empty() ? "." : options.out;
  sceneOptions.realTime = options.realTime;
  view::Session session(options.scene, std::move(sceneOptions), *viewer);
  const bool good = session.open();
  std::cerr << session.diagnostics().text();
  if (!good) return sceneInvalid;
  std::cout << "Open " << viewer->address() << "\nCtrl-C ends.\n" << std::flush;
  listenForInterrupts();
  session.run(!options.paused, [] { return interruptSignal() != 0; });
  session.scene().stop();
  return done;
}

}  // namespace

void addView(CLI::App& app, int& exitCode) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("view", "Run a scene and see, touch and change it in a browser");
  command->add_option("SCENE", options->scene, "Scene file")->required();
  command
      ->add_option("--port", options->port,
                   "TCP port of the page, 8090 without it; 0 = any that is free")
      ->option_text("P")
      ->check(CLI::Range(0, 65535));
  command
      ->add_option("--address", options->address,
                   "IP address to listen at; without it 127.0.0.1, which only this machine reaches")
      ->option_text("IP");
  addRepeated(*command, "--host", options->hosts,
              "Further name by which browsers call this machine; may be repeated")
      ->option_text("NAME");
  command->add_flag("--paused", options->paused, "Wait for the play button");
  command->add_flag("--real-time", options->realTime,
                    "Haptic devices are served by threads of their own, by the wall clock");
  command->add_option("--threads", options->threads, "Threads of the simulation; 1 without it")
      ->option_text("N")
      ->check(CLI::Range(1, 1024));
  command->add_option("--out", options->out, "Folder for what exporters write; nothing without it")
      ->option_text("DIR");
  command
      ->add_option("--viewer", options->viewer,
                   "Another component that shows scenes than BrowserViewer")
      ->option_text("TYPE");
  options->flags.addTo(*command);
  command->footer(
      "Prints an address with a token: whoever has it may watch and steer. It listens on this\n"
      "machine alone; from elsewhere, forward the port: ssh -L 8090:localhost:8090 HOST.\n"
      "The scene file is watched: saving it shows it anew, from its present state where the "
      "bodies\n"
      "are the same; a broken one is reported and the last good one goes on.\n"
      "Examples:\n"
      "  stroma view scenes/cornea/interactive.xml\n"
      "  stroma view scenes/cornea/cut.xml --port 0 --paused");
  command->callback([options, &exitCode] { exitCode = view(*options); });
}

}  // namespace stroma::cli
