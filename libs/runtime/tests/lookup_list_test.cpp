/// Lookups number by number, of files of every kind, at places of every kind; and the checksum.

#include <cstddef>
#include <numeric>

#include <gtest/gtest.h>

#include <ssphh/runtime/cooked_file.h>

#include "cooked_room.h"
#include "number_list.h"

namespace ssphh::test {
namespace {

/// On surfaces, off them, behind them, in the open, at probes and points themselves, beyond all of it.
std::vector<rays::SurfacePoint> places_of_all_kinds(const probes::ProbeSet& set) {
  std::vector<rays::SurfacePoint> places = places_on_surfaces(24, 31);
  for (const rays::SurfacePoint& at : places_on_surfaces(8, 32)) {
    places.push_back({at.position + 0.07f * at.normal, at.normal});
    places.push_back({at.position, glm::normalize(at.normal + vec3(0.5f, 0.4f, -0.3f))});
    places.push_back({at.position, -at.normal});
  }
  std::vector<rays::SurfacePoint> open = places_in_the_open(16, 33);
  for (rays::SurfacePoint& at : open) {
    places.push_back(at);
    at.moves = false;
    places.push_back(at);
  }
  for (const std::size_t i : {0, 13}) {
    places.push_back({set.probes[i].position, {0, 1, 0}, true});
    places.push_back({set.probes[i].position + vec3(0.3f, 0, 0), {-1, 0, 0}, true});
  }
  for (const rays::SurfacePoint& at : places_on_surfaces(2, 5)) places.push_back(at);  // records' own
  places.push_back({{50, 1, 0}, {-1, 0, 0}});
  places.push_back({{0, -70, 0}, {0, 1, 0}, true});
  return places;
}

TEST(LookupList, IsThatOfTheFiles) {
  NumberList list;
  const auto add = [&](const char* name, const probes::ProbeSet& set, int sight, bool every = false) {
    const OpenedFile file(cook_two_rooms(set, sight));
    ASSERT_EQ(file.result, SSPHH_RUNTIME_OK) << name;
    std::size_t i = 0;
    for (const rays::SurfacePoint& at : places_of_all_kinds(set))
      if (every || i++ % 3 == 0) list.add(name, file.irradiance(at));
  };
  add("probes", set_of_two_rooms(OnSurfaces::nothing), 16, true);
  add("records", set_of_two_rooms(OnSurfaces::records), 16, true);
  add("fitted", set_of_two_rooms(OnSurfaces::fitted), 16, true);
  add("all seen", set_of_two_rooms(OnSurfaces::nothing), 0);
  for (const int degree : {0, 1, 2}) add("of few bands", set_of_two_rooms(OnSurfaces::nothing, degree), 8);
  probes::ProbeSet few = set_of_two_rooms(OnSurfaces::nothing, 2);
  few.probes.resize(2);
  add("two probes", few, 8);
  few.probes.resize(1);
  add("one probe", few, 8);
  list.expect("libs/runtime/tests/expected/lookups.txt");
}

TEST(LookupList, HidesNoProbeThatStandsInTheOpen) {
  // 20 cm before a wall, and asked from the wall on either side of its foot
  probes::ProbeSet set = set_of_two_rooms(OnSurfaces::nothing, 2);
  set.probes.resize(1);
  set.probes[0].position = {-1.8f, 1, 0};
  const OpenedFile file(cook_two_rooms(set, 8));
  for (const float z : {-0.6f, -0.1f, 0.0f, 0.2f, 0.7f})
    EXPECT_GT(file.irradiance({{-2, 1, z}, {1, 0, 0}}).x, 0) << z;
}

TEST(CookedChecksum, IsTheSameEverywhere) {
  std::vector<std::uint64_t> words(160);
  auto* bytes = reinterpret_cast<unsigned char*>(words.data());
  for (std::size_t i = 0; i < 8 * words.size(); ++i) bytes[i] = static_cast<unsigned char>(37 * i + i / 251);
  NumberList list;
  for (const std::uint64_t size : {1024u, 1032u, 1048u, 1056u, 1280u})
    list.add("checksum", size, fmt::format("x{:016x}", ssphh_cooked_checksum(bytes, size)));
  list.expect("libs/runtime/tests/expected/checksums.txt");
  // Its own place counts as zeros, wherever in its lane that is
  const std::uint64_t before = ssphh_cooked_checksum(bytes, 1280);
  bytes[offsetof(ssphh_cooked_header, checksum)] ^= 1;
  EXPECT_EQ(ssphh_cooked_checksum(bytes, 1280), before);
  bytes[offsetof(ssphh_cooked_header, checksum) + 8] ^= 1;
  EXPECT_NE(ssphh_cooked_checksum(bytes, 1280), before);
}

}  // namespace
}  // namespace ssphh::test
