#pragma once
/// Who may come in with which rights: the allow-list, followed while the broker runs.

#include <filesystem>
#include <string>
#include <unordered_map>

#include <ssphh/majordomo/event.h>

#include "zap.h"

namespace ssphh::majordomo {

class Gate {
 public:
  /// Must exist before the first socket of the context is bound.
  Gate(zmq::context_t& context, const BrokerSecurity& security);

  /// Of a public key; null when it is not in the list (any more).
  const Rights* rights(const std::string& key) const;
  /// Whether the list's file is another one than when it was last read.
  bool file_changed() const;
  /// Reads the list's file; tells what came of it. A list that cannot be read leaves all as it is.
  BrokerEvent reload();
  bool follows_a_file() const { return !file_.empty(); }

 private:
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  Stamp stamp() const;
  void take(const AllowList& allowed);

  std::filesystem::path file_;
  Stamp read_;
  std::unordered_map<std::string, Rights> rights_;  ///< by public key
  Zap zap_;
};

}  // namespace ssphh::majordomo
