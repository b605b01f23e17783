#pragma once
/// The Majordomo broker on a socket: BrokerCore, a ROUTER, and optionally a store, keys and a metrics
/// endpoint.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <ssphh/majordomo/event.h>
#include <ssphh/majordomo/frames.h>
#include <ssphh/majordomo/limits.h>
#include <ssphh/majordomo/security.h>

namespace ssphh::majordomo {

struct BrokerOptions {
  std::string bind = "tcp://127.0.0.1:5555";    ///< tcp port 0 or *: any free one, told by endpoint()
  std::string metrics_bind = {};                ///< tcp endpoint for Prometheus (GET /metrics); empty: none
  std::optional<BrokerSecurity> security = {};  ///< wanted unless is_local_endpoint(bind)
  std::filesystem::path store = {};             ///< folder of the store; empty: nothing survives a restart
  BrokerLimits limits = {};
  BrokerTimers timers = {};
  /// A connection that answers no ZMTP heartbeat for so long is closed. A foreign client that stops reading a
  /// full queue answers none either: shorter finds dead links sooner, longer is kinder to slow readers.
  Millis connection_timeout = 6000;
  Millis drain = 10'000;  ///< how long stop() waits for requests that are running
  /// Lesser events are not made; `debug` tells every job.
  LogLevel least_event = LogLevel::info;
};

/// Is told every event (docs/protocol.md lists them) on the thread of run().
using BrokerEventSink = std::function<void(const BrokerEvent&)>;

class Broker {
 public:
  /// Binds. Events go to `on_event`, where that is empty to core's log. Throws Error when the endpoint is
  /// taken, not local without keys, or the store cannot be opened.
  explicit Broker(BrokerOptions options, BrokerEventSink on_event = {});
  ~Broker();
  Broker(const Broker&) = delete;
  Broker& operator=(const Broker&) = delete;

  /// What was bound, with the port that was found. From any thread, also while run() serves.
  std::string endpoint() const;
  /// The endpoint of the metrics; empty when there is none. From any thread.
  std::string metrics_endpoint() const;
  /// Serves until stop(); then takes no new requests, waits for running ones for at most `drain`, tells the
  /// workers and returns. Throws Error when the store fails.
  void run();
  /// From any thread and from signal handlers; the second call ends the waiting.
  void stop() noexcept;
  /// Reads the allow-list again (as run() does by itself when the file has changed). Peers whose key is gone
  /// or has other roles are cut off: their jobs run elsewhere, their requests are dropped after the grace. A
  /// list that cannot be read changes nothing and is logged. From any thread and from signal handlers.
  void reload() noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ssphh::majordomo
