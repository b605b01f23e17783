/// Cooked files of real bakes against the formulas that they follow, and against the full lookup, which sends
/// rays.

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/probes/hier.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>

#include "cooked_reference.h"
#include "real_bake.h"

namespace ssphh::test {
namespace {

/// A bake's file of its own, and the places where both are asked.
struct Asked {
  explicit Asked(const RealBake& of) : bake(of), tracer(of.scene), file(of.bytes) {
    // Not in the slots behind pictures, narrower than points are apart, where lists tell little
    surfaces = study::reachable_points(bake.source, bake.origins(), 0, {1500, 5, 0.1f});
    open = study::points_in_the_open(bake.source, surfaces, 0, 5);
    for (rays::SurfacePoint& at : open) at.moves = true;
  }

  const RealBake& bake;
  trace::PathTracer tracer;
  OpenedFile file;
  std::vector<rays::SurfacePoint> surfaces, open;
};

/// Differences in shares of the mean irradiance, sorted.
struct Differences {
  std::vector<double> sorted;
  double ratio = 0;

  template <class Light>
  Differences(const OpenedFile& file, const Light& light, const std::vector<rays::SurfacePoint>& places) {
    double sum = 0, found = 0;
    for (const rays::SurfacePoint& at : places) {
      const vec3 a = light.irradiance(at), b = file.irradiance(at);
      sum += static_cast<double>(a.x + a.y + a.z), found += static_cast<double>(b.x + b.y + b.z);
      sorted.push_back(static_cast<double>(glm::length(a - b)));
    }
    std::ranges::sort(sorted);
    ratio = found / sum;
    for (double& d : sorted) d *= 3 * static_cast<double>(places.size()) / sum;
  }
  double within(double share) const {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

class CookedBake : public testing::TestWithParam<std::string> {
 protected:
  /// Both tests look at the same places.
  static const Asked& asked() {
    static std::map<std::string, Asked> known;
    if (const auto found = known.find(GetParam()); found != known.end()) return found->second;
    const std::string name = GetParam().substr(0, GetParam().find('_'));
    return known
        .try_emplace(GetParam(), real_bake(name, records() ? OnSurfaces::records : OnSurfaces::fitted))
        .first->second;
  }
  static bool records() { return GetParam().find("fitted") == std::string::npos; }
};

TEST_P(CookedBake, GivesWhatItsFormulaSays) {
  const RealBake& bake = asked().bake;
  const CookedReference reference(bake.scene, bake.source, bake.set, cook::CookParams{}.sight_size);
  std::size_t by_points = 0;
  for (const rays::SurfacePoint& at : asked().surfaces) by_points += reference.by_points(at);
  EXPECT_GT(by_points, asked().surfaces.size() / 2);
  // Where a distance lies next to the one asked for, its 16 bits may decide otherwise than the ray
  for (const auto& places : {asked().surfaces, asked().open}) {
    const Differences found(asked().file, reference, places);
    // Points that blend probes hold bands over 2 at their own normals alone
    EXPECT_LT(found.within(0.99), records() ? 2e-5 : 0.02);
    EXPECT_LT(found.within(0.5), 2e-5);
    EXPECT_NEAR(found.ratio, 1, 1e-3);
  }
}

TEST_P(CookedBake, IsNearTheFullLookup) {
  const probes::IrradianceLookup full(asked().bake.set, asked().tracer);
  const Differences surfaces(asked().file, full, asked().surfaces), open(asked().file, full, asked().open);
  RecordProperty("surfaces", fmt::format("ratio {:.4f}, half {:.2g}, 90 % {:.2g}", surfaces.ratio,
                                         surfaces.within(0.5), surfaces.within(0.9)));
  RecordProperty("open", fmt::format("ratio {:.4f}, half {:.2g}, 90 % {:.2g}", open.ratio, open.within(0.5),
                                     open.within(0.9)));
  EXPECT_LT(surfaces.within(0.5), 1e-4);
  EXPECT_LT(surfaces.within(0.9), 1e-3)
      << "also where a band of wall and pictures hang a hand before another wall";
  EXPECT_NEAR(surfaces.ratio, 1, 0.03);
  EXPECT_LT(open.within(0.5), 1e-5);
  EXPECT_LT(open.within(0.9), 1e-4);
  EXPECT_NEAR(open.ratio, 1, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Of, CookedBake, testing::Values("cornell", "rooms", "gallery1", "gallery1_fitted"),
                         [](const auto& of) { return of.param; });

TEST(CookedBakes, LightOfOtherLampsIsSwappedInAtTheSamePlaces) {
  const RealBake& day = real_bake("rooms");
  OpenedFile file(day.bytes);
  scene::Scene lamps = lit_two_rooms();
  // A darker lamp at the same place may ask for records at the same places, too
  lamps.lights[0].color *= vec3(0.2f, 0.1f, 0.05f);
  lamps.nodes.at(static_cast<std::size_t>(lamps.lights[0].node)).local.translation += vec3(0.5f, -0.5f, 0.8f);
  const RealBake evening(lamps, OnSurfaces::records);
  const Asked asked(evening);
  const auto swap = [&](const std::vector<std::byte>& bytes) {
    return ssphh_runtime_swap_light(file.runtime, bytes.data(), bytes.size());
  };
  EXPECT_EQ(swap(evening.bytes), SSPHH_RUNTIME_OTHER_GEOMETRY) << "records stand where light asks for them";
  const cook::CookScene cook_scene{evening.scene, evening.source};
  cook::CookParams params;
  params.places = &day.set;
  const std::vector<std::byte> at_places = cook::cook(evening.set, &cook_scene, params).bytes;
  ASSERT_EQ(swap(at_places), SSPHH_RUNTIME_OK);
  for (const rays::SurfacePoint& at : asked.open)
    EXPECT_EQ(file.irradiance(at), asked.file.irradiance(at)) << "probes have no other places";
  const probes::IrradianceLookup full(evening.set, asked.tracer);
  const Differences surfaces(file, full, asked.surfaces);
  EXPECT_LT(surfaces.within(0.5), 0.01);
  EXPECT_LT(surfaces.within(0.9), 0.05);
  EXPECT_NEAR(surfaces.ratio, 1, 0.01);
}

TEST(CookedBakes, OtherScalesAreNearTheRelitSet) {
  // The window of each probe is that of the bake's scales
  const RealBake& bake = real_bake("gallery1");
  const Asked asked(bake);
  probes::ProbeSet set = bake.set;
  set.surface.reset();
  const vec3 scales[] = {vec3(0), {3, 2, 1}, vec3(0.2f)};
  for (std::uint32_t g = 0; g < 3; ++g) {
    probes::relight(set, set.light_groups[g].name, scales[g]);
    ASSERT_EQ(ssphh_runtime_set_group_scale(asked.file.runtime, g, &scales[g].x), SSPHH_RUNTIME_OK);
  }
  const CookedReference reference(bake.scene, bake.source, set, cook::CookParams{}.sight_size);
  const Differences found(asked.file, reference, asked.open);
  EXPECT_LT(found.within(0.5), 2e-3);
  EXPECT_LT(found.within(0.99), 0.05);
}

}  // namespace
}  // namespace ssphh::test
