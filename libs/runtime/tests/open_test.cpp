/// Opening, describing and changing: every entry with what its types allow.

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>

#include "cooked_room.h"
#include "not_finite.h"

namespace ssphh::test {
namespace {

/// A file opened once for all tests, which leave it as it was.
class Runtime : public testing::Test {
 protected:
  static const std::vector<std::byte>& file() {
    static const std::vector<std::byte> bytes = cook_two_rooms(set_of_two_rooms(OnSurfaces::records));
    return bytes;
  }
  OpenedFile opened_{file()};
  ssphh_runtime* rt_ = opened_.runtime;
  float x_[3] = {0.5f, 1, 0}, n_[3] = {0, 1, 0}, rgb_[3] = {7, 7, 7};
};

TEST_F(Runtime, TellsWhatItHolds) {
  ssphh_runtime_info info;
  ASSERT_EQ(ssphh_runtime_describe(rt_, &info), SSPHH_RUNTIME_OK);
  EXPECT_EQ(info.groups, 3u);
  EXPECT_EQ(info.probes, 27u);
  EXPECT_EQ(info.points, 300u);
  EXPECT_EQ(info.has_sight, 1u);
  EXPECT_EQ(info.time, 0);
  EXPECT_EQ(info.scene[0], 1u);
  EXPECT_EQ(info.scene[1], 2u);
  EXPECT_EQ(info.light_bytes, 3u * (27 * 3 * 24 + 300 * 12) * sizeof(float));
  ssphh_runtime_group group;
  const char* names[] = {"lamp", "the sun", "night \u00fc"};
  for (std::uint32_t g = 0; g < 3; ++g) {
    ASSERT_EQ(ssphh_runtime_describe_group(rt_, g, &group), SSPHH_RUNTIME_OK);
    EXPECT_STREQ(group.name, names[g]);
    EXPECT_EQ(group.baked, g == 1);
  }
  ssphh_runtime_describe_group(rt_, 0, &group);
  EXPECT_THAT(group.scale, testing::ElementsAre(1, 0.5f, 2)) << "as in the set";
  EXPECT_EQ(ssphh_runtime_describe_group(rt_, 3, &group), SSPHH_RUNTIME_BAD_ARGUMENT);
}

TEST_F(Runtime, EveryResultHasAMessage) {
  std::set<std::string> messages;
  for (int r = SSPHH_RUNTIME_OK; r <= SSPHH_RUNTIME_OTHER_GROUPS; ++r)
    EXPECT_TRUE(messages.insert(ssphh_runtime_message(static_cast<ssphh_runtime_result>(r))).second);
  EXPECT_EQ(messages.count("unknown error"), 0u);
  EXPECT_STREQ(ssphh_runtime_message(static_cast<ssphh_runtime_result>(99)), "unknown error");
}

TEST_F(Runtime, NullPointersAreRefused) {
  const float scale[] = {1, 1, 1};
  std::size_t size;
  std::vector<std::byte> memory(1024);
  ssphh_runtime* out;
  const auto bad = SSPHH_RUNTIME_BAD_ARGUMENT;
  EXPECT_EQ(ssphh_runtime_size_needed(nullptr, 100, &size), bad);
  EXPECT_EQ(ssphh_runtime_size_needed(file().data(), file().size(), nullptr), bad);
  EXPECT_EQ(ssphh_runtime_open(nullptr, 100, memory.data(), memory.size(), &out), bad);
  EXPECT_EQ(ssphh_runtime_open(file().data(), file().size(), nullptr, 1024, &out), bad);
  EXPECT_EQ(ssphh_runtime_open(file().data(), file().size(), memory.data(), memory.size(), nullptr), bad);
  EXPECT_EQ(ssphh_runtime_describe(nullptr, nullptr), bad);
  EXPECT_EQ(ssphh_runtime_describe(rt_, nullptr), bad);
  EXPECT_EQ(ssphh_runtime_describe_group(rt_, 0, nullptr), bad);
  EXPECT_EQ(ssphh_runtime_set_group_scale(nullptr, 0, scale), bad);
  EXPECT_EQ(ssphh_runtime_set_group_scale(rt_, 0, nullptr), bad);
  EXPECT_EQ(ssphh_runtime_swap_light(nullptr, file().data(), file().size()), bad);
  EXPECT_EQ(ssphh_runtime_swap_light(rt_, nullptr, 100), bad);
  EXPECT_EQ(ssphh_runtime_irradiance(nullptr, 0, x_, n_, rgb_), bad);
  EXPECT_EQ(ssphh_runtime_irradiance(rt_, 0, nullptr, n_, rgb_), bad);
  EXPECT_EQ(ssphh_runtime_irradiance(rt_, 0, x_, nullptr, rgb_), bad);
  EXPECT_EQ(ssphh_runtime_irradiance(rt_, 0, x_, n_, nullptr), bad);
  EXPECT_EQ(ssphh_runtime_irradiance(rt_, 2, x_, n_, rgb_), bad) << "a flag that there is not";
  const ssphh_runtime_place place{};
  EXPECT_EQ(ssphh_runtime_irradiance_batch(nullptr, 0, &place, 1, rgb_), bad);
  EXPECT_EQ(ssphh_runtime_irradiance_batch(rt_, 0, nullptr, 1, rgb_), bad);
  EXPECT_EQ(ssphh_runtime_irradiance_batch(rt_, 0, &place, 1, nullptr), bad);
  EXPECT_EQ(ssphh_runtime_irradiance_batch(rt_, 2, &place, 1, rgb_), bad);
  EXPECT_EQ(ssphh_runtime_irradiance_batch(rt_, 0, nullptr, 0, nullptr), SSPHH_RUNTIME_OK) << "no places";
  EXPECT_THAT(rgb_, testing::Each(7)) << "nothing was written";
}

TEST_F(Runtime, MemoryIsLargeEnoughAndAligned) {
  std::size_t size = 0;
  ASSERT_EQ(ssphh_runtime_size_needed(file().data(), file().size(), &size), SSPHH_RUNTIME_OK);
  EXPECT_EQ(size % 16, 0u);
  EXPECT_LT(size, 4096u);
  std::vector<std::byte> memory(size + 16);
  ssphh_runtime* out = rt_;
  EXPECT_EQ(ssphh_runtime_open(file().data(), file().size(), memory.data(), size - 1, &out),
            SSPHH_RUNTIME_BAD_MEMORY);
  EXPECT_EQ(out, nullptr);
  EXPECT_EQ(ssphh_runtime_open(file().data(), file().size(), memory.data() + 4, size, &out),
            SSPHH_RUNTIME_BAD_MEMORY);
  std::vector<std::byte> shifted(file().size() + 8);
  std::copy(file().begin(), file().end(), shifted.begin() + 8);
  EXPECT_EQ(ssphh_runtime_open(shifted.data() + 8, file().size(), memory.data(), size, &out),
            SSPHH_RUNTIME_BAD_MEMORY);
  EXPECT_EQ(ssphh_runtime_size_needed(shifted.data() + 8, file().size(), &size), SSPHH_RUNTIME_BAD_MEMORY);
}

TEST_F(Runtime, WritesNoFurtherThanTheSizeNeeded) {
  std::size_t size = 0;
  ssphh_runtime_size_needed(file().data(), file().size(), &size);
  std::vector<std::byte> memory(size + 64, std::byte{0x5a});
  ssphh_runtime* out;
  ASSERT_EQ(ssphh_runtime_open(file().data(), file().size(), memory.data(), size, &out), SSPHH_RUNTIME_OK);
  for (std::size_t i = size; i < memory.size(); ++i) EXPECT_EQ(memory[i], std::byte{0x5a});
}

TEST_F(Runtime, ScalesAreNumbersOfZeroToAMillion) {
  const rays::SurfacePoint at{{0.5f, 0, 0.3f}, {0, 1, 0}};
  const vec3 before = opened_.irradiance(at);
  for (const float bad :
       {-1e-3f, 1.1e6f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (int c = 0; c < 3; ++c) {
      float scale[] = {3, 3, 3};
      scale[c] = bad;
      EXPECT_EQ(ssphh_runtime_set_group_scale(rt_, 0, scale), SSPHH_RUNTIME_BAD_ARGUMENT) << bad;
    }
  }
  const float two[] = {2, 2, 2};
  EXPECT_EQ(ssphh_runtime_set_group_scale(rt_, 3, two), SSPHH_RUNTIME_BAD_ARGUMENT);
  EXPECT_EQ(ssphh_runtime_set_group_scale(rt_, ~0u, two), SSPHH_RUNTIME_BAD_ARGUMENT);
  EXPECT_EQ(opened_.irradiance(at), before) << "as it was";
  EXPECT_EQ(ssphh_runtime_set_group_scale(rt_, 0, two), SSPHH_RUNTIME_OK);
  EXPECT_NE(opened_.irradiance(at), before);
}

TEST_F(Runtime, PlacesThatAreNoNumbersAreDark) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    for (int k = 0; k < 6; ++k) {
      for (const unsigned flags : {0u, 1u}) {
        ssphh_runtime_place places[] = {{{0.5f, 1, 0}, {0, 1, 0}}, {{0.5f, 1, 0}, {0, 1, 0}}};
        (k < 3 ? places[0].position[k] : places[0].normal[k - 3]) = bad;
        float rgb[6] = {7, 7, 7, 7, 7, 7};
        EXPECT_EQ(ssphh_runtime_irradiance_batch(rt_, flags, places, 2, rgb), SSPHH_RUNTIME_BAD_ARGUMENT);
        for (int c = 0; c < 3; ++c) EXPECT_EQ(rgb[c], 0);
        for (int c = 3; c < 6; ++c) EXPECT_GT(rgb[c], 0) << "the other place is looked up";
        EXPECT_EQ(ssphh_runtime_irradiance(rt_, flags, places[0].position, places[0].normal, rgb),
                  SSPHH_RUNTIME_BAD_ARGUMENT);
      }
    }
  }
}

TEST_F(Runtime, AnyPlaceAndNormalGivesANumber) {
  constexpr float huge = 3e38f, tiny = 1e-38f;
  for (const float x : {0.0f, -0.0f, huge, -huge, tiny, 0.05f, 2.0f, -2.0f, 1e9f}) {
    for (const float y : {0.0f, huge, -1e20f, 2.0f}) {
      for (const vec3& n : {vec3(0), vec3(0, 1, 0), vec3(0, 0, -1), vec3(huge), vec3(tiny), vec3(1, 0, 0)}) {
        for (const unsigned flags : {0u, 1u}) {
          const float place[] = {x, y, x};
          EXPECT_EQ(ssphh_runtime_irradiance(rt_, flags, place, &n.x, rgb_), SSPHH_RUNTIME_OK);
          for (const float e : rgb_) EXPECT_GE(e, 0) << x << ' ' << y;
        }
      }
    }
  }
}

TEST_F(Runtime, ABatchHasTheBitsOfSingleLookups) {
  std::vector<ssphh_runtime_place> batch;
  const std::vector<rays::SurfacePoint> places = places_on_surfaces(200, 3);
  for (const rays::SurfacePoint& at : places)
    batch.push_back({{at.position.x, at.position.y, at.position.z}, {at.normal.x, at.normal.y, at.normal.z}});
  std::vector<vec3> rgb(places.size());
  ASSERT_EQ(ssphh_runtime_irradiance_batch(rt_, 0, batch.data(), batch.size(), &rgb[0].x), SSPHH_RUNTIME_OK);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(rgb[i], opened_.irradiance(places[i])) << i;
}

TEST_F(Runtime, LightOfOthersIsNotSwappedIn) {
  const rays::SurfacePoint at{{0.5f, 0, 0.3f}, {0, 1, 0}};
  const vec3 before = opened_.irradiance(at);
  const auto swap = [&](const probes::ProbeSet& set) {
    const std::vector<std::byte> other = cook_two_rooms(set);
    return ssphh_runtime_swap_light(rt_, other.data(), other.size());
  };
  probes::ProbeSet moved = set_of_two_rooms(OnSurfaces::records);
  moved.probes[3].position.x += 1e-3f;
  EXPECT_EQ(swap(moved), SSPHH_RUNTIME_OTHER_GEOMETRY);
  EXPECT_EQ(swap(set_of_two_rooms(OnSurfaces::fitted)), SSPHH_RUNTIME_OTHER_GEOMETRY);
  EXPECT_EQ(swap(set_of_two_rooms(OnSurfaces::records, 2)), SSPHH_RUNTIME_OTHER_GEOMETRY);
  probes::ProbeSet renamed = set_of_two_rooms(OnSurfaces::records);
  renamed.light_groups[0].name = "lamq";
  EXPECT_EQ(swap(renamed), SSPHH_RUNTIME_OTHER_GROUPS);
  probes::ProbeSet live = set_of_two_rooms(OnSurfaces::records);
  live.light_groups[1].mode = scene::LightMode::mixed;
  probes::merge_groups(live);
  EXPECT_EQ(swap(live), SSPHH_RUNTIME_OTHER_GROUPS) << "its direct light is not within";
  probes::ProbeSet fewer = set_of_two_rooms(OnSurfaces::records);
  fewer.light_groups.pop_back(), fewer.surface->groups.pop_back();
  for (probes::Probe& probe : fewer.probes) probe.groups.pop_back();
  probes::merge_groups(fewer);
  EXPECT_EQ(swap(fewer), SSPHH_RUNTIME_OTHER_GROUPS);
  std::vector<std::byte> cut = file();
  cut.resize(cut.size() - 64);
  EXPECT_EQ(ssphh_runtime_swap_light(rt_, cut.data(), cut.size()), SSPHH_RUNTIME_CUT_OFF);
  EXPECT_EQ(opened_.irradiance(at), before) << "as it was";
}

}  // namespace
}  // namespace ssphh::test
