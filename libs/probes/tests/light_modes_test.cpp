/// Light groups that are baked: what of them surfaces look up, and how files keep their modes.

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/probe_file.h>

namespace ssphh::probes {
namespace {

using scene::LightMode;

sh::RadianceSh even(const vec3& radiance) {
  sh::RadianceSh f(0);
  f.values[0] = radiance * std::sqrt(4 * pi);
  return f;
}

/// One probe; a sky and a lamp, each seen directly and by reflected light.
ProbeSet two_groups(LightMode sky, LightMode lamp) {
  ProbeSet set;
  set.degree = 0;
  set.light_groups = {{"sky", vec3(1), sky}, {"lamp", vec3(0.5f), lamp}};
  Probe& probe = set.probes.emplace_back();
  probe.name = "p";
  probe.groups = {{even(vec3(1, 2, 3)), even(vec3(10, 20, 30))},
                  {even(vec3(100, 200, 300)), even(vec3(1000, 2000, 3000))}};
  merge_groups(set);
  return set;
}

vec3 mean_of(const sh::RadianceSh& f) {
  return sh::mean(f);
}

void expect_equal(const vec3& a, const vec3& b) {
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-5f * b[c]);
}

TEST(BakedGroups, AreLookedUpWithTheirDirectLightAndNoOthersAre) {
  using enum LightMode;
  expect_equal(mean_of(two_groups(realtime, mixed).probes[0].reflected), vec3(510, 1020, 1530));
  expect_equal(mean_of(two_groups(baked, realtime).probes[0].reflected), vec3(511, 1022, 1533));
  expect_equal(mean_of(two_groups(realtime, baked).probes[0].reflected), vec3(560, 1120, 1680));
  expect_equal(mean_of(two_groups(diffuse, mixed).probes[0].reflected), vec3(510, 1020, 1530));
  for (const LightMode sky : {realtime, mixed, baked, diffuse})
    expect_equal(mean_of(two_groups(sky, realtime).probes[0].self), vec3(561, 1122, 1683));
}

/// Where nothing hides anything.
class OpenSpace final : public rays::RadianceSource {
 public:
  const std::vector<std::string>& light_groups() const override { return none_; }
  std::vector<rays::GroupRadiance> incident_radiance(const rays::CubeRequest&,
                                                     const Control&) const override {
    return {};
  }
  std::vector<image::CubeMap> ghost_radiance(const rays::CubeRequest&, std::span<const rays::GhostSphere>,
                                             const GhostSink&, const Control&) const override {
    return {};
  }
  bool visible(const vec3&, const vec3&) const override { return true; }
  std::uint64_t rays_traced() const override { return 0; }

 private:
  std::vector<std::string> none_;
};

TEST(BakedGroups, AreNamedByEveryLookup) {
  const ProbeSet set = two_groups(LightMode::baked, LightMode::mixed);
  EXPECT_EQ(baked_groups(set), std::vector<std::string>{"sky"});
  const ProbeSet plain = two_groups(LightMode::realtime, LightMode::mixed);
  const OpenSpace space;
  for (const LookupMethod method : {LookupMethod::light, LookupMethod::irradiance}) {
    EXPECT_EQ(make_lookup(method, set, space)->direct_groups(), std::vector<std::string>{"sky"});
    EXPECT_TRUE(make_lookup(method, plain, space)->direct_groups().empty());
  }
}

/// The same with one record of each group, of a fifth and twice the light that probes see, on a floor; the
/// sky's direct light is kept apart.
ProbeSet with_a_record(LightMode sky, LightMode lamp) {
  ProbeSet set = two_groups(sky, lamp);
  const auto even_light = [](const vec3& e) {
    RecordLight light(0);
    light[3] = e;
    return std::vector{pack(light, {0, 1, 0})};
  };
  set.surface = {{{vec3(0), {0, 1, 0}}},
                 {even_light(vec3(3, 6, 9)), even_light(vec3(50, 60, 70))},
                 {even_light(vec3(0.5f, 1, 2)), {}}};
  set.probes[0].position = {0, 1, 0};
  merge_groups(set);
  return set;
}

TEST(KeptDirectLight, IsInRecordsOfItsModes) {
  using enum LightMode;
  const vec3 reflected = vec3(3, 6, 9) + 0.5f * vec3(50, 60, 70), direct(0.5f, 1, 2);
  const auto light = [](const ProbeSet& set) { return vec3(set.surface->light[0][3]); };
  // 16 bit of the largest channel, halved
  const auto expect_light = [](const vec3& a, const vec3& b) {
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 70.0f / 32767);
  };
  expect_light(light(with_a_record(realtime, realtime)), reflected);
  expect_light(light(with_a_record(mixed, diffuse)), reflected);
  expect_light(light(with_a_record(diffuse, realtime)), reflected + direct);
  expect_light(light(with_a_record(baked, mixed)), reflected + direct);
  ProbeSet dimmed = with_a_record(diffuse, realtime);
  relight(dimmed, "sky", vec3(0));
  expect_light(light(dimmed), 0.5f * vec3(50, 60, 70));
}

TEST(KeptDirectLight, OfDiffuseGroupsIsLookedUpWithRecordsAlone) {
  const OpenSpace space;
  const ProbeSet set = with_a_record(LightMode::diffuse, LightMode::realtime);
  const std::vector<std::string> sky = {"sky"};
  EXPECT_EQ(mirrored_groups(set), sky);
  EXPECT_TRUE(baked_groups(set).empty());
  EXPECT_TRUE(mirrored_groups(two_groups(LightMode::diffuse, LightMode::realtime)).empty()) << "no records";
  const rays::SurfacePoint moving{vec3(0, 0, 0.1f), {0, 1, 0}, true};
  // Each sends E = π L from all around.
  const vec3 reflected(510, 1020, 1530), direct(1, 2, 3);
  const auto by_records = make_lookup(LookupSpec(), set, space);
  EXPECT_EQ(by_records->direct_groups(), sky);
  EXPECT_EQ(by_records->mirrored_groups(), sky);
  expect_equal(by_records->irradiance(moving), pi * (reflected + direct));
  const rays::SurfacePoint turned{vec3(0, 0, 0.1f), {0, -1, 0}};
  expect_equal(by_records->irradiance(turned), pi * (reflected + still_share_of_sky * direct));
  expect_equal(by_records->glossy(moving, {0, 1, 0}, 0.5f), reflected);
  const auto by_probes = make_lookup({.weights = WeightMethod::distance}, set, space);
  EXPECT_TRUE(by_probes->direct_groups().empty());
  expect_equal(by_probes->irradiance(moving), pi * reflected);
  ProbeSet baked = with_a_record(LightMode::baked, LightMode::realtime);
  const auto all = make_lookup(LookupSpec(), baked, space);
  EXPECT_EQ(all->direct_groups(), sky);
  EXPECT_TRUE(all->mirrored_groups().empty());
  expect_equal(all->glossy(moving, {0, 1, 0}, 0.5f), reflected + direct);
}

TEST(KeptDirectLight, StandsInFiles) {
  const ProbeSet set = with_a_record(LightMode::diffuse, LightMode::mixed);
  EXPECT_EQ(probes_from_json(probes_to_json(set), "set").surface, set.surface);
  EXPECT_EQ(probes_from_binary(probes_to_binary(set), "set").surface, set.surface);
  ProbeSet spoilt = set;
  spoilt.surface->direct.pop_back();
  EXPECT_THROW(probes_to_binary(spoilt), Error) << "tells of one group alone";
  spoilt = set;
  spoilt.surface->direct[0].push_back({});
  EXPECT_THROW(probes_to_json(spoilt), Error);
  EXPECT_THROW(merge_groups(spoilt), Error);
}

TEST(BakedGroups, KeepTheirModesInFiles) {
  for (const LightMode sky : {LightMode::realtime, LightMode::mixed, LightMode::baked, LightMode::diffuse}) {
    const ProbeSet set = two_groups(sky, LightMode::mixed);
    EXPECT_EQ(probes_from_json(probes_to_json(set), "set").light_groups, set.light_groups);
    const ProbeSet again = probes_from_binary(probes_to_binary(set), "set");
    EXPECT_EQ(again.light_groups, set.light_groups);
    EXPECT_EQ(again.probes[0].reflected, set.probes[0].reflected);
  }
}

TEST(BakedGroups, OfFilesWithAnotherModeAreRefused) {
  std::string text = probes_to_json(two_groups(LightMode::baked, LightMode::mixed));
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    return other;
  };
  EXPECT_THROW(probes_from_json(replaced("\"mode\":\"baked\"", "\"mode\":\"bakd\""), "set"), Error);
  EXPECT_THROW(probes_from_json(replaced(",\"mode\":\"baked\"", ""), "set"), Error);
  EXPECT_THROW(probes_from_json(replaced("\"version\":7", "\"version\":6"), "set"), Error);
}

}  // namespace
}  // namespace ssphh::probes
