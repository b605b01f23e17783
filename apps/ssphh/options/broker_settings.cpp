#include "options/broker_settings.h"

namespace ssphh::app {

majordomo::BrokerOptions broker_options(const BrokerSettings& settings) {
  const auto milliseconds = [](double seconds) { return static_cast<majordomo::Millis>(seconds * 1000); };
  majordomo::BrokerOptions options = settings.broker;
  if (!settings.keys.empty()) options.security = majordomo::read_broker_security(settings.keys);
  options.timers.worker_expiry = milliseconds(settings.worker_expiry);
  options.timers.attempt_timeout = milliseconds(settings.attempt_timeout);
  options.drain = milliseconds(settings.drain);
  options.limits.frame_bytes = settings.frame_mb << 20;
  options.limits.client_bytes = settings.client_mb << 20;
  options.least_event = settings.verbose ? LogLevel::debug : LogLevel::info;
  return options;
}

majordomo::BrokerEvent ready_event(const std::string& endpoint, const std::string& metrics) {
  majordomo::BrokerEvent ready{LogLevel::info, "broker-ready", {{"endpoint", endpoint}}};
  if (!metrics.empty()) ready.fields.emplace_back("metrics", metrics);
  return ready;
}

}  // namespace ssphh::app
