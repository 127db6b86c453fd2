// SPDX-License-Identifier: Apache-2.0
// One page that is connected: its WebSocket, what waits to be sent to it and what it looks at.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>

#include "plugins/viewer/server.h"

namespace stroma::viewer {

class Watcher : public std::enable_shared_from_this<Watcher> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;

  Watcher(Server& server, boost::beast::tcp_stream&& stream);
  ~Watcher();

  // Answers the upgrade; once that is done the page is among those who watch.
  void accept(Request request);
  void send(Bytes text);
  // The newest frame: sent when nothing else waits, unless a newer one comes first.
  void offer(Bytes frame);
  // Ends the connection.
  void close(boost::beast::websocket::close_code code, const std::string& reason);

  std::uint64_t id = 0;                               // given by the server
  std::map<int, std::pair<std::string, bool>> looks;  // by body: field, particles
  Server::Watches watches;

 private:
  using Clock = std::chrono::steady_clock;
  void read();
  void take(std::size_t bytes);
  [[nodiscard]] bool isTooFast();
  void writeNext();

  Server& server_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  Request request_;
  boost::beast::flat_buffer buffer_;
  std::deque<Bytes> waiting_;
  std::size_t waitingBytes_ = 0;
  Bytes frame_, writing_;
  bool joined_ = false, closing_ = false;
  Clock::time_point second_{};
  int messagesInSecond_ = 0;
};

}  // namespace stroma::viewer
