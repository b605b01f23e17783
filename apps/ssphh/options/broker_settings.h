#pragma once
/// What `ssphh broker` may be told, in the units of its options.

#include <string>

#include <ssphh/majordomo/broker.h>

namespace ssphh::app {

struct BrokerSettings {
  majordomo::BrokerOptions broker;                               ///< those that need no conversion
  std::string keys;                                              ///< folder; empty: none
  double worker_expiry = 8, drain = 10, attempt_timeout = 3600;  ///< seconds
  std::uint64_t frame_mb = 64, client_mb = 2048;
  bool verbose = false;
};

/// The broker's own options. Reads the keys.
majordomo::BrokerOptions broker_options(const BrokerSettings& settings);

/// That it listens; `metrics` is the endpoint of its numbers, empty: none.
majordomo::BrokerEvent ready_event(const std::string& endpoint, const std::string& metrics);

}  // namespace ssphh::app
