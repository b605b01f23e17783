#pragma once
/// `ssphh farm`: questions to a broker, orders to its workers, and keys. All but run_farm_keygen() throw
/// Error where the broker's keys cannot be read, where it does not answer within five seconds and where the
/// own key has no right to ask; Cancelled when asked to stop.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/core/json.h>
#include <ssphh/farm/status.h>

#include "options/farm_options.h"

namespace ssphh::app {

using farm::FarmStatus;
FarmStatus run_farm_status(const BrokerChoice& broker, const Control& control = {});
json::Value to_json(const FarmStatus& result, const BrokerChoice& broker);
std::string to_text(const FarmStatus& result, const BrokerChoice& broker);

struct FarmTopOptions {
  BrokerChoice broker;
  double interval = 1;  ///< seconds between two looks
  int count = 0;        ///< looks; 0: until cancelled
};
/// Hands every look to `show`.
void run_farm_top(const FarmTopOptions& options, const std::function<void(const FarmStatus&)>& show,
                  const Control& control = {});

struct FarmDrainOptions {
  BrokerChoice broker;
  std::string workers;  ///< how the names begin of those that are meant; empty: all
};
struct FarmDrainResult {
  int told = 0;  ///< workers, to finish their jobs and leave
};
FarmDrainResult run_farm_drain(const FarmDrainOptions& options, const Control& control = {});
json::Value to_json(const FarmDrainResult& result, const FarmDrainOptions& options);
std::string to_text(const FarmDrainResult& result, const FarmDrainOptions& options);

struct FarmParkedResult {
  json::Value jobs;  ///< that were set aside, as mmi.parked tells of them (docs/protocol.md)
};
FarmParkedResult run_farm_parked(const BrokerChoice& broker, const Control& control = {});
json::Value to_json(const FarmParkedResult& result, const BrokerChoice& broker);
std::string to_text(const FarmParkedResult& result, const BrokerChoice& broker);

/// Jobs that were set aside.
struct FarmJobsOptions {
  BrokerChoice broker;
  std::vector<std::uint64_t> jobs;  ///< by their numbers
  bool all = false;                 ///< whatever their numbers
};
struct FarmReleaseResult {
  int released = 0;  ///< jobs that are queued again
};
struct FarmDropResult {
  int dropped = 0;  ///< jobs that are forgotten
};
/// Both throw Error where no jobs are named, and at the first that is not set aside.
FarmReleaseResult run_farm_release(const FarmJobsOptions& options, const Control& control = {});
FarmDropResult run_farm_drop(const FarmJobsOptions& options, const Control& control = {});
json::Value to_json(const FarmReleaseResult& result, const FarmJobsOptions& options);
std::string to_text(const FarmReleaseResult& result, const FarmJobsOptions& options);
json::Value to_json(const FarmDropResult& result, const FarmJobsOptions& options);
std::string to_text(const FarmDropResult& result, const FarmJobsOptions& options);

/// Who bakes and renders, who serves, and who may drain as well.
enum class FarmRole { client, worker, admin };
constexpr auto enum_table(FarmRole) {
  using enum FarmRole;
  return std::to_array<EnumName<FarmRole>>({{client, "client"}, {worker, "worker"}, {admin, "admin"}});
}
struct FarmKeygenOptions {
  std::string folder = "ssphh-keys";  ///< of the keys; made where it is not there
  std::string name;                   ///< of the key
  FarmRole role = FarmRole::client;
};
struct FarmKeygenResult {
  std::vector<std::string> made;  ///< names of keys: the broker's too, when there is none
};
/// Writes the keys, and the new one's rights into allow.txt. Throws Error for a name that has a key already
/// or is not [A-Za-z0-9._-]+, and for files that cannot be written.
FarmKeygenResult run_farm_keygen(const FarmKeygenOptions& options, const Control& control = {});
json::Value to_json(const FarmKeygenResult& result, const FarmKeygenOptions& options);
std::string to_text(const FarmKeygenResult& result, const FarmKeygenOptions& options);

}  // namespace ssphh::app
