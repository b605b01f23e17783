#pragma once
/// `ssphh broker`: passes requests of clients to workers until it is stopped.

#include <functional>

#include "options/broker_settings.h"

namespace ssphh::app {

/// Who runs a broker is told, on the thread that does. All may be empty.
struct BrokerCalls {
  /// It listens, at its endpoint(). From now on anyone may stop() or reload() it.
  std::function<void(majordomo::Broker&)> ready = {};
  /// It is about to be gone, because it was stopped or failed: nobody may use it from now on. Must not throw.
  std::function<void()> ended = {};
  /// An event; without it they go to the log.
  majordomo::BrokerEventSink event = {};
};

/// Serves until the broker that `calls.ready` is given is stopped. Throws Error for keys that cannot be read,
/// as majordomo::Broker does, and what `calls.ready` throws.
void run_broker(const BrokerSettings& settings, const BrokerCalls& calls);

}  // namespace ssphh::app
