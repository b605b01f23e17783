#include <fstream>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>

#include "farm_fixtures.h"
#include "memory_dir.h"
#include "variable.h"

namespace ssphh::farm {
namespace {

using ssphh::test::memory_dir;
using ssphh::test::TempDir;
using ssphh::test::Variable;

std::vector<std::byte> value(std::size_t size, int seed) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::byte>(i * 7 + static_cast<unsigned>(seed));
  return bytes;
}

Hash128 key(std::uint64_t i) {
  return {i * 0x9e3779b97f4a7c15ull, i};
}

std::filesystem::path file_of(const TempDir& dir, const Hash128& k) {
  return dir.path() / k.hex().substr(0, 2) / k.hex();
}

TEST(DiskCache, GivesBackWhatWasPut) {
  const TempDir dir;
  DiskCache cache(dir.path(), 1 << 20);
  EXPECT_FALSE(cache.get(key(1)));
  cache.put(key(1), value(1000, 3));
  cache.put(key(2), {});
  EXPECT_EQ(*cache.get(key(1)), value(1000, 3));
  EXPECT_TRUE(cache.get(key(2))->empty());
  EXPECT_EQ(*DiskCache(dir.path(), 1 << 20).get(key(1)), value(1000, 3)) << "another process";
}

TEST(DiskCache, DamageIsSeenAndRemoved) {
  const TempDir dir;
  set_log_sink([](LogLevel, const std::string&) {});
  DiskCache cache(dir.path(), 1 << 20);
  for (const std::size_t at : {std::size_t{0}, std::size_t{500}, std::size_t{1000}}) {
    cache.put(key(1), value(1000, 3));
    auto bytes = read_file(file_of(dir, key(1)));
    bytes[at] ^= std::byte{1};
    write_file(file_of(dir, key(1)), bytes);
    EXPECT_FALSE(cache.get(key(1))) << at;
    EXPECT_FALSE(cache.contains(key(1)));
  }
  cache.put(key(1), value(1000, 3));
  std::filesystem::resize_file(file_of(dir, key(1)), 10);
  EXPECT_FALSE(cache.get(key(1)));
  EXPECT_EQ(cache.counts().damaged, 4u);
  set_log_sink({});
}

/// Puts values that take `size` bytes with their hashes, begin..end−1, each used a second after the one
/// before.
void put_some(DiskCache& cache, const TempDir& dir, std::uint64_t begin, std::uint64_t end,
              std::size_t size) {
  const auto now = std::filesystem::file_time_type::clock::now();
  for (std::uint64_t i = begin; i < end; ++i) {
    cache.put(key(i), value(size - sizeof(Hash128), static_cast<int>(i)));
    const auto age = std::chrono::seconds(1000 - static_cast<int>(i));
    std::filesystem::last_write_time(file_of(dir, key(i)), now - age);
  }
}

TEST(DiskCache, StaysBelowItsBoundAndDropsWhatWasUnusedLongest) {
  const TempDir dir(memory_dir());
  DiskCache cache(dir.path(), 100'000);
  cache.put(key(1000), value(5000, 0));
  for (std::uint64_t i = 0; i < 60; ++i) {
    put_some(cache, dir, i, i + 1, 5016);
    ASSERT_TRUE(cache.get(key(1000))) << "in use all the time, after " << i;
    std::uint64_t bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(dir.path()))
      if (entry.is_regular_file()) bytes += entry.file_size();
    ASSERT_LE(bytes, 100'000u + 5016u);
  }
  EXPECT_FALSE(cache.get(key(0)));
  EXPECT_TRUE(cache.get(key(59)));
  EXPECT_THROW(cache.put(key(1), value(200'000, 0)), Error);
}

TEST(DiskCache, CountsWhatWasFoundMissedAndDropped) {
  const TempDir dir;
  DiskCache cache(dir.path(), 100);
  cache.put(key(1), value(60, 1));
  EXPECT_TRUE(cache.get(key(1)));
  EXPECT_FALSE(cache.get(key(2)));
  EXPECT_FALSE(cache.get(key(3)));
  EXPECT_EQ(cache.counts().hits, 1u);
  EXPECT_EQ(cache.counts().misses, 2u);
  EXPECT_EQ(cache.counts().evicted, 0u);
  cache.put(key(2), value(100, 1));
  EXPECT_EQ(cache.counts().evicted, 1u);
  EXPECT_TRUE(cache.get(key(2))) << "as large as the bound";
  EXPECT_THROW(cache.put(key(3), value(101, 1)), Error);
}

TEST(DiskCache, MakesRoomForATenthOrForWhatIsLarger) {
  const TempDir dir(memory_dir());
  DiskCache cache(dir.path(), 1000);
  put_some(cache, dir, 0, 20, 50);
  EXPECT_EQ(cache.counts().evicted, 0u) << "just full";
  put_some(cache, dir, 20, 21, 50);
  EXPECT_EQ(cache.counts().evicted, 2u) << "a tenth";
  put_some(cache, dir, 21, 22, 50);
  EXPECT_EQ(cache.counts().evicted, 2u) << "there is room again";
  put_some(cache, dir, 22, 23, 300);
  EXPECT_EQ(cache.counts().evicted, 8u);
  for (std::uint64_t i = 0; i < 23; ++i) EXPECT_EQ(cache.contains(key(i)), i >= 8) << i;
  DiskCache again(dir.path(), 1000);
  put_some(again, dir, 23, 24, 50);
  EXPECT_EQ(again.counts().evicted, 2u) << "knows what lay there when it began";
}

// It looks again after an eighth of the bound was put, so that the folder never has much more than that too
// much.
TEST(DiskCache, SeesWhatOtherProcessesHavePut) {
  const TempDir dir(memory_dir());
  DiskCache cache(dir.path(), 8000), other(dir.path(), 8000);
  put_some(other, dir, 0, 160, 50);
  put_some(cache, dir, 160, 181, 50);
  EXPECT_EQ(cache.counts().evicted, 0u) << "thinks that it is alone";
  put_some(cache, dir, 181, 182, 50);
  EXPECT_EQ(cache.counts().evicted, 37u) << "of 181 so many that 144 are left: nine tenths of the bound";
}

// 900 of 1000 bytes lie there when it begins; a look would find another's 50.
TEST(DiskCache, LooksAgainOnlyWhenItThinksThatItIsFull) {
  const TempDir dir(memory_dir());
  DiskCache other(dir.path(), 1000);
  put_some(other, dir, 0, 18, 50);
  DiskCache cache(dir.path(), 1000);
  put_some(other, dir, 18, 19, 50);
  put_some(cache, dir, 19, 20, 100);
  EXPECT_EQ(cache.counts().evicted, 0u) << "just full, as far as it knows";
  put_some(cache, dir, 20, 21, 50);
  EXPECT_EQ(cache.counts().evicted, 3u) << "of 1050, for a tenth";
}

TEST(DiskCache, CountsAnEighthAnewAfterALook) {
  const TempDir dir(memory_dir());
  DiskCache cache(dir.path(), 8000), other(dir.path(), 8000);
  put_some(cache, dir, 0, 22, 50);  // it has looked, before the last of them
  put_some(other, dir, 22, 142, 50);
  put_some(cache, dir, 142, 161, 50);
  EXPECT_EQ(cache.counts().evicted, 0u) << "an eighth has been put since";
  put_some(cache, dir, 161, 163, 50);
  EXPECT_EQ(cache.counts().evicted, 18u) << "of 162 so many that 144 are left";
}

TEST(DiskCache, FolderThatCannotBeMadeIsAnError) {
  EXPECT_THROW(DiskCache("/proc/nowhere", 1000), Error);
}

TEST(DiskCache, LiesWhereTheUsersCachesLie) {
  const auto dir = [](const char* xdg, const char* home) {
    const Variable first("XDG_CACHE_HOME", xdg), second("HOME", home);
    return default_cache_dir("jobs");
  };
  EXPECT_EQ(dir("/caches", "/home/me"), "/caches/ssphh/jobs");
  EXPECT_EQ(dir("", "/home/me"), "/home/me/.cache/ssphh/jobs");
  EXPECT_EQ(dir("caches", "/home/me"), "/home/me/.cache/ssphh/jobs") << "no absolute path";
  EXPECT_EQ(dir(nullptr, "/home/me"), "/home/me/.cache/ssphh/jobs");
  for (const char* home : {static_cast<const char*>(nullptr), ""})
    EXPECT_EQ(dir(nullptr, home), std::filesystem::temp_directory_path() / "ssphh" / "jobs");
}

TEST(FetchBlob, ContinuesWhereItWasCutOff) {
  const TempDir dir;
  DiskCache cache(dir.path(), 64 << 20);
  const auto bytes = value(5 << 20, 9);
  const Hash128 hash = content_hash(bytes);
  std::uint64_t sent = 0;
  bool broken = true;
  const FetchChunk fetch = [&](const Hash128&, const Hash128&, std::uint64_t offset, std::uint64_t length) {
    if (broken && offset >= 3u << 20) throw BlobUnavailable("the link broke");
    sent += length;
    const auto chunk = std::span(bytes).subspan(offset, length);
    return std::vector<std::byte>(chunk.begin(), chunk.end());
  };
  EXPECT_THROW(fetch_blob(cache, {}, hash, bytes.size(), fetch, {}), BlobUnavailable);
  broken = false;
  EXPECT_EQ(fetch_blob(cache, {}, hash, bytes.size(), fetch, {}), bytes);
  EXPECT_EQ(sent, bytes.size()) << "no byte travelled twice";
  EXPECT_EQ(fetch_blob(cache, {}, hash, bytes.size(), fetch, {}), bytes);
  EXPECT_EQ(sent, bytes.size()) << "cached";
}

TEST(FetchBlob, AsksForAMebibyteAtATimeAndForTheRest) {
  const TempDir dir;
  DiskCache cache(dir.path(), 64 << 20);
  const auto bytes = value((2 << 20) + 123, 9);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> asked;
  const FetchChunk fetch = [&](const Hash128& package, const Hash128&, std::uint64_t offset,
                               std::uint64_t length) {
    EXPECT_EQ(package, key(7));
    asked.emplace_back(offset, length);
    const auto chunk = std::span(bytes).subspan(offset, length);
    return std::vector<std::byte>(chunk.begin(), chunk.end());
  };
  EXPECT_EQ(fetch_blob(cache, key(7), content_hash(bytes), bytes.size(), fetch, {}), bytes);
  constexpr std::uint64_t mebibyte = 1 << 20;
  const std::vector<std::pair<std::uint64_t, std::uint64_t>> wanted = {
      {0, mebibyte}, {mebibyte, mebibyte}, {2 * mebibyte, 123}};
  EXPECT_EQ(asked, wanted);
}

TEST(FetchBlob, NoChunkAndOneThatIsTooLongAreRefused) {
  const TempDir dir;
  DiskCache cache(dir.path(), 64 << 20);
  for (const std::size_t size : {0, 101}) {
    const FetchChunk fetch = [&](const Hash128&, const Hash128&, std::uint64_t, std::uint64_t) {
      return std::vector<std::byte>(size);
    };
    EXPECT_THROW(fetch_blob(cache, {}, key(1), 100, fetch, {}), BlobUnavailable) << size;
  }
}

TEST(FetchBlob, WhatIsLongerThanTheBlobIsBegunAgain) {
  const TempDir dir;
  DiskCache cache(dir.path(), 64 << 20);
  const auto bytes = value(1000, 9);
  const Hash128 hash = content_hash(bytes);
  write_file(dir / (hash.hex() + ".part"), value(1001, 3));
  const FetchChunk fetch = [&](const Hash128&, const Hash128&, std::uint64_t offset, std::uint64_t length) {
    const auto chunk = std::span(bytes).subspan(offset, length);
    return std::vector<std::byte>(chunk.begin(), chunk.end());
  };
  EXPECT_EQ(fetch_blob(cache, {}, hash, bytes.size(), fetch, {}), bytes);
  EXPECT_FALSE(std::filesystem::exists(dir / (hash.hex() + ".part")));
}

TEST(FetchBlob, WhatHasArrivedWholeIsNotFetchedAgain) {
  const TempDir dir;
  DiskCache cache(dir.path(), 1000);
  const auto bytes = value(1000, 9);  // as large as the cache
  const Hash128 hash = content_hash(bytes);
  write_file(dir / (hash.hex() + ".part"), bytes);
  const FetchChunk none = [](const Hash128&, const Hash128&, std::uint64_t,
                             std::uint64_t) -> std::vector<std::byte> {
    throw BlobUnavailable("was asked for");
  };
  EXPECT_EQ(fetch_blob(cache, {}, hash, bytes.size(), none, {}), bytes);
  EXPECT_TRUE(cache.contains(hash));
}

TEST(FetchBlob, WhatArrivesDamagedIsRefusedAndFetchedAgain) {
  const TempDir dir;
  DiskCache cache(dir.path(), 64 << 20);
  const auto bytes = value(2 << 20, 9);
  bool damage = true;
  const FetchChunk fetch = [&](const Hash128&, const Hash128&, std::uint64_t offset, std::uint64_t length) {
    const auto chunk = std::span(bytes).subspan(offset, length);
    std::vector<std::byte> copy(chunk.begin(), chunk.end());
    if (damage) copy[77] ^= std::byte{1};
    return copy;
  };
  const Hash128 hash = content_hash(bytes);
  EXPECT_THROW(fetch_blob(cache, {}, hash, bytes.size(), fetch, {}), BlobUnavailable);
  damage = false;
  EXPECT_EQ(fetch_blob(cache, {}, hash, bytes.size(), fetch, {}), bytes);
}

TEST(FetchBlob, FullDiskIsThisWorkersTrouble) {
  const TempDir dir;
  DiskCache cache(dir.path(), 1 << 20);
  const FetchChunk fetch = [](const Hash128&, const Hash128&, std::uint64_t, std::uint64_t length) {
    return std::vector<std::byte>(length);
  };
  EXPECT_THROW(fetch_blob(cache, {}, key(1), 2 << 20, fetch, {}), BlobUnavailable);
}

}  // namespace
}  // namespace ssphh::farm
