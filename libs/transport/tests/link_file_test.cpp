#include "link_file.h"

#include <cstring>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/random.h>

#include "temp_dir.h"

namespace ssphh::transport {
namespace {

struct Network {
  std::vector<std::vector<Link>> fixed, moving;
  LinkRows rows;

  explicit Network(std::uint32_t count) : fixed(count), moving(count) {
    Pcg32 rng(9);
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::uint32_t k = 0; k < i % 7; ++k)
        fixed[i].push_back({rng.next() % count, 0.1f * rng.uniform()});
      for (std::uint32_t k = 0; k < i % 3; ++k)
        moving[i].push_back({rng.next() % count, 0.1f * rng.uniform()});
      rows.rows.push_back({fixed[i], moving[i]});
    }
  }
};

TEST(LinkFile, SolvesToTheSameBitsFromDisk) {
  const test::TempDir dir;
  const Network network(500);
  write_link_file(network.rows, dir.path() / "a.links");
  const MappedLinks mapped(dir.path() / "a.links");
  ASSERT_EQ(mapped.rows().link_count(), network.rows.link_count());
  const std::vector<Irradiance4> light(500, Irradiance4(1, 2, 3, 0));
  std::vector<Irradiance4> once(500), from_disk(500);
  LinkRows joined;
  std::vector<std::vector<Link>> all(500);
  for (std::size_t i = 0; i < 500; ++i) {
    all[i] = network.fixed[i];
    all[i].insert(all[i].end(), network.moving[i].begin(), network.moving[i].end());
    joined.rows.push_back({all[i], {}});
  }
  bounce_once(joined, light, once);
  bounce_once(mapped.rows(), light, from_disk);
  EXPECT_EQ(once, from_disk);
}

TEST(LinkFile, RefusesWhatIsBroken) {
  const test::TempDir dir;
  const auto path = dir.path() / "a.links";
  write_link_file(Network(50).rows, path);
  const std::vector<std::byte> good = read_file(path);
  const auto refused = [&](std::vector<std::byte> bytes, const char* why) {
    write_file(path, bytes);
    try {
      const MappedLinks mapped(path);
      ADD_FAILURE() << "accepted what should say: " << why;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(why));
    }
  };
  const auto changed = [&](std::size_t at, auto value) {
    std::vector<std::byte> bytes = good;
    std::memcpy(bytes.data() + at, &value, sizeof(value));
    return bytes;
  };
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(good.data()), 8), "SPHLLINK");
  for (const std::size_t size : {std::size_t{0}, std::size_t{31}})
    refused({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}, "too short");
  refused({good.begin(), good.end() - 8}, "do not make");
  refused(changed(0, 'x'), "no link file");
  refused(changed(8, std::uint32_t{3}), "format version 3");
  refused(changed(12, std::uint32_t{0}), "no patch");
  refused(changed(16, std::numeric_limits<std::uint64_t>::max()), "do not make");
  refused(changed(32, std::uint32_t{50}), "links to patch 50");
  refused(changed(36, std::numeric_limits<float>::quiet_NaN()), "weight nan");
  refused(changed(good.size() - 16, ~std::uint64_t{0}), "outside of the links");
  EXPECT_THROW(MappedLinks(dir.path() / "absent"), Error);
  EXPECT_THROW(LinkFileWriter(dir.path() / "no" / "folder"), Error);
}

TEST(LinkFile, AnUnfinishedFileLeavesNothingBehind) {
  const test::TempDir dir;
  {
    LinkFileWriter writer(dir.path() / "a.links");
    writer.add_row({});
  }
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

}  // namespace
}  // namespace ssphh::transport
