// SPDX-License-Identifier: Apache-2.0
// A page, as a test plays it: blocking requests and a WebSocket.
#pragma once

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "plugins/viewer/server.h"

namespace stroma::viewer {

using Json = nlohmann::json;

// A bundle with an index.html and an app.js.
[[nodiscard]] PageBundle testPage();
// An open server on a free port of the loopback.
[[nodiscard]] std::unique_ptr<Server> openServer(ServerSettings settings = {});

struct Answer {
  int status = 0;
  std::string headers, body;
};
// Sends the bytes as they are and reads until the server closes, a response is whole or the time is
// over.
[[nodiscard]] Answer exchange(int port, const std::string& bytes, int milliseconds = 5000);
[[nodiscard]] Answer get(const Server& server, const std::string& target,
                         const std::string& host = "", const std::string& more = "");

class TestPage {
 public:
  explicit TestPage(const Server& server) : TestPage(server, "/socket?token=" + server.token()) {}
  TestPage(const Server& server, const std::string& target) : TestPage(server.port(), target) {}
  TestPage(int port, const std::string& target);
  ~TestPage();
  TestPage(const TestPage&) = delete;
  TestPage& operator=(const TestPage&) = delete;

  void send(const Json& message) { sendText(message.dump()); }
  void sendText(const std::string& text);
  void sendBinary(const std::string& bytes);
  // The next message of this type that comes within the time.
  [[nodiscard]] std::optional<Json> next(const std::string& type, int milliseconds = 3000);
  // The next binary message.
  [[nodiscard]] std::optional<std::string> nextBinary(int milliseconds = 3000);
  // The code with which the server closes, 0 if it does not.
  [[nodiscard]] int closeCode(int milliseconds = 3000);
  // Goes away without a word.
  void vanish();

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

}  // namespace stroma::viewer
