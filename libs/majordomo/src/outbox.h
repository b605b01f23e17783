#pragma once
/// What could not be sent yet, per peer: ROUTER would drop it silently at its high-water mark.

#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

#include <zmq.hpp>

#include <ssphh/majordomo/broker_core.h>

#include "socket.h"

namespace ssphh::majordomo {

class Outbox {
 public:
  /// `limit`: bytes that may wait for one peer.
  explicit Outbox(std::size_t limit) : limit_(limit) {}

  /// Sends, or keeps. Adds the peer to `lost` when it is unreachable or too slow.
  void send(zmq::socket_t& socket, Outgoing&& message, std::vector<std::string>& lost);
  /// Tries again what waits.
  void flush(zmq::socket_t& socket, std::vector<std::string>& lost);
  void forget(const std::string& peer) { waiting_.erase(peer); }
  bool empty() const { return waiting_.empty(); }

 private:
  struct Queue {
    std::deque<Outgoing> messages;
    std::size_t bytes = 0;
  };
  std::size_t limit_;
  std::unordered_map<std::string, Queue> waiting_;
};

}  // namespace ssphh::majordomo
