// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/browser_viewer.h"

#include <tinyxml2.h>

#include <algorithm>

#include "core/interfaces/observer.h"
#include "core/path.h"
#include "core/rate_keeper.h"
#include "core/traverse.h"
#include "plugins/viewer/equipment.h"
#include "plugins/viewer/json_text.h"
#include "plugins/viewer/mouse_device.h"
#include "plugins/viewer/scene_description.h"
#include "plugins/viewer/status.h"

namespace stroma {
namespace {

using Json = nlohmann::json;
using Seconds = std::chrono::duration<double>;
using viewer::PageMessage;

constexpr double mostFrames = 60;     // a second
constexpr double costShare = 0.02;    // of the time of the thread that makes the steps
constexpr double statusPeriod = 0.1;  // s

// When something that cost so much (s) may be done again.
std::chrono::steady_clock::time_point after(double period, double cost) {
  return std::chrono::steady_clock::now() +
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(
             Seconds(std::max(period, cost / costShare)));
}

Component* componentAt(Scene* scene, const std::string& path) {
  if (!scene) return nullptr;
  std::string problem, hint;
  return resolvePath(scene->root(), nullptr, path, problem, hint).component;
}

std::string base64Decoded(std::string_view text) {
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t value = digits.find(c);
    if (value == std::string_view::npos) break;
    bits = bits << 6 | static_cast<unsigned>(value);
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xffu);
  }
  return bytes;
}

}  // namespace

BrowserViewer::BrowserViewer() = default;
BrowserViewer::~BrowserViewer() = default;

void BrowserViewer::start() {
  viewer::PageBundle bundle;
  const std::filesystem::path folder =
      page.isSet() ? std::filesystem::path(page->path) : viewer::PageBundle::standardFolder();
  if (const std::string problem = bundle.read(folder); !problem.empty()) {
    return error(page, "viewer-page", problem,
                 "build it: npm ci && npm run build in plugins/viewer/page");
  }
  server_ = std::make_unique<viewer::Server>(
      viewer::ServerSettings{ipAddress, port, token, hosts, pictures}, std::move(bundle));
  if (const auto problem = server_->open()) {
    const AttributeBase& wrong =
        problem->ofAddress ? static_cast<const AttributeBase&>(ipAddress) : port;
    error(wrong, "viewer-listen", problem->text,
          problem->ofAddress ? "" : "--port 0 takes any port that is free");
    server_.reset();
  }
}

void BrowserViewer::stop() { server_.reset(); }

std::string BrowserViewer::address() const {
  if (!server_) return "";
  const bool six = ipAddress->find(':') != std::string::npos;
  const bool any = *ipAddress == "0.0.0.0" || *ipAddress == "::";
  const std::string host = any ? "localhost" : six ? "[" + *ipAddress + "]" : *ipAddress;
  return "http://" + host + ":" + std::to_string(server_->port()) + "/?token=" + server_->token();
}

void BrowserViewer::show(Scene& scene, const std::vector<std::string>& changes) {
  if (!server_) return;
  scene_ = &scene;
  ++generation_;
  bodies_ = std::make_unique<viewer::SceneBodies>(scene, generation_);
  server_->sendScene(viewer::dumped(viewer::describeScene(scene, *bodies_, generation_, changes)));
  frame_ = {};
  nextFrame_ = nextFields_ = nextStatus_ = {};
  sentStep_ = ~0ull;
  stageTotals_.clear();
  statusMark_.clear();
  outputs_.clear();
}

void BrowserViewer::publish(const SessionState& session) {
  if (!server_ || !scene_ || server_->watchers() == 0) return;
  if (looksRevision_ != server_->looksRevision()) {
    looksRevision_ = server_->looksRevision();
    looks_ = server_->looks();
    watches_ = server_->watches();
    scene_->profiler().setEnabled(watches_.timing);
    nextFields_ = {};
    sentStep_ = ~0ull;
  }
  const auto now = Clock::now();
  if (now >= nextFrame_ && sentStep_ != scene_->stepCount()) sendFrame();
  if (now >= nextStatus_) sendStatus(session);
}

void BrowserViewer::sendFrame() {
  const std::int64_t begin = threadCpuNanoseconds();
  for (auto& topology : bodies_->changedTopologies()) server_->sendTopology(std::move(topology));
  // while fields wait for their turn, those of before are shown; a state that stands still is shown
  // with its own
  const bool withFields = Clock::now() >= nextFields_;
  bodies_->copyInto(frame_, looks_, withFields);
  sentStep_ = frame_.step;
  server_->sendFrame(frame_);
  const double cost = static_cast<double>(threadCpuNanoseconds() - begin) * 1e-9;
  if (withFields && !looks_.fields.empty()) nextFields_ = after(1 / mostFrames, cost);
  nextFrame_ = after(1 / mostFrames, withFields && !looks_.fields.empty() ? 0 : cost);
  frameCost_ += cost;
  ++frames_;
}

void BrowserViewer::sendStatus(const SessionState& session) {
  nextStatus_ = after(statusPeriod, 0);
  Json status = viewer::describe(session, *scene_);
  // a session that stands still has nothing new to tell
  std::string mark = session.playing ? "" : viewer::dumped(status);
  if (!session.playing && mark == statusMark_) return;
  statusMark_ = std::move(mark);
  const std::uint64_t steps = scene_->stepCount() - std::min(statusStep_, scene_->stepCount());
  statusStep_ = scene_->stepCount();
  if (watches_.timing) viewer::addTiming(*scene_, steps, stageTotals_, status);
  if (watches_.energy) viewer::addEnergy(*scene_, status);
  status["generation"] = generation_;
  status["frameCost"] = meanFrameCost() * 1e3;
  server_->sendStatus(std::move(status));
  sendOutputs();
}

void BrowserViewer::sendOutputs() {
  Json values = Json::object();
  for (auto& [path, text] : viewer::smallOutputs(scene_->root())) {
    std::string& known = outputs_[path];
    if (known == text) continue;
    known = text;
    values[path] = std::move(text);
  }
  if (!values.empty()) {
    server_->sendToAll(viewer::dumped({{"type", "attributes"}, {"values", std::move(values)}}));
  }
}

void BrowserViewer::report(const Diagnostics& diagnostics) {
  if (!server_) return;
  const bool broken = diagnostics.errorCount() > 0;
  server_->sendDiagnostics(viewer::dumped(viewer::describe(diagnostics, broken)));
}

std::vector<ViewerRequest> BrowserViewer::takeRequests() {
  std::vector<ViewerRequest> requests;
  if (!server_) return requests;
  for (viewer::Incoming& incoming : server_->takeMessages()) {
    if (auto request = handle(incoming)) requests.push_back(std::move(*request));
  }
  return requests;
}

void BrowserViewer::refuse(std::uint64_t ticket, const std::string& why) {
  server_->answer(ticket, {{"done", why.empty()}, {"text", why}});
}

std::optional<ViewerRequest> BrowserViewer::handle(viewer::Incoming& incoming) {
  using Kind = ViewerRequest::Kind;
  using Type = PageMessage::Type;
  PageMessage& m = incoming.message;
  const std::uint64_t ticket = incoming.ticket;
  ViewerRequest request{Kind::play, std::move(m.path), std::move(m.text), m.number, ticket};
  const auto as = [&](Kind kind) {
    request.kind = kind;
    return std::optional(std::move(request));
  };
  const auto unless = [&](const std::string& problem) -> std::optional<ViewerRequest> {
    if (problem.empty()) return std::move(request);
    refuse(ticket, problem);
    return std::nullopt;
  };
  switch (m.type) {
    case Type::play:
      return as(Kind::play);
    case Type::pause:
      return as(Kind::pause);
    case Type::step:
      return as(Kind::step);
    case Type::reset:
      return as(Kind::reset);
    case Type::rewind:
      return as(Kind::rewind);
    case Type::speed:
      return as(Kind::speed);
    case Type::set:
      if (ticket > 0) sets_[ticket] = request.path;
      return as(Kind::set);
    case Type::replace:
      return as(Kind::replace);
    case Type::undo:
      return as(Kind::undo);
    case Type::reload:
      return as(Kind::reload);
    case Type::revert:
      return as(Kind::revert);
    case Type::picture:
      request.text = base64Decoded(request.text);
      return as(Kind::picture);
    case Type::save:
      saves_[ticket] = request.text == "recording";
      return as(Kind::sceneText);
    case Type::take:
      return unless(takeInHand(request.path, request));
    case Type::equip:
      m.path = request.path;
      m.text = request.text;
      return unless(equip(m, request));
    case Type::pose:
      m.path = request.path;
      refuse(ticket, move(m));
      return std::nullopt;
    case Type::neighbours: {
      const std::vector<Index> ids =
          bodies_ ? bodies_->neighboursOf(m.body, m.particle) : std::vector<Index>();
      server_->answer(ticket, {{"done", true}, {"text", ""}, {"ids", ids}});
      return std::nullopt;
    }
    case Type::alternatives: {
      const Component* component = componentAt(scene_, request.path);
      if (!component) return unless("the scene has no component " + stroma::quoted(request.path));
      server_->answer(
          ticket, {{"done", true}, {"text", ""}, {"types", viewer::alternativesTo(*component)}});
      return std::nullopt;
    }
    default:
      return std::nullopt;  // the server's own: steer, look, watch
  }
}

std::string BrowserViewer::move(const PageMessage& message) {
  const auto* tool = dynamic_cast<Tool*>(componentAt(scene_, message.path));
  if (!tool) return "the scene has no tool " + stroma::quoted(message.path);
  auto* mouse = dynamic_cast<MouseDevice*>(viewer::deviceOf(*scene_, *tool));
  if (!mouse) return stroma::quoted(message.path) + " is not moved by the mouse: take it first";
  if (!mouse->follow({message.pose, message.buttons, message.jump})) {
    return "too many poses wait";
  }
  return "";
}

std::string BrowserViewer::takeInHand(const std::string& path, ViewerRequest& request) {
  const auto* tool = dynamic_cast<Tool*>(componentAt(scene_, path));
  if (!tool) return "the scene has no tool " + stroma::quoted(path);
  const HapticDevice* device = viewer::deviceOf(*scene_, *tool);
  if (!device) return "no device moves " + stroma::quoted(path) + ": give it one in the scene";
  if (dynamic_cast<const MouseDevice*>(device)) return "the mouse moves it already";
  request.kind = ViewerRequest::Kind::replace;
  request.path = device->path();
  request.text = viewer::mouseElement(device->name(), tool->pose());
  return "";
}

std::string BrowserViewer::equip(const PageMessage& message, ViewerRequest& request) {
  const auto surface = std::ranges::find_if(bodies_->bodies(), [&](const viewer::Body& b) {
    return b.topology && b.path() == message.path;
  });
  if (surface == bodies_->bodies().end())
    return "the scene has no surface " + stroma::quoted(message.path);
  request.kind = ViewerRequest::Kind::insert;
  request.path = surface->state->node().path();
  request.text = message.text == "pull" ? viewer::pullElements(*scene_, *surface)
                                        : viewer::probeElements(*scene_, *surface);
  return "";
}

void BrowserViewer::answer(std::uint64_t ticket, bool done, const std::string& text) {
  if (!server_ || ticket == 0) return;
  if (const auto set = sets_.extract(ticket); set && done) tellAll(set.mapped());
  const auto save = saves_.find(ticket);
  if (save == saves_.end()) return server_->answer(ticket, {{"done", done}, {"text", text}});
  Json answer{{"done", done}, {"text", done ? "" : text}};
  if (done) answer["files"] = filesOf(text, save->second);
  saves_.erase(save);
  server_->answer(ticket, std::move(answer));
}

// The page that has set an attribute knows; the others are told.
void BrowserViewer::tellAll(const std::string& path) {
  std::string problem, hint;
  if (const auto target = findAttribute(scene_->root(), path, problem, hint)) {
    server_->sendToAll(
        viewer::dumped({{"type", "attributes"}, {"values", {{path, target.attribute->print()}}}}));
  }
}

Json BrowserViewer::filesOf(const std::string& sceneText, bool recording) {
  const std::string stem = scene_->file().stem().string();
  if (!recording) return {{{"name", stem + ".xml"}, {"text", sceneText}}};
  Json files = Json::array();
  std::vector<std::string> names;
  for (const MouseDevice* mouse : collect<MouseDevice>(scene_->root())) {
    names.push_back(stem + "_" + std::to_string(names.size() + 1) + ".csv");
    files.push_back({{"name", names.back()}, {"text", mouse->recording()}});
  }
  files.push_back(
      {{"name", stem + "_again.xml"}, {"text", viewer::withScriptedDevices(sceneText, names)}});
  return files;
}

}  // namespace stroma
