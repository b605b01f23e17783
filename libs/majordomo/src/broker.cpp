#include <algorithm>
#include <atomic>
#include <cstring>

#include <poll.h>

#include <ssphh/core/error.h>
#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/broker_core.h>

#include "gate.h"
#include "metrics_server.h"
#include "outbox.h"
#include "socket.h"
#include "store.h"
#include "timers.h"

namespace ssphh::majordomo {
namespace {

constexpr int batch = 256;  // messages between two looks at clock and outbox
// While there is always something to hear: rounds between two looks at connections, signals and metrics.
constexpr int rounds_between_looks = 16;
constexpr Millis outbox_pause = 5;  // between two tries for slow peers
constexpr Millis linger = 1000;
constexpr Millis look_at_allow_list = 1000;

std::array<std::uint64_t, 2> system_random() {
  const RequestId id = RequestId::random();
  return {id.high, id.low};
}

}  // namespace

struct Broker::Impl {
  Impl(BrokerOptions&& o, BrokerEventSink&& sink)
      : options(std::move(o)),
        on_event(std::move(sink)),
        store(options.store.empty() ? nullptr : std::make_unique<Store>(options.store)),
        core(options.limits, options.timers, system_random, store != nullptr),
        outbox(options.limits.outbox_bytes) {
    core.set_least_event(options.least_event);
    require_keys(options.bind, options.security.has_value(), "--bind");
    if (options.timers.worker_expiry < 3 * options.timers.heartbeat)
      throw Error("worker expiry", "is shorter than three heartbeats",
                  "the guide's workers beat every 2500 ms: at least 7500 ms with them");
    require(options.drain >= 0 && options.drain <= most_millis, "drain", "is under 0 or over most_millis");
    require_pause(options.connection_timeout, "connection timeout", "must be 1 ms or more");
    if (options.security)
      require_keys_of("broker", {options.security->keys.public_key, options.security->keys});
    if (options.security) gate = std::make_unique<Gate>(context, *options.security);
    open();
    if (!options.metrics_bind.empty())
      metrics = std::make_unique<MetricsServer>(context, options.metrics_bind);
    core.tick(steady_now());  // its time begins here
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
    monitor.set(zmq::sockopt::rcvhwm, 0);
    monitor.connect(name);
    try {
      router.bind(options.bind);
    } catch (const zmq::error_t& e) {
      throw Error(options.bind, std::string("cannot bind: ") + e.what(),
                  e.num() == EADDRINUSE ? "does another broker run there? Port 0 finds a free one"
                                        : "write tcp://ADDRESS:PORT or ipc://PATH");
    }
    endpoint = router.get(zmq::sockopt::last_endpoint);
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
      connections.erase(peer);
      outbox.forget(peer);
      core.peer_gone(steady_now(), peer);
    }
  }

  /// Hears at most a batch; whether there was anything.
  bool receive() {
    static const Rights plain;
    const Millis now = steady_now();
    for (int i = 0; i < batch; ++i) {
      auto received = receive_routed(router, options.limits.message_frames, gate != nullptr);
      if (!received) return i > 0;
      const std::string& peer = received->peer;
      const auto known = connections.find(peer);
      if (received->fd >= 0 && (known == connections.end() || known->second.fd != received->fd)) {
        // A new connection: whoever had its descriptor, or its name, before is gone, and the monitor knew
        // first.
        hear_monitor();
        connections[peer] = {received->fd, received->user};
        peer_of[received->fd] = peer;
      }
      const Rights* const rights = gate ? gate->rights(received->user) : &plain;
      if (rights) {
        core.receive(now, peer, std::move(received->frames), *rights);
      } else {
        core.dropped(now, peer, "key was withdrawn");
      }
    }
    return true;
  }

  void follow_allow_list(Millis now) {
    const bool asked = reloads.exchange(false);
    if (!asked && now < look_at) return;
    look_at = now + look_at_allow_list;
    if (!gate->follows_a_file() || (!asked && !gate->file_changed())) return;
    const auto rights_of = [this](const Connection& connection) {
      const Rights* const rights = gate->rights(connection.key);
      return rights ? std::optional(*rights) : std::nullopt;
    };
    std::unordered_map<std::string, std::optional<Rights>> before;
    for (const auto& [peer, connection] : connections) before[peer] = rights_of(connection);
    tell(gate->reload());
    for (const auto& [peer, rights] : before)
      if (rights_of(connections.at(peer)) != rights) core.revoke(now, peer);
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
      for (const std::string& peer : lost) core.peer_gone(steady_now(), peer);
      if (out.messages.empty() && lost.empty()) return;
    }
  }

  void tell(const BrokerEvent& event) const {
    if (on_event) {
      on_event(event);
    } else {
      log(event.level, event.text());
    }
  }

  /// One round: hear, do what is due, send. Waits only when there was nothing to hear, for ZeroMQ's
  /// descriptors tell of a message once, and sending may swallow that.
  void step(Millis longest) {
    if (!receive()) {
      wait(longest);
    } else if (++busy_rounds % rounds_between_looks == 0) {
      wait(0);
    }
    const Millis now = steady_now();
    core.tick(now);
    if (gate) follow_allow_list(now);
    const bool retry = !outbox.empty() && now >= retry_at;
    if (retry) retry_at = now + outbox_pause;
    flush(retry);
  }

  void wait(Millis longest) {
    if (gate && gate->follows_a_file()) longest = std::min(longest, look_at_allow_list);
    if (!outbox.empty()) longest = std::min(longest, outbox_pause);
    const Millis timeout =
        std::clamp<Millis>(std::min(core.next_deadline() - steady_now(), longest), 0, 60'000);
    ::pollfd items[] = {{router.get(zmq::sockopt::fd), POLLIN, 0},
                        {monitor.get(zmq::sockopt::fd), POLLIN, 0},
                        {wakeup.fd(), POLLIN, 0},
                        {metrics ? metrics->socket().get(zmq::sockopt::fd) : -1, POLLIN, 0}};
    if (::poll(items, 4, static_cast<int>(timeout)) <= 0) return;  // a signal is as good as a timeout
    if (items[1].revents) hear_monitor();
    if (items[2].revents) wakeup.clear();
    if (items[3].revents) metrics->serve([this] { return core.metrics_text(); });
  }

  void run() {
    while (stops == 0) step(60'000);
    core.drain(steady_now());
    flush(false);  // nothing else may come for a long time
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
  const BrokerEventSink on_event;
  std::unique_ptr<Store> store;
  BrokerCore core;
  Outbox outbox;
  zmq::context_t context;
  std::unique_ptr<Gate> gate;  // null: plain
  std::unique_ptr<MetricsServer> metrics;
  zmq::socket_t router, monitor;
  std::string endpoint;  // a socket may be asked by the thread of run() alone
  Wakeup wakeup;
  struct Connection {
    int fd = -1;
    std::string key;  ///< public key; empty for plain connections
  };
  std::unordered_map<std::string, Connection> connections;  // by peer
  std::unordered_map<int, std::string> peer_of;
  Millis retry_at = 0, look_at = 0;
  std::uint64_t busy_rounds = 0;
  std::atomic<int> stops{0};
  std::atomic<bool> reloads{false};
};

Broker::Broker(BrokerOptions options, BrokerEventSink on_event)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(on_event))) {}
Broker::~Broker() = default;

std::string Broker::endpoint() const {
  return impl_->endpoint;
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

void Broker::reload() noexcept {
  impl_->reloads = true;
  impl_->wakeup.notify();
}

}  // namespace ssphh::majordomo
