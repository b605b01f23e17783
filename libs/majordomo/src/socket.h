#pragma once
/// ZeroMQ sockets as this module uses them: never blocking, bounded, with heartbeats of their own.

#include <optional>
#include <string>

#include <zmq.hpp>

#include <ssphh/majordomo/frames.h>
#include <ssphh/majordomo/mdp.h>
#include <ssphh/majordomo/security.h>

namespace ssphh::majordomo {

/// Milliseconds of the steady clock.
Millis steady_now();

/// Options of every socket: ZMTP heartbeats every second, so that the connection of a dead or frozen peer
/// ends after `timeout` whatever its MDP does, a limit on frames, and no waiting at the end but `linger`.
void set_common_options(zmq::socket_t& socket, std::size_t frame_bytes, Millis linger, Millis timeout = 6000);
/// A client's or a worker's socket, to be connected: for frames of up to 1 GiB, and at the end a client waits
/// for half a second until its cancellations are out, a worker two for its result.
zmq::socket_t peer_socket(zmq::context_t& context, Side side, const std::optional<PeerSecurity>& security);

/// Connects. Throws Error for what is no endpoint, and for plain ones beyond this machine.
void connect(zmq::socket_t& socket, const std::string& endpoint, bool secure);

enum class Sent { yes, full, unreachable };
/// Sends identity (unless null), head and body without waiting. Frames of 64 KB and more are not copied.
Sent send_message(zmq::socket_t& socket, const std::string* identity, const Frames& head, const Body& body);

struct Received {
  Frames frames;
};
/// Receives one message without waiting; none when there is none. More than `max_frames` frames are read and
/// thrown away, leaving max_frames + 1.
std::optional<Received> receive_message(zmq::socket_t& socket, std::size_t max_frames = 1024);

/// What a ROUTER knows of a message.
struct Routed {
  std::string peer;  ///< the identity
  Frames frames;
  int fd = -1;       ///< of the connection it came by; −1 when ZeroMQ does not tell
  std::string user;  ///< public CURVE key (what the allow-list let in), if asked for; empty for plain ones
};
/// As receive_message, for a ROUTER; `max_frames` counts those behind the identity.
std::optional<Routed> receive_routed(zmq::socket_t& router, std::size_t max_frames, bool want_user);

/// Wakes a poll from another thread or a signal handler.
class Wakeup {
 public:
  Wakeup();
  ~Wakeup();
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;
  void notify() noexcept;
  void clear() noexcept;
  int fd() const { return fd_; }

 private:
  int fd_;
};

/// A random text of 12 hexadecimal digits for identities and inproc names.
std::string random_name();

}  // namespace ssphh::majordomo
