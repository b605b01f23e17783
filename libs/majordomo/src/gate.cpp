#include "gate.h"

#include <ssphh/core/error.h>

namespace ssphh::majordomo {

Gate::Gate(zmq::context_t& context, const BrokerSecurity& security)
    : file_(security.allow_file), read_(stamp()), zap_(context, security.allowed) {
  take(security.allowed);
}

void Gate::take(const AllowList& allowed) {
  rights_.clear();
  for (const AllowedKey& entry : allowed) rights_[entry.public_key] = entry.rights;
}

const Rights* Gate::rights(const std::string& key) const {
  const auto found = rights_.find(key);
  return found == rights_.end() ? nullptr : &found->second;
}

Gate::Stamp Gate::stamp() const {
  std::error_code ignored;
  return {std::filesystem::last_write_time(file_, ignored), std::filesystem::file_size(file_, ignored)};
}

bool Gate::file_changed() const {
  return !file_.empty() && stamp() != read_;
}

BrokerEvent Gate::reload() {
  read_ = stamp();  // before reading, so that a change meanwhile is seen next time
  try {
    const AllowList allowed = read_allow_list(file_);
    take(allowed);
    zap_.allow(allowed);
    return {LogLevel::info, "allow-list-read", {{"keys", std::to_string(allowed.size())}}};
  } catch (const Error& e) {
    return {LogLevel::error, "allow-list-refused", {{"reason", e.what()}}};
  }
}

}  // namespace ssphh::majordomo
