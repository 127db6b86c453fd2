// SPDX-License-Identifier: Apache-2.0
// Requests and messages that were made to do harm: nothing crashes or leaks, and an honest page
// goes on being served.
#include <gtest/gtest.h>

#include <thread>

#include "core/random.h"
#include "tests/viewer/server/client.h"

namespace stroma::viewer {
namespace {

class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : random_(seed) {}

  std::string request(const Server& server) {
    const std::string port = std::to_string(server.port());
    std::string text =
        "GET /" + pick({"", "app.js", "socket", "../etc/passwd", "%2e%2e/"}) +
        pick({"", "?token=" + server.token(), "?token=x", "?"}) +
        " HTTP/1.1\r\nHost: " + pick({"127.0.0.1:" + port, "localhost:" + port, "evil", ""}) +
        "\r\n" +
        pick({"",
              "Upgrade: websocket\r\nConnection: Upgrade\r\n"
              "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAA\r\n",
              "Content-Length: 99999999999\r\n", "Transfer-Encoding: chunked\r\n",
              "Cookie: " + bytes(200) + "\r\n", "Origin: " + bytes(20) + "\r\n",
              std::string(9000, 'h') + ": v\r\n"}) +
        "\r\n";
    return mutated(std::move(text));
  }

  std::string message() {
    const std::string base =
        pick({R"({"type":"pose","tool":"/a","p":[1,2,3],"q":[0,0,0,1],"buttons":1})",
              R"({"type":"set","n":3,"path":"/a.b","value":"1"})", R"({"type":"look","body":1})",
              R"({"type":"step","count":-4})", R"({"type":"rewind","time":1e400})", "", "null",
              "[[[[[[", std::string(2000, '{'), bytes(100)});
    return mutated(base);
  }
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(random_() * static_cast<double>(n)) % n;
  }

 private:
  std::string pick(const std::vector<std::string>& from) { return from[below(from.size())]; }
  std::string bytes(std::size_t most) {
    std::string text(below(most + 1), ' ');
    for (char& c : text) c = static_cast<char>(below(256));
    return text;
  }
  std::string mutated(std::string text) {
    for (std::size_t k = below(4); k > 0 && !text.empty(); --k) {
      const std::size_t at = below(text.size());
      if (below(2))
        text[at] = static_cast<char>(below(256));
      else
        text.erase(at, 1 + below(8));
    }
    return text;
  }
  UniformRandom random_;
};

void attack(int count) {
  const auto server = openServer();
  server->sendStatus({{"type", "status"}});
  TestPage honest(*server);
  ASSERT_TRUE(honest.next("hello"));
  Hostile hostile(7);
  int answered = 0, closed = 0, fine = 0, sent = 0;
  while (sent < count) {
    if (hostile.below(8) != 0) {
      const Answer answer = exchange(server->port(), hostile.request(*server), 20);
      ++sent;
      ++answered;
      const int s = answer.status;
      EXPECT_TRUE(s == 0 || s == 101 || s == 200 || s == 400 || s == 403 || s == 404 || s == 405)
          << s;
      continue;
    }
    // one page sends until it is closed
    try {
      TestPage page(*server);
      for (int i = 0; i < 12 && sent < count; ++i, ++sent) {
        if (hostile.below(20) == 0)
          page.sendBinary(hostile.message());
        else
          page.sendText(hostile.message());
      }
      if (hostile.below(3) == 0)
        page.vanish();
      else
        page.closeCode(10) == 1006 ? ++fine : ++closed;
    } catch (const std::exception&) {
      // closed while it was still sending
      ++closed;
    }
    static_cast<void>(server->takeMessages());
    if (sent % 500 < 12) {
      honest.send({{"type", "watch"}, {"timing", true}, {"energy", false}, {"n", sent + 1}});
      ASSERT_TRUE(honest.next("answer")) << "after " << sent;
    }
  }
  std::printf("%d sent: %d requests, %d pages closed, %d not\n", sent, answered, closed, fine);
  honest.send({{"type", "play"}, {"n", 1}});
  bool served = false;
  for (int i = 0; i < 300 && !served; ++i) {
    served = !server->takeMessages().empty();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(served);
  EXPECT_GT(closed, 0);
}

TEST(HostileClients, thousand) { attack(2000); }
TEST(HostileClients, hundredThousand) { attack(100000); }

}  // namespace
}  // namespace stroma::viewer
