// SPDX-License-Identifier: Apache-2.0
#include "tests/viewer/server/client.h"

#include <unistd.h>
#include <boost/asio/connect.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace stroma::viewer {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using boost::system::error_code;

PageBundle testPage() {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("stroma-page-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "index.html") << "<!doctype html>page";
  std::ofstream(folder / "app.js") << "app";
  std::ofstream(folder / "secret.key") << "not of the page";
  PageBundle page;
  if (const std::string problem = page.read(folder); !problem.empty()) {
    throw std::runtime_error(problem);
  }
  fs::remove_all(folder);
  return page;
}

std::unique_ptr<Server> openServer(ServerSettings settings) {
  auto server = std::make_unique<Server>(std::move(settings), testPage());
  if (const auto problem = server->open()) throw std::runtime_error(problem->text);
  return server;
}

namespace {

Tcp::endpoint endOf(int port) {
  return {asio::ip::address_v4::loopback(), static_cast<unsigned short>(port)};
}

}  // namespace

Answer exchange(int port, const std::string& bytes, int milliseconds) {
  asio::io_context context;
  beast::tcp_stream stream(context);
  stream.expires_after(std::chrono::milliseconds(milliseconds));
  Answer answer;
  std::string text;
  error_code failure;
  stream.socket().connect(endOf(port), failure);
  if (failure) return answer;
  asio::write(stream.socket(), asio::buffer(bytes), failure);
  std::array<char, 4096> part;
  std::size_t whole = std::string::npos;
  const auto readSome = [&](auto&& self) -> void {
    stream.async_read_some(asio::buffer(part), [&](error_code ended, std::size_t size) {
      text.append(part.data(), size);
      const std::size_t end = text.find("\r\n\r\n");
      if (whole == std::string::npos && end != std::string::npos) {
        const std::size_t length = text.find("Content-Length: ");
        whole = end + 4 + (length < end ? std::stoul(text.substr(length + 16)) : 0);
      }
      if (!ended && text.size() < whole) self(self);
    });
  };
  readSome(readSome);
  context.run();
  if (text.starts_with("HTTP/1.")) answer.status = std::stoi(text.substr(9, 3));
  const std::size_t end = std::min(text.find("\r\n\r\n"), text.size());
  answer.headers = text.substr(0, end);
  answer.body = text.substr(std::min(end + 4, text.size()));
  return answer;
}

Answer get(const Server& server, const std::string& target, const std::string& host,
           const std::string& more) {
  const std::string name = host.empty() ? "127.0.0.1:" + std::to_string(server.port()) : host;
  return exchange(server.port(), "GET " + target + " HTTP/1.1\r\nHost: " + name + "\r\n" + more +
                                     "Connection: close\r\n\r\n");
}

struct TestPage::Socket {
  asio::io_context context;
  websocket::stream<beast::tcp_stream> stream{context};
  beast::flat_buffer buffer;
  int closed = 0;

  // One message, or none within the time.
  std::optional<std::string> read(int milliseconds) {
    if (closed) return std::nullopt;
    std::optional<std::string> message;
    bool ended = false;
    beast::get_lowest_layer(stream).expires_never();
    stream.async_read(buffer, [&](error_code failure, std::size_t) {
      ended = true;
      if (failure) {
        closed = stream.reason().code ? static_cast<int>(stream.reason().code) : 1006;
        return;
      }
      message = beast::buffers_to_string(buffer.data());
      buffer.consume(buffer.size());
    });
    context.restart();
    context.run_for(std::chrono::milliseconds(milliseconds));
    if (!ended) {  // nothing came: the read ends with the connection
      beast::get_lowest_layer(stream).cancel();
      context.restart();
      context.run();
      closed = closed ? closed : 1006;
    }
    return message;
  }
};

TestPage::TestPage(int port, const std::string& target) : socket_(std::make_unique<Socket>()) {
  const std::string host = "127.0.0.1:" + std::to_string(port);
  beast::get_lowest_layer(socket_->stream).socket().connect(endOf(port));
  socket_->stream.read_message_max(256 * 1024 * 1024);
  socket_->stream.handshake(host, target);
}

TestPage::~TestPage() = default;

void TestPage::sendText(const std::string& text) {
  error_code gone;
  socket_->stream.text(true);
  socket_->stream.write(asio::buffer(text), gone);
}

void TestPage::sendBinary(const std::string& bytes) {
  error_code gone;
  socket_->stream.binary(true);
  socket_->stream.write(asio::buffer(bytes), gone);
}

std::optional<Json> TestPage::next(const std::string& type, int milliseconds) {
  const auto last = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
  while (std::chrono::steady_clock::now() < last) {
    const auto message = socket_->read(milliseconds);
    if (!message) return std::nullopt;
    if (!message->starts_with('{')) continue;
    Json json = Json::parse(*message);
    if (json.at("type") == type) return json;
  }
  return std::nullopt;
}

std::optional<std::string> TestPage::nextBinary(int milliseconds) {
  while (auto message = socket_->read(milliseconds)) {
    if (!message->starts_with('{')) return message;
  }
  return std::nullopt;
}

int TestPage::closeCode(int milliseconds) {
  const auto last = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
  while (!socket_->closed && std::chrono::steady_clock::now() < last) {
    static_cast<void>(socket_->read(milliseconds));
  }
  return socket_->closed;
}

void TestPage::vanish() { beast::get_lowest_layer(socket_->stream).close(); }

}  // namespace stroma::viewer
