#pragma once
/// The options of every command that may have its work done by a farm.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <ssphh/core/json.h>
#include <ssphh/farm/dispatch.h>
#include <ssphh/farm/local_farm.h>

#include "options/command_line.h"

namespace ssphh::app {

/// Where a broker is and the keys to speak to it.
struct BrokerChoice {
  std::string endpoint, keys, key;
};
/// --broker, --keys and --key; `key` is the default name of one's own key.
Option add_broker_options(Command command, BrokerChoice& choice, const std::string& key);
/// The same for a command that does nothing without a broker: --broker may be a default of the user's own. A
/// command that can do the work itself goes to a farm only where its command line says so.
void add_required_broker(Command command, BrokerChoice& choice, const std::string& key);
farm::BrokerAddress broker_address(const BrokerChoice& choice);

struct FarmChoice {
  BrokerChoice broker;
  int local = 0;      ///< workers to start here, with a broker of their own
  std::string cache;  ///< of results; "none": none
  std::uint64_t cache_mb = 4096;
  std::string messages;  ///< folder in which jobs and results are kept, sent as JSON; empty: none
  farm::Renderer renderer = farm::Renderer::path;  ///< that its workers are to have
  std::string tool = "/proc/self/exe";             ///< program `ssphh`, which `local` starts

  bool any() const { return local > 0 || !broker.endpoint.empty(); }
};
void add_farm_options(Command command, FarmChoice& choice);

/// Where results are kept and how much of them.
struct ResultCache {
  std::filesystem::path folder;
  std::uint64_t bytes;
};
/// None if none was asked for.
std::optional<ResultCache> result_cache(const FarmChoice& choice);

/// A farm to work with, for as long as it lives.
class FarmSession {
 public:
  /// Starts the local farm if one was asked for.
  explicit FarmSession(const FarmChoice& choice);
  const farm::FarmOptions& options() const { return options_; }
  /// The one that was started; null: it is another's.
  farm::LocalFarm* local() const { return local_.get(); }

 private:
  std::unique_ptr<farm::LocalFarm> local_;
  std::unique_ptr<farm::DiskCache> results_;
  farm::FarmOptions options_;
};

/// None where the choice names no farm. Call it before anything that takes long: a local farm's processes
/// start in the meantime.
std::optional<FarmSession> farm_session(const FarmChoice& choice);

json::Value farm_json(const farm::FarmReport& report);
std::string farm_text(const farm::FarmReport& report);

}  // namespace ssphh::app
