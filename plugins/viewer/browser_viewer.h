// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "core/attribute.h"
#include "core/interfaces/viewer.h"
#include "plugins/viewer/scene_bodies.h"
#include "plugins/viewer/server.h"

namespace stroma {

// Shows scenes in browser windows: an HTTP server for the page and a WebSocket for what is seen and
// done (protocol.md). The mouse moves tools through MouseDevice.
//
// While nobody watches a step costs a look at a counter. Else positions are copied, never more than
// 60 times a second and never for more than about a fiftieth of the time; the serving thread does
// the rest.
class BrowserViewer final : public Viewer {
 public:
  Attribute<std::string> ipAddress{this, "address", "127.0.0.1",
                                   "IP address to listen at; the standard is this machine alone."};
  Attribute<int> port{
      this, "port", 8090, "TCP port, 0 = any that is free.", {.min = 0, .max = 65535}};
  Attribute<std::string> token{this, "token", "",
                               "What a page must know to be served; random without it."};
  Attribute<std::vector<std::string>> hosts{
      this, "hosts", {}, "Further names by which this machine may be called in a browser."};
  Attribute<FilePath> page{
      this, "page", {}, "Folder of the built page; the installed one without."};
  Attribute<bool> pictures{this, "pictures", false,
                           "Whether pictures are taken from the page that makes them."};

  BrowserViewer();
  ~BrowserViewer() override;

  void start() override;
  void stop() override;
  [[nodiscard]] std::string address() const override;
  void show(Scene& scene, const std::vector<std::string>& changes) override;
  void publish(const SessionState& session) override;
  void report(const Diagnostics& diagnostics) override;
  [[nodiscard]] std::vector<ViewerRequest> takeRequests() override;
  void answer(std::uint64_t ticket, bool done, const std::string& text) override;

  // Of the thread that makes the steps, for each frame so far (s).
  [[nodiscard]] double meanFrameCost() const { return frames_ ? frameCost_ / frames_ : 0; }
  [[nodiscard]] int frames() const { return frames_; }

 private:
  using Clock = std::chrono::steady_clock;
  void lookForChanges();
  void sendFrame();
  void sendStatus(const SessionState& session);
  void sendOutputs();
  // A request for the session, or none: the viewer has answered it.
  [[nodiscard]] std::optional<ViewerRequest> handle(viewer::Incoming& incoming);
  void refuse(std::uint64_t ticket, const std::string& why);
  [[nodiscard]] std::string move(const viewer::PageMessage& message);
  [[nodiscard]] std::string takeInHand(const std::string& tool, ViewerRequest& request);
  [[nodiscard]] std::string equip(const viewer::PageMessage& message, ViewerRequest& request);
  void tellAll(const std::string& path);
  [[nodiscard]] nlohmann::json filesOf(const std::string& sceneText, bool recording);

  std::unique_ptr<viewer::Server> server_;
  Scene* scene_ = nullptr;
  std::unique_ptr<viewer::SceneBodies> bodies_;
  std::uint64_t generation_ = 0;

  viewer::Looks looks_;
  viewer::Server::Watches watches_;
  std::uint64_t looksRevision_ = 0;
  viewer::FrameCopy frame_;
  Clock::time_point nextFrame_{}, nextFields_{}, nextStatus_{};
  std::uint64_t sentStep_ = ~0ull, sentLooks_ = 0;
  double frameCost_ = 0;
  int frames_ = 0;
  std::vector<double> stageTotals_;  // ms, at the last status
  std::uint64_t statusStep_ = 0;
  std::string statusMark_;                      // what the last status told, but for times
  std::map<std::string, std::string> outputs_;  // that the pages know
  std::map<std::uint64_t, std::string> sets_;   // tickets that set an attribute: its path
  std::map<std::uint64_t, bool> saves_;         // tickets that wait for the scene's text: recording
};

}  // namespace stroma
