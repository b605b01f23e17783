/// What stands right at a limit opens, and what is one beyond it is refused: number by number.

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/runtime/cooked_file.h>

#include "cooked_room.h"

namespace ssphh::test {
namespace {

/// A small file, and what becomes of it when one word of it is another.
class FileEdges : public testing::Test {
 protected:
  static constexpr std::uint32_t nan = 0x7fc00000u, infinite = 0x7f800000u;

  static std::uint32_t bits(float v) {
    std::uint32_t word;
    std::memcpy(&word, &v, sizeof word);
    return word;
  }
  ssphh_runtime_result with(std::size_t at, std::uint32_t value) const {
    std::vector<std::byte> file = file_;
    std::memcpy(file.data() + at, &value, sizeof value);
    const std::uint64_t sum = ssphh_cooked_checksum(file.data(), file.size());
    std::memcpy(file.data() + offsetof(ssphh_cooked_header, checksum), &sum, sizeof sum);
    return OpenedFile(file).result;
  }
  void expect(std::size_t at, std::uint32_t good, std::uint32_t bad, const char* what) const {
    EXPECT_EQ(with(at, good), SSPHH_RUNTIME_OK) << what;
    EXPECT_EQ(with(at, bad), SSPHH_RUNTIME_INVALID) << what;
  }
  void expect_invalid(std::size_t at, std::uint32_t bad, const char* what) const {
    EXPECT_EQ(with(at, bad), SSPHH_RUNTIME_INVALID) << what;
  }
  std::size_t begin(int section) const {
    return reinterpret_cast<const ssphh_cooked_header*>(file_.data())->sections[section].offset;
  }
  std::size_t end(int section) const {
    const auto& s = reinterpret_cast<const ssphh_cooked_header*>(file_.data())->sections[section];
    return s.offset + s.size;
  }

  static const std::vector<std::byte>& with_points() {
    static const std::vector<std::byte> file = cook_two_rooms(set_of_two_rooms(OnSurfaces::records, 2), 8);
    return file;
  }
  std::vector<std::byte> file_ = with_points();
};

TEST_F(FileEdges, OfGroups) {
  const std::size_t group = begin(SSPHH_COOKED_GROUPS), second = group + sizeof(ssphh_cooked_group);
  for (std::size_t c = 0; c < 3; ++c) {
    expect(group + 8 + 4 * c, bits(1e6f), bits(std::nextafter(1e6f, 2e6f)), "a scale");
    expect(second + 8 + 4 * c, bits(0), bits(-1e-30f), "a scale");
    expect_invalid(second + 8 + 4 * c, nan, "a scale");
  }
  expect(second + 20, 2, 3, "a mode");
  expect_invalid(second + 24, 1, "what is reserved");
  expect_invalid(second + 28, 1, "what is reserved");
}

TEST_F(FileEdges, OfTheHeader) {
  using header = ssphh_cooked_header;
  expect(offsetof(header, time), bits(-7.5f), nan, "time");
  expect_invalid(offsetof(header, header_size), sizeof(header) + 8, "size of the header");
  expect(offsetof(header, probe_spacing), 0, bits(-0.5f), "spacing");
  expect_invalid(offsetof(header, probe_spacing), infinite, "spacing");
  for (std::size_t c = 0; c < 3; ++c)
    expect(offsetof(header, probe_origin) + 4 * c, bits(-9), infinite, "origin");
  expect(offsetof(header, probe_cell_size), bits(1e-3f), 0, "cell of probes");
  expect_invalid(offsetof(header, probe_cell_size), bits(-1), "cell of probes");
  expect_invalid(offsetof(header, degree), 3, "degree");
  expect_invalid(offsetof(header, probe_count), 0, "probes");
  const std::size_t grid = offsetof(header, surface_grids), second = grid + sizeof(ssphh_cooked_grid);
  for (std::size_t c = 0; c < 3; ++c) {
    expect(grid + 4 * c, bits(3), nan, "origin of a grid");
    expect_invalid(second + 4 * c, nan, "origin of a grid");
    expect_invalid(second + 16 + 4 * c, 1, "a grid of cells along one axis alone");
    expect_invalid(grid + 16 + 4 * c, 0, "a first grid of nothing");
  }
  expect(grid + 12, bits(1e-3f), 0, "cell of a grid");
  expect_invalid(second + 12, 0, "cell of a grid");
  expect_invalid(grid + 28, 1, "first brick");
  expect_invalid(second + 28, 0, "first brick");
}

TEST_F(FileEdges, OfProbesAndPoints) {
  const std::size_t lists = begin(SSPHH_COOKED_PROBE_CELLS), last_list = end(SSPHH_COOKED_PROBE_CELLS) - 4;
  expect(lists, 26u | 26u << 16, 26u | 27u << 16, "a probe of a list");
  expect(last_list, 0xffffffffu, 0xfffeffffu, "the end of a list");
  for (const std::size_t probe : {begin(SSPHH_COOKED_PROBES), end(SSPHH_COOKED_PROBES) - 16}) {
    for (std::size_t c = 0; c < 3; ++c) expect(probe + 4 * c, bits(0.5f), infinite, "a probe's place");
    expect(probe + 12, bits(1e-3f), 0, "a probe's reach");
    expect_invalid(probe + 12, infinite, "a probe's reach");
  }
  for (const std::size_t point : {begin(SSPHH_COOKED_POINTS), end(SSPHH_COOKED_POINTS) - 32}) {
    for (std::size_t c = 0; c < 3; ++c) {
      expect(point + 4 * c, bits(0.5f), nan, "a point's place");
      expect(point + 16 + 4 * c, bits(0.5f), infinite, "a point's normal");
    }
    expect(point + 12, bits(1e-3f), 0, "a point's spacing");
    expect(point + 28, 7, 8, "a point's cover");
  }
  expect_invalid(begin(SSPHH_COOKED_BRICKS) + 12, 1, "what is reserved");
  expect_invalid(begin(SSPHH_COOKED_CELLS) + 4, 1, "masks that do not begin");
  expect_invalid(end(SSPHH_COOKED_ENTRIES) - 4, 300, "a point of the last list");
  expect_invalid(begin(SSPHH_COOKED_LIGHT) + 4, nan, "light");
  expect_invalid(end(SSPHH_COOKED_LIGHT) - 4, nan, "the last light");
}

TEST_F(FileEdges, OfAFileWithoutPoints) {
  file_ = cook_two_rooms(set_of_two_rooms(OnSurfaces::nothing, 2), 0);
  EXPECT_EQ(OpenedFile(file_).result, SSPHH_RUNTIME_OK);
  using header = ssphh_cooked_header;
  expect_invalid(offsetof(header, point_floats), SSPHH_COOKED_RECORD_FLOATS, "floats of no point");
  // Their sections would be of no byte either
  expect_invalid(offsetof(header, entry_count), 1, "entries of no point");
  expect_invalid(offsetof(header, mask_count), 1, "masks of no point");
}

TEST(FileLimits, GroupsAndTheirNamesMayBeSoManyAndSoLong) {
  const auto opened = [](std::size_t groups, std::size_t length) {
    probes::ProbeSet set = probes::dark_set(std::vector<scene::ProbePlace>{{"p", vec3(0), 0.1f}}, 0);
    for (std::size_t g = 0; g < groups; ++g) {
      std::string name = std::to_string(g);
      name.resize(length, 'x');
      set.light_groups.push_back({.name = name});
      set.probes[0].groups.push_back({sh::RadianceSh(0), sh::RadianceSh(0)});
    }
    probes::merge_groups(set);
    return OpenedFile(cook::cook(set, nullptr).bytes).result;
  };
  EXPECT_EQ(opened(256, 3), SSPHH_RUNTIME_OK);
  EXPECT_EQ(opened(257, 3), SSPHH_RUNTIME_INVALID);
  EXPECT_EQ(opened(1, 1024), SSPHH_RUNTIME_OK);
  EXPECT_EQ(opened(1, 1025), SSPHH_RUNTIME_INVALID);
  EXPECT_EQ(opened(0, 0), SSPHH_RUNTIME_OK);
}

TEST(FileLimits, ScalesAreSetColourByColour) {
  const OpenedFile file(cook_two_rooms(set_of_two_rooms(OnSurfaces::nothing, 2), 0));
  const float scale[] = {1e6f, 0, 3};
  ASSERT_EQ(ssphh_runtime_set_group_scale(file.runtime, 2, scale), SSPHH_RUNTIME_OK);
  ssphh_runtime_group group;
  ssphh_runtime_describe_group(file.runtime, 2, &group);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(group.scale[c], scale[c]) << c;
  ssphh_runtime_describe_group(file.runtime, 1, &group);
  for (const float s : group.scale) EXPECT_EQ(s, 0.25f) << "another group";
}

}  // namespace
}  // namespace ssphh::test
