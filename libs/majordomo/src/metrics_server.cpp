#include "metrics_server.h"

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/majordomo/security.h>

#include "socket.h"

namespace ssphh::majordomo {
namespace {

constexpr std::size_t request_bytes = 8192, connections = 256;

}  // namespace

MetricsServer::MetricsServer(zmq::context_t& context, const std::string& bind)
    : socket_(context, zmq::socket_type::stream) {
  require_port(bind, "--metrics");
  socket_.set(zmq::sockopt::linger, 0);
  try {
    socket_.bind(bind);
  } catch (const zmq::error_t& e) {
    throw Error(bind, std::string("cannot bind the metrics: ") + e.what(), "choose another port");
  }
  endpoint_ = socket_.get(zmq::sockopt::last_endpoint);
}

void MetricsServer::serve(const std::function<std::string()>& text) {
  while (const auto received = receive_message(socket_)) {
    if (received->frames.size() != 2) continue;
    const std::string& peer = received->frames[0];
    if (received->frames[1].empty()) {  // connected, or gone
      if (requests_.erase(peer) == 0 && requests_.size() < connections) requests_.emplace(peer, "");
      continue;
    }
    const auto found = requests_.find(peer);
    if (found != requests_.end()) found->second += received->frames[1];
    const bool whole = found != requests_.end() && found->second.find("\r\n\r\n") != std::string::npos;
    if (found != requests_.end() && !whole && found->second.size() < request_bytes) continue;
    std::string status = "400 Bad Request", body;
    if (whole && found->second.starts_with("GET /metrics ")) {
      status = "200 OK";
      body = text();
    } else if (whole) {
      status = "404 Not Found";
    }
    const std::string reply = fmt::format(
        "HTTP/1.1 {}\r\nContent-Type: text/plain; version=0.0.4\r\nContent-Length: {}\r\n"
        "Connection: close\r\n\r\n{}",
        status, body.size(), body);
    try {
      send_message(socket_, &peer, {reply}, nullptr);
      send_message(socket_, &peer, {Frame()}, nullptr);  // closes
    } catch (const zmq::error_t&) {
      // gone before it had its answer
    }
    if (found != requests_.end()) requests_.erase(found);
  }
}

}  // namespace ssphh::majordomo
