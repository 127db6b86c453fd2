// SPDX-License-Identifier: Apache-2.0
#include "plugins/viewer/watcher.h"

#include <boost/asio/post.hpp>

namespace stroma::viewer {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

constexpr std::size_t longestMessage = 64 * 1024, longestPicture = 32 * 1024 * 1024;
constexpr int mostMessages = 500;  // a second
// A page that does not take what it is sent is given up when so much waits for it.
constexpr std::size_t mostWaiting = 64 * 1024 * 1024;

}  // namespace

Watcher::Watcher(Server& server, beast::tcp_stream&& stream)
    : server_(server), socket_(std::move(stream)) {
  ++server_.connections_;
}

Watcher::~Watcher() { --server_.connections_; }

void Watcher::accept(Request request) {
  request_ = std::move(request);
  socket_.next_layer().expires_never();
  socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  socket_.read_message_max(server_.settings_.takesPictures ? longestPicture : longestMessage);
  socket_.async_accept(request_, [self = shared_from_this()](error_code failure) {
    if (failure) return;
    self->joined_ = true;
    self->server_.join(self);
    self->read();
  });
}

void Watcher::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](error_code failure, std::size_t bytes) {
    if (!failure) return self->take(bytes);
    // an honest close, a protocol error or a lost connection: the page is gone
    if (self->joined_) self->server_.leave(*self);
    self->joined_ = false;
  });
}

bool Watcher::isTooFast() {
  const auto now = Clock::now();
  if (now - second_ > std::chrono::seconds(1)) {
    second_ = now;
    messagesInSecond_ = 0;
  }
  return ++messagesInSecond_ > mostMessages;
}

void Watcher::take(std::size_t) {
  const std::string_view text(static_cast<const char*>(buffer_.data().data()), buffer_.size());
  PageMessage message;
  std::string problem;
  if (closing_) {
    // the rest of what was on its way
  } else if (isTooFast()) {
    close(websocket::close_code::policy_error, "too many messages");
  } else if (!socket_.got_text()) {
    close(websocket::close_code::unknown_data, "texts only");
  } else if (problem = readMessage(text, message); !problem.empty()) {
    close(websocket::close_code::policy_error, "the message " + problem);
  } else if (message.type == PageMessage::Type::picture && !server_.settings_.takesPictures) {
    close(websocket::close_code::policy_error, "no picture was asked for");
  } else {
    server_.take(*this, std::move(message));
  }
  buffer_.consume(buffer_.size());
  read();
}

void Watcher::send(Bytes text) {
  if (closing_) return;
  waitingBytes_ += text->size();
  waiting_.push_back(std::move(text));
  if (waitingBytes_ > mostWaiting) {
    // it does not read: a closing handshake would wait for it, too
    closing_ = true;
    beast::get_lowest_layer(socket_).cancel();
    beast::get_lowest_layer(socket_).close();
    return;
  }
  writeNext();
}

void Watcher::offer(Bytes frame) {
  if (closing_) return;
  frame_ = std::move(frame);
  writeNext();
}

void Watcher::writeNext() {
  if (writing_ || closing_) return;
  bool isFrame = false;
  if (!waiting_.empty()) {
    writing_ = std::move(waiting_.front());
    waiting_.pop_front();
    waitingBytes_ -= writing_->size();
  } else if (frame_) {
    writing_ = std::move(frame_);
    isFrame = true;
  } else {
    return;
  }
  // JSON begins with a brace, which no kind of a binary message is
  socket_.binary(isFrame || writing_->front() != '{');
  socket_.async_write(boost::asio::buffer(*writing_),
                      [self = shared_from_this()](error_code failure, std::size_t) {
                        self->writing_.reset();
                        if (!failure) self->writeNext();
                      });
}

void Watcher::close(websocket::close_code code, const std::string& reason) {
  if (closing_) return;
  closing_ = true;
  websocket::close_reason why(code);
  why.reason = reason.substr(0, 120);
  socket_.async_close(why, [self = shared_from_this()](error_code) {});
}

}  // namespace stroma::viewer
