#pragma once
/// Persistent requests and their replies in one SQLite file: what a broker must not forget when it ends.

#include <filesystem>
#include <vector>

#include <ssphh/majordomo/broker_core.h>

struct sqlite3;

namespace ssphh::majordomo {

class Store {
 public:
  /// Opens or makes DIR/requests.sqlite and locks it. Throws Error when it cannot be written, is in use by
  /// another broker, or is of another version.
  explicit Store(const std::filesystem::path& dir);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// All requests, in the order in which they were added.
  std::vector<StoredRequest> load();
  /// Does all or nothing; on disk when it returns. Throws Error.
  void apply(const std::vector<StoreOperation>& operations);

 private:
  void execute(const char* sql);

  std::filesystem::path path_;
  sqlite3* database_ = nullptr;
};

}  // namespace ssphh::majordomo
