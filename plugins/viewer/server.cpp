// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/server.h"

#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <random>

#include "plugins/viewer/frame_encoder.h"
#include "plugins/viewer/json_text.h"
#include "plugins/viewer/watcher.h"

namespace stroma::viewer {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using Json = nlohmann::json;

constexpr int mostConnections = 64;
constexpr std::uint32_t longestHeader = 8 * 1024;
constexpr auto patience = std::chrono::seconds(10);

std::string randomToken() {
  std::random_device source;
  std::string token;
  for (int i = 0; i < 4; ++i) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::uint32_t bits = source();
    for (int k = 0; k < 8; ++k, bits >>= 4) token += digits[bits & 15u];
  }
  return token;
}

// Takes the same time wherever the two differ.
bool isSame(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0u : 1u;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return difference == 0;
}

// The value of NAME in "a=1&NAME=value" or "a=1; NAME=value".
std::string_view valueOf(std::string_view list, std::string_view name, char separator) {
  while (!list.empty()) {
    const std::size_t end = list.find(separator);
    std::string_view part = list.substr(0, end);
    while (part.starts_with(' ')) part.remove_prefix(1);
    if (part.starts_with(name) && part.substr(name.size()).starts_with('=')) {
      return part.substr(name.size() + 1);
    }
    if (end == std::string_view::npos) break;
    list.remove_prefix(end + 1);
  }
  return {};
}

Bytes bytesOf(std::string text) { return std::make_shared<const std::string>(std::move(text)); }
Bytes bytesOf(const Json& json) { return bytesOf(dumped(json)); }

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

// One connection until it has become a WebSocket or is closed.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Server& server, asio::ip::tcp::socket&& socket)
      : server_(server), stream_(std::move(socket)) {
    ++server_.connections_;
  }
  ~HttpConnection() { --server_.connections_; }

  void read() {
    parser_.emplace();
    parser_->header_limit(longestHeader);
    parser_->body_limit(0);
    stream_.expires_after(patience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code failure, std::size_t) {
                       if (!failure) return self->respond();
                       if (failure == http::error::end_of_stream) return;
                       // what is no HTTP gets one answer, as far as it can still be sent
                       if (failure.category() == http::make_error_code(http::error{}).category()) {
                         self->send(http::status::bad_request, "400: not a request\n");
                       }
                     });
  }

 private:
  void respond() {
    const auto& request = parser_->get();
    const std::string_view target = view(request.target());
    const std::size_t mark = target.find('?');
    const std::string_view path = target.substr(0, mark);
    const std::string_view query =
        mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
    const std::string_view host = view(request[http::field::host]);
    const std::string_view origin = view(request[http::field::origin]);
    const bool foreign =
        !server_.isKnownHost(host) || (!origin.empty() && origin != "http://" + std::string(host));
    if (foreign || !server_.hasToken(query, view(request[http::field::cookie]))) {
      return send(http::status::forbidden, "403: the address with its token is needed\n");
    }
    if (path == "/socket" && beast::websocket::is_upgrade(request)) {
      auto watcher = std::make_shared<Watcher>(server_, std::move(stream_));
      return watcher->accept(parser_->release());
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return send(http::status::method_not_allowed, "405: GET only\n");
    }
    const PageFile* file = server_.page_.find(path);
    if (!file) return send(http::status::not_found, "404: the page has no such part\n");
    send(http::status::ok, file->bytes, file->type);
  }

  void send(http::status status, std::string_view body, std::string_view type = "text/plain") {
    const bool parsed = parser_->is_done();
    const unsigned version = parsed ? parser_->get().version() : 11;
    response_ = http::response<http::string_body>(status, version);
    response_.set(http::field::server, "stroma");
    response_.set(http::field::content_type, std::string(type));
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Content-Security-Policy",
                  "default-src 'self'; connect-src 'self'; img-src 'self' data: blob:; "
                  "media-src 'self' blob:; style-src 'self' 'unsafe-inline'; frame-ancestors "
                  "'none'");
    if (status == http::status::ok) {
      response_.set(http::field::set_cookie, "stroma-" + std::to_string(server_.port_) + "=" +
                                                 server_.settings_.token +
                                                 "; HttpOnly; SameSite=Strict; Path=/");
    }
    response_.keep_alive(parsed && parser_->get().keep_alive() && status == http::status::ok);
    response_.body() = std::string(body);
    response_.prepare_payload();
    if (parsed && parser_->get().method() == http::verb::head) response_.body().clear();
    stream_.expires_after(patience);
    http::async_write(
        stream_, response_, [self = shared_from_this()](error_code failure, std::size_t) {
          if (failure) return;
          if (self->response_.keep_alive()) return self->read();
          error_code ignored;
          self->stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
        });
  }

  Server& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{longestHeader + 1024};
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::string_body> response_;
};

Server::Server(ServerSettings settings, PageBundle page)
    : settings_(std::move(settings)), page_(std::move(page)), acceptor_(context_) {
  if (settings_.token.empty()) settings_.token = randomToken();
}

Server::~Server() {
  asio::post(context_, [this] { context_.stop(); });
}

std::optional<ServerProblem> Server::open() {
  error_code failure;
  const auto address = asio::ip::make_address(settings_.address, failure);
  if (failure) return ServerProblem{"is not an IP address", true};
  const Tcp::endpoint end(address, static_cast<unsigned short>(settings_.port));
  acceptor_.open(end.protocol(), failure);
  if (!failure) acceptor_.set_option(asio::socket_base::reuse_address(true), failure);
  if (!failure) acceptor_.bind(end, failure);
  if (failure) {
    const bool ofAddress = failure == asio::error::address_family_not_supported ||
                           failure == boost::system::errc::address_not_available;
    return ServerProblem{"cannot listen at " + settings_.address + ":" +
                             std::to_string(settings_.port) + ": " + failure.message(),
                         ofAddress};
  }
  acceptor_.listen(asio::socket_base::max_listen_connections, failure);
  if (failure) return ServerProblem{"cannot listen: " + failure.message(), false};
  port_ = acceptor_.local_endpoint(failure).port();
  accept();
  thread_ = std::jthread([this] { context_.run(); });
  return std::nullopt;
}

void Server::accept() {
  acceptor_.async_accept([this](error_code failure, Tcp::socket socket) {
    if (!acceptor_.is_open()) return;
    if (!failure && connections_ < mostConnections) {
      std::make_shared<HttpConnection>(*this, std::move(socket))->read();
    }
    accept();
  });
}

// A page of another site that names this machine by a name of its own is turned away.
bool Server::isKnownHost(std::string_view host) const {
  const std::string port = ":" + std::to_string(port_);
  const auto is = [&](const std::string& name) {
    return host == name + port || (port_ == 80 && host == name);
  };
  const bool six = settings_.address.find(':') != std::string::npos;
  return is("localhost") || is("127.0.0.1") || is("[::1]") ||
         is(six ? "[" + settings_.address + "]" : settings_.address) ||
         std::ranges::any_of(settings_.hosts, is);
}

bool Server::hasToken(std::string_view query, std::string_view cookie) const {
  return isSame(valueOf(query, "token", '&'), settings_.token) ||
         isSame(valueOf(cookie, "stroma-" + std::to_string(port_), ';'), settings_.token);
}

void Server::join(const std::shared_ptr<Watcher>& watcher) {
  watcher->id = nextWatcher_++;
  joined_.emplace(watcher->id, watcher);
  watchers_ = static_cast<int>(joined_.size());
  if (steering_ == 0) steering_ = watcher->id;
  watcher->send(bytesOf(Json{{"type", "hello"},
                             {"version", 1},
                             {"program", "stroma"},
                             {"client", watcher->id},
                             {"steers", steering_ == watcher->id}}));
  if (scene_) watcher->send(scene_);
  for (const auto& [body, topology] : topologies_) watcher->send(topology);
  if (diagnostics_) watcher->send(diagnostics_);
  if (frame_) watcher->offer(frame_);
  sendStatusTo(*watcher);
}

void Server::leave(const Watcher& watcher) {
  const std::uint64_t id = watcher.id;
  std::erase_if(tickets_, [&](const auto& ticket) { return ticket.second.first == id; });
  joined_.erase(id);
  watchers_ = static_cast<int>(joined_.size());
  if (steering_ == id) steer(joined_.empty() ? 0 : joined_.begin()->first);
  updateLooks();
}

void Server::steer(std::uint64_t watcher) {
  steering_ = watcher;
  for (const auto& [id, each] : joined_) sendStatusTo(*each);
}

void Server::take(Watcher& from, PageMessage message) {
  using Type = PageMessage::Type;
  const auto reply = [&from, n = message.n](bool done, const char* text) {
    if (n == 0) return;
    from.send(bytesOf(Json{{"type", "answer"}, {"n", n}, {"done", done}, {"text", text}}));
  };
  switch (message.type) {
    case Type::steer:
      steer(from.id);
      return reply(true, "");
    case Type::look:
      if (from.looks.size() > 1000) return reply(false, "too many bodies");
      from.looks[message.body] = {message.text, message.particles};
      updateLooks();
      return reply(true, "");
    case Type::watch:
      from.watches = {message.timing, message.energy};
      updateLooks();
      return reply(true, "");
    default:
      break;
  }
  if (message.steers() && from.id != steering_) return reply(false, "another window steers");
  constexpr std::size_t mostIncoming = 10000;
  Incoming incoming{std::move(message), 0};
  const std::uint64_t n = incoming.message.n;
  const std::scoped_lock lock(mutex_);
  if (incoming_.size() >= mostIncoming) return reply(false, "too many requests wait");
  if (n > 0) {
    incoming.ticket = nextTicket_++;
    tickets_[incoming.ticket] = {from.id, n};
  }
  incoming_.push_back(std::move(incoming));
}

void Server::updateLooks() {
  Looks looks;
  Watches watches;
  for (const auto& [id, watcher] : joined_) {
    for (const auto& [body, look] : watcher->looks) {
      if (!look.first.empty()) looks.fields[body].insert(look.first);
      if (look.second) looks.particles.insert(body);
    }
    watches.timing |= watcher->watches.timing;
    watches.energy |= watcher->watches.energy;
  }
  {
    const std::scoped_lock lock(mutex_);
    looks_ = std::move(looks);
    watches_ = watches;
  }
  ++looksRevision_;
}

Looks Server::looks() const {
  const std::scoped_lock lock(mutex_);
  return looks_;
}

Server::Watches Server::watches() const {
  const std::scoped_lock lock(mutex_);
  return watches_;
}

std::vector<Incoming> Server::takeMessages() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(incoming_, {});
}

void Server::spread(const Bytes& text) {
  for (const auto& [id, watcher] : joined_) watcher->send(text);
}

void Server::sendScene(std::string json) {
  asio::post(context_, [this, text = bytesOf(std::move(json))] {
    scene_ = text;
    frame_.reset();
    topologies_.clear();
    // bodies have other numbers now: the pages say anew what they look at
    for (const auto& [id, watcher] : joined_) watcher->looks.clear();
    updateLooks();
    spread(text);
  });
}

void Server::sendTopology(std::shared_ptr<const TopologyCopy> topology) {
  asio::post(context_, [this, topology = std::move(topology)] {
    const auto bytes = bytesOf(encode(*topology));
    topologies_[topology->body] = bytes;
    spread(bytes);
    // a frame that is newer than its topology has come before it, and been put aside
    for (const auto& [id, watcher] : joined_) {
      if (frame_) watcher->offer(frame_);
    }
  });
}

void Server::sendDiagnostics(std::string json) {
  asio::post(context_, [this, text = bytesOf(std::move(json))] {
    diagnostics_ = text;
    spread(text);
  });
}

void Server::sendToAll(std::string json) {
  asio::post(context_, [this, text = bytesOf(std::move(json))] { spread(text); });
}

void Server::sendStatusTo(Watcher& watcher) {
  if (!status_.is_object()) return;
  Json own = status_;
  own["steers"] = watcher.id == steering_;
  own["watchers"] = joined_.size();
  watcher.send(bytesOf(own));
}

void Server::sendStatus(Json status) {
  asio::post(context_, [this, status = std::move(status)]() mutable {
    status_ = std::move(status);
    for (const auto& [id, watcher] : joined_) sendStatusTo(*watcher);
  });
}

void Server::answer(std::uint64_t ticket, Json answer) {
  if (ticket == 0) return;
  asio::post(context_, [this, ticket, answer = std::move(answer)]() mutable {
    const auto known = tickets_.find(ticket);
    if (known == tickets_.end()) return;  // the page has gone
    const auto [watcher, n] = known->second;
    tickets_.erase(known);
    const auto to = joined_.find(watcher);
    if (to == joined_.end()) return;
    answer["type"] = "answer";
    answer["n"] = n;
    to->second->send(bytesOf(answer));
  });
}

void Server::sendFrame(FrameCopy& frame) {
  bool wasEmpty = false;
  {
    const std::scoped_lock lock(mutex_);
    std::swap(pending_, frame);
    wasEmpty = !std::exchange(hasPending_, true);
  }
  if (wasEmpty) asio::post(context_, [this] { encodeFrame(); });
}

void Server::encodeFrame() {
  {
    const std::scoped_lock lock(mutex_);
    std::swap(pending_, encoding_);
    hasPending_ = false;
  }
  frame_ = bytesOf(encode(encoding_));
  for (const auto& [id, watcher] : joined_) watcher->offer(frame_);
}

}  // namespace stroma::viewer
