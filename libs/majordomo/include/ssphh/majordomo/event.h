#pragma once
/// What happens in a broker, for logs and counters: a name and a few values, no text to parse.

#include <string>
#include <utility>
#include <vector>

#include <ssphh/core/log.h>

namespace ssphh::majordomo {

/// `name` is one of the events that docs/protocol.md lists ("job-retry"); fields are in a fixed order per
/// event.
struct BrokerEvent {
  LogLevel level = LogLevel::info;
  const char* name = "";
  std::vector<std::pair<const char*, std::string>> fields = {};

  /// "job-retry job=12 service=gen worker=a:1 attempt=2 reason=\"peer gone\"".
  std::string text() const;
  /// One JSON object with "event", "level" and the fields as strings (schemas/broker-event.schema.json).
  std::string json() const;
};

}  // namespace ssphh::majordomo
