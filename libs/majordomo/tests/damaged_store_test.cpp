/// Stores that are none, of another version or damaged: told, and left as they are.

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "error_message.h"
#include "memory_dir.h"
#include "store.h"
#include "temp_dir.h"

namespace ssphh::majordomo::test {
namespace {

using ssphh::test::message_of;

class DamagedStore : public testing::Test {
 protected:
  /// A store of one request, then `sql`; what loading it says, behind the file's name.
  std::string after(const char* sql) {
    const ssphh::test::TempDir dir{ssphh::test::memory_dir()};
    const std::filesystem::path file = dir / "requests.sqlite";
    Store(dir.path())
        .apply({{StoreOperation::add,
                 {.id = {1, 2}, .service = "gen", .body = std::make_shared<const Frames>(Frames{"x"})}}});
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
    const std::string said = message_of([&] { Store(dir.path()).load(); });
    return said.starts_with(file.string()) ? said.substr(file.string().size()) : said;
  }
};

TEST_F(DamagedStore, IsNotReadInParts) {
  const std::string damaged = ": holds a damaged request (move the file away and begin anew)";
  EXPECT_EQ(after(""), "no error");
  EXPECT_EQ(after("UPDATE request SET id = 'x'"), damaged);
  EXPECT_EQ(after("UPDATE request SET body = x''"), damaged) << "a body has a frame";
  EXPECT_EQ(after("UPDATE request SET body = x'010000'"), damaged) << "less than a length";
  EXPECT_EQ(after("UPDATE request SET body = x'0200000078'"), damaged) << "less than it says";
  EXPECT_EQ(after("UPDATE request SET body = x'0100000078'"), "no error");
  EXPECT_EQ(after("UPDATE request SET body = x'00000000'"), "no error") << "an empty frame";
  EXPECT_EQ(after("UPDATE request SET finished = 1"), damaged) << "without a reply";
  EXPECT_EQ(after("UPDATE request SET finished = 1, reply = x'0100000078'"), "no error");
  EXPECT_EQ(after("UPDATE request SET outcome = -1"), damaged);
  EXPECT_EQ(
      after(("UPDATE request SET outcome = " + std::to_string(static_cast<int>(Outcome::no_answer))).c_str()),
      "no error");
  EXPECT_EQ(after(("UPDATE request SET outcome = " + std::to_string(static_cast<int>(Outcome::no_answer) + 1))
                      .c_str()),
            damaged);
}

TEST_F(DamagedStore, OfAnotherVersionIsLeftAlone) {
  EXPECT_EQ(after("PRAGMA user_version = 7"), ": is a store of version 7 (use the ssphh that made it)");
  EXPECT_EQ(after("DROP TABLE request"), ": no such table: request (is this a store of this version?)");
}

TEST_F(DamagedStore, ThatCannotBeOpenedSaysSo) {
  const ssphh::test::TempDir dir{ssphh::test::memory_dir()};
  const std::filesystem::path file = dir / "requests.sqlite";
  std::filesystem::create_directory(file);
  EXPECT_EQ(message_of([&] { Store(dir.path()); }),
            file.string() + ": unable to open database file (choose a folder that can be written)");
  EXPECT_EQ(message_of([&] { Store("/dev/null/store"); }),
            "/dev/null/store: Not a directory (choose a folder that can be written)");
}

}  // namespace
}  // namespace ssphh::majordomo::test
