#include "store.h"

#include <cstring>

#include <sqlite3.h>

#include <ssphh/core/error.h>

namespace ssphh::majordomo {
namespace {

constexpr int schema_version = 1;

[[noreturn]] void fail(const std::filesystem::path& path, sqlite3* database, const char* hint) {
  throw Error(path.string(), database ? sqlite3_errmsg(database) : "cannot be opened", hint);
}

/// A body as one blob: for each frame its length (4 bytes, little-endian) and bytes.
std::string pack(const Body& body) {
  std::string blob;
  for (const Frame& frame : *body) {
    const auto size = static_cast<std::uint32_t>(frame.size());
    blob.append(reinterpret_cast<const char*>(&size), sizeof size);
    blob += frame;
  }
  return blob;
}

std::optional<Body> unpack(std::string_view blob) {
  Frames frames;
  while (!blob.empty()) {
    std::uint32_t size = 0;
    if (blob.size() < sizeof size) return std::nullopt;
    std::memcpy(&size, blob.data(), sizeof size);
    blob.remove_prefix(sizeof size);
    if (blob.size() < size) return std::nullopt;
    frames.emplace_back(blob.substr(0, size));
    blob.remove_prefix(size);
  }
  if (frames.empty()) return std::nullopt;
  return std::make_shared<const Frames>(std::move(frames));
}

class Statement {
 public:
  Statement(const std::filesystem::path& path, sqlite3* database, const char* sql)
      : path_(path), database_(database) {
    if (sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr) != SQLITE_OK)
      fail(path_, database_, "is this a store of this version?");
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& blob(int at, std::string_view bytes) {
    sqlite3_bind_blob64(statement_, at, bytes.data(), bytes.size(), SQLITE_TRANSIENT);
    return *this;
  }
  Statement& text(int at, std::string_view value) {
    sqlite3_bind_text(statement_, at, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    return *this;
  }
  Statement& number(int at, std::int64_t value) {
    sqlite3_bind_int64(statement_, at, value);
    return *this;
  }
  bool step() {
    const int code = sqlite3_step(statement_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) fail(path_, database_, "is the disk full?");
    return code == SQLITE_ROW;
  }
  void again() {
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
  }
  std::string_view bytes(int column) const {
    const void* data = sqlite3_column_blob(statement_, column);
    return {static_cast<const char*>(data),
            static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
  }
  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }

 private:
  const std::filesystem::path& path_;
  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace

Store::Store(const std::filesystem::path& dir) : path_(dir / "requests.sqlite") {
  std::error_code error;
  std::filesystem::create_directories(dir, error);
  if (error) throw Error(dir.string(), error.message(), "choose a folder that can be written");
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
  if (sqlite3_open_v2(path_.c_str(), &database_, flags, nullptr) != SQLITE_OK) {
    const Error problem(path_.string(), database_ ? sqlite3_errmsg(database_) : "cannot be opened",
                        "choose a folder that can be written");
    sqlite3_close(database_);
    throw problem;
  }
  try {
    // An exclusive lock from the first write on: two brokers on one store would answer requests twice.
    execute("PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;");
    execute("BEGIN IMMEDIATE; COMMIT;");
    Statement version(path_, database_, "PRAGMA user_version");
    version.step();
    if (const auto found = version.integer(0); found == 0) {
      execute(
          "CREATE TABLE request (sequence INTEGER PRIMARY KEY, id TEXT UNIQUE NOT NULL, service TEXT NOT "
          "NULL, body BLOB NOT NULL, attempt_timeout INTEGER NOT NULL, finished INTEGER NOT NULL DEFAULT 0, "
          "outcome INTEGER NOT NULL DEFAULT 0, reason TEXT NOT NULL DEFAULT '', attempts INTEGER NOT NULL "
          "DEFAULT 0, reply BLOB); PRAGMA user_version = 1;");
    } else if (found != schema_version) {
      throw Error(path_.string(), "is a store of version " + std::to_string(found),
                  "use the ssphh that made it");
    }
  } catch (...) {
    sqlite3_close(database_);
    throw;
  }
}

Store::~Store() {
  sqlite3_close(database_);
}

void Store::execute(const char* sql) {
  if (sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) != SQLITE_OK)
    fail(path_, database_, "does another broker use it, or is the disk full?");
}

std::vector<StoredRequest> Store::load() {
  std::vector<StoredRequest> all;
  Statement rows(
      path_, database_,
      "SELECT id, service, body, attempt_timeout, finished, outcome, reason, attempts, reply FROM request"
      " ORDER BY sequence");
  while (rows.step()) {
    StoredRequest request;
    const auto id = RequestId::parse(rows.bytes(0));
    const auto body = unpack(rows.bytes(2));
    const auto reply = rows.integer(4) ? unpack(rows.bytes(8)) : std::nullopt;
    const auto outcome = rows.integer(5);
    if (!id || !body || (rows.integer(4) && !reply) || outcome < 0 ||
        outcome > static_cast<int>(Outcome::no_answer))
      throw Error(path_.string(), "holds a damaged request", "move the file away and begin anew");
    request.id = *id;
    request.service = rows.bytes(1);
    request.body = *body;
    request.attempt_timeout = rows.integer(3);
    request.finished = rows.integer(4) != 0;
    request.outcome = static_cast<Outcome>(outcome);
    request.reason = rows.bytes(6);
    request.attempts = static_cast<std::uint32_t>(rows.integer(7));
    if (reply) request.reply = *reply;
    all.push_back(std::move(request));
  }
  return all;
}

void Store::apply(const std::vector<StoreOperation>& operations) {
  if (operations.empty()) return;
  execute("BEGIN");
  try {
    Statement add(path_, database_,
                  "INSERT OR IGNORE INTO request (id, service, body, attempt_timeout) VALUES (?, ?, ?, ?)");
    Statement finish(
        path_, database_,
        "UPDATE request SET finished = 1, outcome = ?2, reason = ?3, attempts = ?4, reply = ?5 WHERE"
        " id = ?1");
    Statement forget(path_, database_, "DELETE FROM request WHERE id = ?");
    for (const auto& [kind, request] : operations) {
      const std::string id = request.id.hex();
      switch (kind) {
        case StoreOperation::add:
          add.text(1, id)
              .text(2, request.service)
              .blob(3, pack(request.body))
              .number(4, request.attempt_timeout);
          add.step();
          add.again();
          break;
        case StoreOperation::finish:
          finish.text(1, id).number(2, static_cast<int>(request.outcome)).text(3, request.reason);
          finish.number(4, request.attempts).blob(5, pack(request.reply));
          finish.step();
          finish.again();
          break;
        case StoreOperation::forget:
          forget.text(1, id);
          forget.step();
          forget.again();
          break;
      }
    }
    execute("COMMIT");
  } catch (...) {
    sqlite3_exec(database_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

}  // namespace ssphh::majordomo
