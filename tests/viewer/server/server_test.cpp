// SPDX-License-Identifier: Apache-2.0
// The server on the loopback: who is let in, what is told to whom, and that one who misbehaves is
// alone in it.
#include "plugins/viewer/server.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/rate_keeper.h"
#include "tests/viewer/server/client.h"

namespace stroma::viewer {
namespace {

FrameCopy frameOf(std::uint64_t step, std::size_t points = 3) {
  FrameCopy frame;
  frame.step = step;
  frame.bodies.push_back({0, 0, std::vector<float>(3 * points, 1.0f), {}});
  return frame;
}

// Waits for what happens in the serving thread.
bool soon(const std::function<bool()>& happens) {
  for (int i = 0; i < 300; ++i) {
    if (happens()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(Server, servesThePageToThoseWhoHaveTheToken) {
  const auto server = openServer();
  const std::string token = "?token=" + server->token();
  const Answer page = get(*server, "/" + token);
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, "<!doctype html>page");
  EXPECT_NE(page.headers.find("Content-Security-Policy"), std::string::npos);
  const std::string cookie =
      "Cookie: stroma-" + std::to_string(server->port()) + "=" + server->token() + "\r\n";
  EXPECT_EQ(get(*server, "/app.js", "", cookie).body, "app");
  EXPECT_EQ(get(*server, "/", "localhost:" + std::to_string(server->port()), cookie).status, 200);
  EXPECT_EQ(server->token().size(), 32u);
  EXPECT_NE(server->token(), openServer()->token());
}

TEST(Server, refusesOthersWith403) {
  const auto server = openServer();
  const std::string token = "?token=" + server->token();
  EXPECT_EQ(get(*server, "/").status, 403);
  EXPECT_EQ(get(*server, "/?token=").status, 403);
  EXPECT_EQ(get(*server, "/?token=" + std::string(32, '0')).status, 403);
  EXPECT_EQ(get(*server, "/" + token + "0").status, 403);
  EXPECT_EQ(get(*server, "/nothing").status, 403);
  EXPECT_EQ(get(*server, "/" + token, "evil.example:" + std::to_string(server->port())).status,
            403);
  EXPECT_EQ(get(*server, "/" + token, "127.0.0.1:1").status, 403);
  EXPECT_EQ(get(*server, "/" + token, "", "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(get(*server, "/" + token, "", "Origin: null\r\n").status, 403);
  const std::string upgrade =
      "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  EXPECT_EQ(get(*server, "/socket?token=wrong", "", upgrade).status, 403);
  EXPECT_EQ(get(*server, "/socket" + token, "", upgrade + "Origin: http://evil.example\r\n").status,
            403);
  EXPECT_THROW(TestPage(*server, "/socket?token=wrong"), std::exception);
  EXPECT_EQ(server->watchers(), 0);
}

TEST(Server, hasNothingBesideTheBundle) {
  const auto server = openServer();
  const std::string token = "?token=" + server->token();
  for (const char* path :
       {"/nothing", "/secret.key", "/../server_test.cpp", "/..%2f..%2fetc/passwd", "//etc/passwd",
        "/./index.html", "/socket", "/index.html/", "/%00"}) {
    EXPECT_EQ(get(*server, path + token).status, 404) << path;
  }
  const std::string host = "Host: 127.0.0.1:" + std::to_string(server->port()) + "\r\n";
  EXPECT_EQ(exchange(server->port(),
                     "POST /" + token + " HTTP/1.1\r\n" + host + "Content-Length: 0\r\n\r\n")
                .status,
            405);
  EXPECT_EQ(exchange(server->port(), "nonsense\r\n\r\n").status, 400);
  const Answer head = exchange(
      server->port(), "HEAD /" + token + " HTTP/1.1\r\n" + host + "Connection: close\r\n\r\n");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.body, "");
}

TEST(Server, tellsAPageThatComesLateAllThatStands) {
  const auto server = openServer();
  server->sendScene(R"({"type":"scene","generation":1})");
  auto topology = std::make_shared<TopologyCopy>();
  topology->rest.assign(9, 0.0f);
  topology->triangles = {0, 1, 2};
  server->sendTopology(topology);
  FrameCopy frame = frameOf(5);
  server->sendFrame(frame);
  server->sendStatus({{"type", "status"}, {"step", 5}});
  TestPage page(*server);
  EXPECT_TRUE(page.next("hello")->at("steers"));
  EXPECT_EQ(page.next("scene")->at("generation"), 1);
  const auto first = page.nextBinary();
  ASSERT_TRUE(first);
  EXPECT_EQ((*first)[0], 1);
  const auto second = page.nextBinary();
  ASSERT_TRUE(second);
  EXPECT_EQ((*second)[0], 2);
}

TEST(Server, answersWhoAskedAndOnlyOneSteers) {
  const auto server = openServer();
  server->sendStatus({{"type", "status"}});
  TestPage first(*server);
  ASSERT_TRUE(first.next("hello"));
  TestPage second(*server);
  EXPECT_FALSE(second.next("hello")->at("steers"));
  first.send({{"type", "play"}, {"n", 41}});
  std::vector<Incoming> incoming;
  ASSERT_TRUE(soon([&] { return !(incoming = server->takeMessages()).empty(); }));
  EXPECT_EQ(incoming[0].message.type, PageMessage::Type::play);
  server->answer(incoming[0].ticket, {{"done", true}, {"text", ""}});
  EXPECT_EQ(first.next("answer")->at("n"), 41);

  second.send({{"type", "pause"}, {"n", 42}});
  EXPECT_FALSE(second.next("answer")->at("done"));
  EXPECT_TRUE(server->takeMessages().empty());
  second.send({{"type", "steer"}, {"n", 43}});
  EXPECT_TRUE(second.next("answer")->at("done"));
  second.send({{"type", "pause"}});
  ASSERT_TRUE(soon([&] { return !server->takeMessages().empty(); }));
  second.vanish();
  // the one that is left takes over
  EXPECT_TRUE(soon([&] {
    const auto status = first.next("status", 100);
    return status && status->at("steers") == true && status->at("watchers") == 1;
  }));
}

TEST(Server, gathersWhatAllPagesLookAt) {
  const auto server = openServer();
  auto first = std::make_unique<TestPage>(*server);
  TestPage second(*server);
  first->send({{"type", "look"}, {"body", 1}, {"field", "vonMises"}, {"particles", false}});
  second.send({{"type", "look"}, {"body", 1}, {"field", "ratio"}, {"particles", true}});
  second.send({{"type", "watch"}, {"timing", true}, {"energy", false}});
  EXPECT_TRUE(soon([&] { return server->watches().timing; }));
  EXPECT_TRUE(soon([&] { return server->looks().fields[1].size() == 2; }));
  EXPECT_TRUE(server->looks().particles.contains(1));
  first.reset();
  EXPECT_TRUE(soon([&] { return server->looks().fields[1].size() == 1; }));
}

TEST(Server, closesWhoMisbehavesAndNobodyElse) {
  const auto server = openServer();
  server->sendStatus({{"type", "status"}});
  TestPage honest(*server);
  ASSERT_TRUE(honest.next("hello"));
  const auto codeAfter = [&](const std::function<void(TestPage&)>& misbehave) {
    TestPage page(*server);
    EXPECT_TRUE(page.next("hello"));
    misbehave(page);
    return page.closeCode();
  };
  EXPECT_EQ(codeAfter([](TestPage& p) { p.sendText("nonsense"); }), 1008);
  EXPECT_EQ(codeAfter([](TestPage& p) { p.sendText(R"({"type":"fly"})"); }), 1008);
  EXPECT_EQ(codeAfter([](TestPage& p) { p.sendText("{\"type\":\"\xff\"}"); }), 1007);
  EXPECT_EQ(codeAfter([](TestPage& p) { p.sendBinary("x"); }), 1003);
  EXPECT_EQ(codeAfter([](TestPage& p) { p.sendText(std::string(70000, ' ')); }), 1009);
  EXPECT_EQ(codeAfter([](TestPage& p) { p.send({{"type", "picture"}, {"png", "AAAA"}}); }), 1008);
  EXPECT_EQ(codeAfter([](TestPage& p) {
              for (int i = 0; i < 5000; ++i)
                p.send({{"type", "watch"}, {"timing", true}, {"energy", false}});
            }),
            1008);
  honest.send({{"type", "play"}, {"n", 1}});
  EXPECT_TRUE(soon([&] { return !server->takeMessages().empty(); }));
  EXPECT_EQ(server->watchers(), 1);
}

// A page that does not read: frames are dropped for it, the newest goes to the others.
TEST(Server, neverWaitsForASlowPage) {
  const auto server = openServer();
  TestPage slow(*server), quick(*server);
  ASSERT_TRUE(quick.next("hello"));
  ASSERT_TRUE(soon([&] { return server->watchers() == 2; }));
  double longest = 0;  // of CPU time: others may have the processor
  for (std::uint64_t step = 1; step <= 200; ++step) {
    FrameCopy frame = frameOf(step, 100000);
    const std::int64_t begin = threadCpuNanoseconds();
    server->sendFrame(frame);
    longest = std::max(longest, static_cast<double>(threadCpuNanoseconds() - begin) * 1e-9);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::printf("longest handing over of a frame: %.3f ms\n", longest * 1e3);
  EXPECT_LT(longest, 0.01);
  FrameCopy last = frameOf(1000);
  server->sendFrame(last);
  const auto stepOf = [](const std::string& bytes) {
    return Json::parse(bytes.substr(8, static_cast<unsigned char>(bytes[4]) +
                                           256u * static_cast<unsigned char>(bytes[5])))
        .at("step")
        .get<int>();
  };
  int newest = 0;
  while (newest != 1000) {
    const auto frame = quick.nextBinary();
    ASSERT_TRUE(frame);
    newest = stepOf(*frame);
  }
}

TEST(Server, saysWhyItCannotListen) {
  const auto first = openServer();
  ServerSettings same;
  same.port = first->port();
  Server second(same, testPage());
  const auto problem = second.open();
  ASSERT_TRUE(problem);
  EXPECT_FALSE(problem->ofAddress);
  EXPECT_NE(problem->text.find("in use"), std::string::npos) << problem->text;
  ServerSettings wrong;
  wrong.address = "somewhere";
  Server third(wrong, testPage());
  EXPECT_TRUE(third.open()->ofAddress);
}

}  // namespace
}  // namespace stroma::viewer
