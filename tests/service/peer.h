#pragma once
/// Raw peers of 7/MDP and 18/MDP for the conformance probe: frames as the RFCs write them, nothing shared
/// with the broker under test.

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <zmq.hpp>

namespace ssphh::probe {

using Frames = std::vector<std::string>;
using Milliseconds = std::chrono::milliseconds;

inline const Frames heartbeat01 = {"", "MDPW01", "\x04"}, heartbeat02 = {"MDPW02", "\x05"};
inline const Frames disconnect01 = {"", "MDPW01", "\x05"}, disconnect02 = {"MDPW02", "\x06"};

class Peer {
 public:
  explicit Peer(const std::string& endpoint)
      : socket_(context_, zmq::socket_type::dealer), monitor_(context_, zmq::socket_type::pair) {
    socket_.set(zmq::sockopt::linger, 100);
    socket_.set(zmq::sockopt::sndhwm, 0);
    socket_.set(zmq::sockopt::rcvhwm, 0);
    socket_.set(zmq::sockopt::reconnect_ivl, 10);
    zmq_socket_monitor(socket_.handle(), "inproc://connected", ZMQ_EVENT_HANDSHAKE_SUCCEEDED);
    monitor_.connect("inproc://connected");
    socket_.connect(endpoint);
  }

  /// Whether there is a connection, once; messages sent until then travel on it now.
  bool connected(Milliseconds timeout = Milliseconds(10'000)) {
    zmq::pollitem_t item{monitor_.handle(), 0, ZMQ_POLLIN, 0};
    return zmq::poll(&item, 1, timeout) > 0;
  }

  void send(const Frames& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i)
      socket_.send(zmq::buffer(frames[i]),
                   i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }
  /// The next message; empty when none comes in time.
  Frames receive(Milliseconds timeout = Milliseconds(2000)) {
    zmq::pollitem_t item{socket_.handle(), 0, ZMQ_POLLIN, 0};
    if (zmq::poll(&item, 1, timeout) == 0) return {};
    Frames frames;
    zmq::message_t part;
    do {
      if (!socket_.recv(part)) return {};
      frames.push_back(part.to_string());
    } while (part.more());
    return frames;
  }
  /// The next message that is no HEARTBEAT.
  Frames receive_command(Milliseconds timeout = Milliseconds(2000)) {
    const auto end = std::chrono::steady_clock::now() + timeout;
    while (true) {
      const auto left = std::chrono::duration_cast<Milliseconds>(end - std::chrono::steady_clock::now());
      if (left.count() <= 0) return {};
      Frames frames = receive(left);
      if (frames != heartbeat01 && frames != heartbeat02) return frames;
    }
  }

 private:
  zmq::context_t context_;
  zmq::socket_t socket_, monitor_;
};

inline Frames join(Frames head, const Frames& body) {
  head.insert(head.end(), body.begin(), body.end());
  return head;
}
inline Frames request01(const std::string& service, const Frames& body) {
  return join({"", "MDPC01", service}, body);
}
inline Frames request02(const std::string& service, const Frames& body) {
  return join({"MDPC02", "\x01", service}, body);
}

/// A worker of 0.1 that has said READY.
class Worker01 : public Peer {
 public:
  Worker01(const std::string& endpoint, const std::string& service) : Peer(endpoint) {
    send({"", "MDPW01", "\x01", service});
  }
  /// Waits for a REQUEST; false when none comes.
  bool job(Milliseconds timeout = Milliseconds(2000)) {
    const Frames frames = receive_command(timeout);
    if (frames.size() < 6 || frames[1] != "MDPW01" || frames[2] != "\x02" || !frames[4].empty()) return false;
    address = frames[3];
    body.assign(frames.begin() + 5, frames.end());
    return true;
  }
  void reply(const Frames& content) { send(join({"", "MDPW01", "\x03", address, ""}, content)); }

  std::string address;
  Frames body;
};

class Worker02 : public Peer {
 public:
  Worker02(const std::string& endpoint, const std::string& service) : Peer(endpoint) {
    send({"MDPW02", "\x01", service});
  }
  bool job(Milliseconds timeout = Milliseconds(2000)) {
    const Frames frames = receive_command(timeout);
    if (frames.size() < 5 || frames[0] != "MDPW02" || frames[1] != "\x02" || !frames[3].empty()) return false;
    address = frames[2];
    body.assign(frames.begin() + 4, frames.end());
    return true;
  }
  void partial(const Frames& content) { send(join({"MDPW02", "\x03", address, ""}, content)); }
  void final(const Frames& content) { send(join({"MDPW02", "\x04", address, ""}, content)); }

  std::string address;
  Frames body;
};

inline void pause(int milliseconds) {
  std::this_thread::sleep_for(Milliseconds(milliseconds));
}

/// Whether mmi.service tells this status of a service, within so many tries.
inline bool mmi_status(const std::string& endpoint, const std::string& service, const std::string& status,
                       int tries = 1) {
  Peer client(endpoint);
  for (; tries > 0; --tries) {
    client.send(request01("mmi.service", {service}));
    if (client.receive() == Frames{"", "MDPC01", "mmi.service", status}) return true;
    pause(20);
  }
  return false;
}

}  // namespace ssphh::probe
