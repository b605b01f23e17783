#include "zap.h"

#include <ssphh/core/log.h>

namespace ssphh::majordomo {

Zap::Zap(zmq::context_t& context, const AllowList& allowed) : socket_(context, zmq::socket_type::rep) {
  allow(allowed);
  socket_.set(zmq::sockopt::linger, 0);
  socket_.bind("inproc://zeromq.zap.01");
  thread_ = std::thread([this] { serve(); });
}

void Zap::allow(const AllowList& allowed) {
  std::unordered_map<std::string, std::string> keys;
  for (const AllowedKey& entry : allowed) {
    std::string raw(32, '\0');
    zmq_z85_decode(reinterpret_cast<std::uint8_t*>(raw.data()), entry.public_key.c_str());
    keys[raw] = entry.public_key;
  }
  const std::lock_guard lock(mutex_);
  keys_ = std::move(keys);
}

Zap::~Zap() {
  ended_ = true;
  end_.notify();
  thread_.join();
}

void Zap::serve() {
  while (!ended_) {
    zmq::pollitem_t items[] = {{socket_.handle(), 0, ZMQ_POLLIN, 0}, {nullptr, end_.fd(), ZMQ_POLLIN, 0}};
    try {
      zmq::poll(items, 2, std::chrono::milliseconds(-1));
      while (const auto request = receive_message(socket_)) answer(request->frames);
    } catch (const zmq::error_t& e) {
      if (e.num() != EINTR) return;
    }
  }
}

// Frames: version, request id, domain, address, identity, mechanism, credentials.
void Zap::answer(const Frames& request) {
  const bool curve = request.size() == 7 && request[0] == "1.0" && request[5] == "CURVE";
  std::string key;
  {
    const std::lock_guard lock(mutex_);
    const auto found = curve ? keys_.find(request[6]) : keys_.end();
    if (found != keys_.end()) key = found->second;
  }
  if (key.empty())
    log_warning("connection-refused address={} reason=\"key is not in the allow-list\"",
                request.size() > 3 ? request[3] : "");
  const Frames reply = {"1.0",
                        request.size() > 1 ? request[1] : Frame(),
                        key.empty() ? "400" : "200",
                        key.empty() ? "unknown key" : "OK",
                        key,
                        ""};
  send_message(socket_, nullptr, reply, nullptr);
}

}  // namespace ssphh::majordomo
