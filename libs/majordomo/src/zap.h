#pragma once
/// Lets in the CURVE keys of an allow-list (ZeroMQ RFC 27/ZAP) and gives each connection its public key as
/// User-Id.

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>

#include <zmq.hpp>

#include <ssphh/majordomo/security.h>

#include "socket.h"

namespace ssphh::majordomo {

/// A thread on inproc://zeromq.zap.01 of the context; must exist before the first socket is bound.
class Zap {
 public:
  Zap(zmq::context_t& context, const AllowList& allowed);
  ~Zap();
  Zap(const Zap&) = delete;
  Zap& operator=(const Zap&) = delete;

  /// From now on these keys. Connections that are open stay open.
  void allow(const AllowList& allowed);

 private:
  void serve();
  void answer(const Frames& request);

  std::mutex mutex_;
  std::unordered_map<std::string, std::string> keys_;  ///< Z85 text by raw key
  zmq::socket_t socket_;
  Wakeup end_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace ssphh::majordomo
