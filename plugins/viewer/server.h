// SPDX-License-Identifier: Apache-2.0
// The HTTP and WebSocket server, in a thread of its own. What goes in and out of that thread are
// values: it never sees the scene, and nobody who makes steps waits for it.
#pragma once

// Before Asio of Boost 1.74, which relies on others to bring it along.
#include <utility>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "plugins/viewer/frame.h"
#include "plugins/viewer/message_reader.h"
#include "plugins/viewer/page_bundle.h"
#include "plugins/viewer/scene_bodies.h"

namespace stroma::viewer {

class Watcher;

// What somebody who watches has sent, with the ticket of its answer.
struct Incoming {
  PageMessage message;
  std::uint64_t ticket = 0;  // 0: no answer is wanted
};

struct ServerSettings {
  std::string address = "127.0.0.1";
  int port = 0;                    // 0: a free one
  std::string token;               // empty: a random one
  std::vector<std::string> hosts;  // further names that a request's Host may have
  bool takesPictures = false;
};

struct ServerProblem {
  std::string text;
  bool ofAddress = false;  // rather than of the port
};

// Text and binary messages alike; shared by all connections that send them.
using Bytes = std::shared_ptr<const std::string>;

class Server {
 public:
  Server(ServerSettings settings, PageBundle page);
  ~Server();

  // Starts listening, or says why not.
  [[nodiscard]] std::optional<ServerProblem> open();
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] const std::string& token() const { return settings_.token; }

  // For the thread that makes the steps: none of these waits for a connection.
  [[nodiscard]] int watchers() const { return watchers_.load(std::memory_order_relaxed); }
  void sendScene(std::string json);
  void sendTopology(std::shared_ptr<const TopologyCopy> topology);
  void sendDiagnostics(std::string json);
  // An object without what each connection gets of its own ("steers", "watchers").
  void sendStatus(nlohmann::json status);
  void sendToAll(std::string json);
  // An object without "n".
  void answer(std::uint64_t ticket, nlohmann::json answer);
  // The newest frame replaces one that has not gone out. Swaps storage: `frame` is then an old one.
  void sendFrame(FrameCopy& frame);
  [[nodiscard]] std::vector<Incoming> takeMessages();
  // Another number when what the pages look at has changed.
  [[nodiscard]] std::uint64_t looksRevision() const { return looksRevision_; }
  [[nodiscard]] Looks looks() const;
  struct Watches {
    bool timing = false, energy = false;
  };
  [[nodiscard]] Watches watches() const;

 private:
  friend class HttpConnection;
  friend class Watcher;
  using Tcp = boost::asio::ip::tcp;

  // All below are called by the serving thread.
  void accept();
  [[nodiscard]] bool isKnownHost(std::string_view host) const;
  [[nodiscard]] bool hasToken(std::string_view query, std::string_view cookie) const;
  void join(const std::shared_ptr<Watcher>& watcher);
  void leave(const Watcher& watcher);
  void take(Watcher& from, PageMessage message);
  void updateLooks();
  void steer(std::uint64_t watcher);
  void spread(const Bytes& text);
  void sendStatusTo(Watcher& watcher);
  void encodeFrame();

  ServerSettings settings_;
  const PageBundle page_;
  int connections_ = 0;  // counted down by what the context still holds at its end
  boost::asio::io_context context_;
  Tcp::acceptor acceptor_;
  int port_ = 0;
  std::atomic<int> watchers_{0};
  std::atomic<std::uint64_t> looksRevision_{0};

  mutable std::mutex mutex_;  // of what follows; held for a swap or a copy only
  std::vector<Incoming> incoming_;
  FrameCopy pending_;
  bool hasPending_ = false;
  Looks looks_;
  Watches watches_;

  // of the serving thread
  std::map<std::uint64_t, std::shared_ptr<Watcher>> joined_;
  std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>> tickets_;  // -> watcher, n
  std::uint64_t nextWatcher_ = 1, nextTicket_ = 1, steering_ = 0;
  Bytes scene_, diagnostics_, frame_;
  std::map<int, Bytes> topologies_;
  nlohmann::json status_;
  FrameCopy encoding_;
  std::jthread thread_;
};

}  // namespace stroma::viewer
