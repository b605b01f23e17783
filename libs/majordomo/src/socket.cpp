#include "socket.h"

#include <chrono>

#include <sys/eventfd.h>
#include <unistd.h>

#include <ssphh/core/error.h>
#include <ssphh/core/happens_before.h>

namespace ssphh::majordomo {
namespace {

constexpr int heartbeat_interval = 1000;
constexpr std::size_t copy_below = 64 << 10;
constexpr std::size_t usual_frames = 8;
constexpr std::size_t peer_frame_bytes = std::size_t{1} << 30;
constexpr Millis cancel_linger = 500, leave_linger = 2000;

void release(void*, void* hint) {
  happens_after(hint);
  delete static_cast<Body*>(hint);
}

zmq::message_t message_of(const Frame& frame, const Body& owner) {
  if (!owner || frame.size() < copy_below) return zmq::message_t(frame.data(), frame.size());
  auto* const hint = new Body(owner);
  happens_before(hint);  // ZeroMQ's thread releases it
  return zmq::message_t(const_cast<char*>(frame.data()), frame.size(), release, hint);
}

}  // namespace

Millis steady_now() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

void set_common_options(zmq::socket_t& socket, std::size_t frame_bytes, Millis linger, Millis timeout) {
  socket.set(zmq::sockopt::linger, static_cast<int>(linger));
  socket.set(zmq::sockopt::heartbeat_ivl, heartbeat_interval);
  socket.set(zmq::sockopt::heartbeat_timeout, static_cast<int>(timeout));
  socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(frame_bytes));
}

zmq::socket_t peer_socket(zmq::context_t& context, Side side, const std::optional<PeerSecurity>& security) {
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  set_common_options(socket, peer_frame_bytes, side == Side::client ? cancel_linger : leave_linger);
  if (security) {
    socket.set(zmq::sockopt::curve_serverkey, security->broker_key);
    socket.set(zmq::sockopt::curve_publickey, security->keys.public_key);
    socket.set(zmq::sockopt::curve_secretkey, security->keys.secret_key);
  }
  return socket;
}

void connect(zmq::socket_t& socket, const std::string& endpoint, bool secure) {
  require_keys(endpoint, secure, "broker endpoint");
  try {
    socket.connect(endpoint);
  } catch (const zmq::error_t& e) {
    throw Error(endpoint, std::string("cannot connect: ") + e.what(), "write tcp://HOST:PORT or ipc://PATH");
  }
}

Sent send_message(zmq::socket_t& socket, const std::string* identity, const Frames& head, const Body& body) {
  const std::size_t frames = head.size() + (body ? body->size() : 0);
  std::size_t left = frames;
  const auto flags = [&](std::size_t after) {
    return after > 0 ? zmq::send_flags::dontwait | zmq::send_flags::sndmore : zmq::send_flags::dontwait;
  };
  try {
    // With ROUTER_MANDATORY the first frame decides; the later ones of a message cannot fail.
    if (identity && !socket.send(zmq::buffer(*identity), flags(left))) return Sent::full;
    for (const Frame& frame : head)
      if (!socket.send(zmq::message_t(frame.data(), frame.size()), flags(--left))) return Sent::full;
    if (body)
      for (const Frame& frame : *body)
        if (!socket.send(message_of(frame, body), flags(--left))) return Sent::full;
    return Sent::yes;
  } catch (const zmq::error_t& e) {
    if (e.num() == EHOSTUNREACH) return Sent::unreachable;
    throw;
  }
}

std::optional<Received> receive_message(zmq::socket_t& socket, std::size_t max_frames) {
  Received received;
  zmq::message_t part;
  if (!socket.recv(part, zmq::recv_flags::dontwait)) return std::nullopt;
  while (true) {
    if (received.frames.size() <= max_frames) received.frames.push_back(part.to_string());
    if (!part.more()) return received;
    (void)socket.recv(part, zmq::recv_flags::none);  // the rest of a message is there at once
  }
}

std::optional<Routed> receive_routed(zmq::socket_t& router, std::size_t max_frames, bool want_user) {
  Routed received;
  zmq::message_t part;
  if (!router.recv(part, zmq::recv_flags::dontwait)) return std::nullopt;
  received.peer = part.to_string();
  received.frames.reserve(usual_frames);
  while (part.more()) {
    (void)router.recv(part, zmq::recv_flags::none);  // the rest of a message is there at once
    if (received.fd < 0) {
      received.fd = zmq_msg_get(part.handle(), ZMQ_SRCFD);
      const char* const user = want_user ? zmq_msg_gets(part.handle(), "User-Id") : nullptr;
      if (user) received.user = user;
    }
    if (received.frames.size() <= max_frames) received.frames.push_back(part.to_string());
  }
  return received;
}

Wakeup::Wakeup() : fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (fd_ < 0) throw Error("eventfd", "the system gives none", "raise the limit of open files");
}

Wakeup::~Wakeup() {
  ::close(fd_);
}

void Wakeup::notify() noexcept {
  const std::uint64_t one = 1;
  (void)!::write(fd_, &one, sizeof one);
}

void Wakeup::clear() noexcept {
  std::uint64_t count = 0;
  (void)!::read(fd_, &count, sizeof count);
}

std::string random_name() {
  return RequestId::random().hex().substr(0, 12);
}

}  // namespace ssphh::majordomo
