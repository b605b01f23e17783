#pragma once
/// GET /metrics over HTTP/1.1 on a ZeroMQ STREAM socket: what Prometheus scrapes, and nothing else.

#include <functional>
#include <string>
#include <unordered_map>

#include <zmq.hpp>

namespace ssphh::majordomo {

class MetricsServer {
 public:
  /// Throws Error when the endpoint cannot be bound.
  MetricsServer(zmq::context_t& context, const std::string& bind);
  zmq::socket_t& socket() { return socket_; }
  const std::string& endpoint() const { return endpoint_; }
  /// Answers what has arrived; `text` gives the metrics.
  void serve(const std::function<std::string()>& text);

 private:
  zmq::socket_t socket_;
  std::string endpoint_;
  std::unordered_map<std::string, std::string> requests_;  ///< bytes so far, by connection
};

}  // namespace ssphh::majordomo
