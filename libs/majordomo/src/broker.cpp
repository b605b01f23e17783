#include <algorithm>
#include <atomic>
#include <cstring>

#include <ssphh/core/error.h>
#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/broker_core.h>

#include "metrics_server.h"
#include "outbox.h"
#include "socket.h"
#include "store.h"
#include "zap.h"

namespace ssphh::majordomo {
namespace {

constexpr int batch = 256;          // messages between two looks at clock and outbox
constexpr Millis outbox_pause = 5;  // between two tries for slow peers
constexpr Millis linger = 1000;

/// Random numbers from the system, fetched many at a time.
class SystemRandom {
 public:
  std::array<std::uint64_t, 2> operator()() {
    if (next_ == pool_.size()) {
      for (RequestId& id : pool_) id = RequestId::random();
      next_ = 0;
    }
    const RequestId& id = pool_[next_++];
    return {id.high, id.low};
  }

 private:
  std::array<RequestId, 64> pool_;
  std::size_t next_ = 64;
};

}  // namespace

struct Broker::Impl {
  explicit Impl(BrokerOptions&& o)
      : options(std::move(o)),
        store(options.store.empty() ? nullptr : std::make_unique<Store>(options.store)),
        core(options.limits, options.timers, SystemRandom(), store != nullptr),
        outbox(options.limits.outbox_bytes) {
    require_keys(options.bind, options.security.has_value(), "--bind");
    if (options.timers.worker_expiry < 7500)
      throw Error("worker expiry", "is shorter than 7500 ms", "the guide's workers beat every 2500 ms");
    if (options.security) {
      zap = std::make_unique<Zap>(context, options.security->allowed);
      for (const AllowedKey& entry : options.security->allowed) rights[entry.rights.name] = entry.rights;
    }
    open();
    if (!options.metrics_bind.empty())
      metrics = std::make_unique<MetricsServer>(context, options.metrics_bind);
    if (store)
      for (StoredRequest& request : store->load()) core.restore(steady_now(), std::move(request));
  }

  void open() {
    router = zmq::socket_t(context, zmq::socket_type::router);
    set_common_options(router, options.limits.frame_bytes, linger, options.connection_timeout);
    router.set(zmq::sockopt::router_mandatory, true);
    if (options.security) {
      router.set(zmq::sockopt::curve_server, true);
      router.set(zmq::sockopt::curve_secretkey, options.security->keys.secret_key);
      router.set(zmq::sockopt::zap_domain, "ssphh");
    }
    const std::string name = "inproc://monitor-" + random_name();
    zmq_socket_monitor(router.handle(), name.c_str(), ZMQ_EVENT_DISCONNECTED);
    monitor = zmq::socket_t(context, zmq::socket_type::pair);
    monitor.set(zmq::sockopt::linger, 0);
    monitor.set(zmq::sockopt::rcvhwm, 0);
    monitor.connect(name);
    try {
      router.bind(options.bind);
    } catch (const zmq::error_t& e) {
      throw Error(options.bind, std::string("cannot bind: ") + e.what(),
                  e.num() == EADDRINUSE ? "does another broker run there? Port 0 finds a free one"
                                        : "write tcp://ADDRESS:PORT or ipc://PATH");
    }
  }

  // ROUTER does not say when a peer goes; its connection's descriptor does.
  void hear_monitor() {
    while (const auto news = receive_message(monitor)) {
      std::int32_t fd = -1;
      if (news->frames[0].size() != 6) continue;
      std::memcpy(&fd, news->frames[0].data() + 2, sizeof fd);
      const auto found = peer_of.find(fd);
      if (found == peer_of.end()) continue;
      const std::string peer = std::move(found->second);
      peer_of.erase(found);
      fd_of.erase(peer);
      outbox.forget(peer);
      core.peer_gone(steady_now(), peer);
    }
  }

  void receive() {
    static const Rights plain;
    for (int i = 0; i < batch; ++i) {
      auto received = receive_message(router, options.limits.message_frames + 1);
      if (!received) return;
      const std::string peer = std::move(received->frames[0]);
      received->frames.erase(received->frames.begin());
      const auto known = fd_of.find(peer);
      if (received->fd >= 0 && (known == fd_of.end() || known->second != received->fd)) {
        // A new connection: whoever had its descriptor, or its name, before is gone, and the monitor knew
        // first.
        hear_monitor();
        fd_of[peer] = received->fd;
        peer_of[received->fd] = peer;
      }
      const auto allowed = rights.find(received->user);
      if (options.security && allowed == rights.end()) continue;  // the handshake lets no such peer in
      core.receive(steady_now(), peer, std::move(received->frames),
                   options.security ? allowed->second : plain);
    }
  }

  void flush(bool retry) {
    while (true) {
      BrokerOutputs out = core.take();
      if (store) store->apply(out.store);
      for (const BrokerEvent& event : out.events) tell(event);
      std::vector<std::string> lost;
      for (Outgoing& message : out.messages) outbox.send(router, std::move(message), lost);
      if (retry) outbox.flush(router, lost);
      retry = false;
      for (const std::string& peer : lost) {
        outbox.forget(peer);
        core.peer_gone(steady_now(), peer);
      }
      if (out.messages.empty() && lost.empty()) return;
    }
  }

  void tell(const BrokerEvent& event) const {
    if (options.on_event) {
      options.on_event(event);
    } else if (event.level != LogLevel::debug) {
      log(event.level, event.text());
    }
  }

  void step(Millis longest) {
    const Millis now = steady_now();
    const Millis wait = std::clamp<Millis>(std::min(core.next_deadline() - now, longest), 0, 60'000);
    zmq::pollitem_t items[] = {{router.handle(), 0, ZMQ_POLLIN, 0},
                               {monitor.handle(), 0, ZMQ_POLLIN, 0},
                               {nullptr, wakeup.fd(), ZMQ_POLLIN, 0},
                               {metrics ? metrics->socket().handle() : nullptr, 0, ZMQ_POLLIN, 0}};
    try {
      zmq::poll(items, metrics ? 4 : 3,
                std::chrono::milliseconds(outbox.empty() ? wait : std::min(wait, outbox_pause)));
    } catch (const zmq::error_t& e) {
      if (e.num() != EINTR) throw;
    }
    if (items[2].revents) wakeup.clear();
    receive();
    if (items[1].revents) hear_monitor();
    if (metrics && items[3].revents) metrics->serve([this] { return core.metrics_text(); });
    const Millis after = steady_now();
    if (core.next_deadline() <= after) core.tick(after);
    const bool retry = !outbox.empty() && after >= retry_at;
    if (retry) retry_at = after + outbox_pause;
    flush(retry);
  }

  void run() {
    core.tick(steady_now());
    flush(false);
    while (stops == 0) step(60'000);
    core.drain(steady_now());
    const Millis end = steady_now() + options.drain;
    while (stops < 2 && !core.drained() && steady_now() < end) step(end - steady_now());
    core.disconnect_workers(steady_now());
    const Millis last = steady_now() + linger;
    do {
      flush(true);
      if (!outbox.empty()) step(outbox_pause);
    } while (!outbox.empty() && steady_now() < last);
    tell({LogLevel::info, "broker-ended", {}});
  }

  BrokerOptions options;
  std::unique_ptr<Store> store;
  BrokerCore core;
  Outbox outbox;
  zmq::context_t context;
  std::unique_ptr<Zap> zap;
  std::unique_ptr<MetricsServer> metrics;
  zmq::socket_t router, monitor;
  Wakeup wakeup;
  std::unordered_map<std::string, Rights> rights;
  std::unordered_map<std::string, int> fd_of;
  std::unordered_map<int, std::string> peer_of;
  Millis retry_at = 0;
  std::atomic<int> stops{0};
};

Broker::Broker(BrokerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Broker::~Broker() = default;

std::string Broker::endpoint() const {
  return impl_->router.get(zmq::sockopt::last_endpoint);
}

std::string Broker::metrics_endpoint() const {
  return impl_->metrics ? impl_->metrics->endpoint() : std::string();
}

void Broker::run() {
  impl_->run();
}

void Broker::stop() noexcept {
  ++impl_->stops;
  impl_->wakeup.notify();
}

}  // namespace ssphh::majordomo
