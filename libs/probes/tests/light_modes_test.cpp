/// Light groups that are baked: what of them surfaces look up, and how files keep their modes.

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/probes/lookup.h>
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
  for (const LightMode sky : {realtime, mixed, baked})
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

TEST(BakedGroups, KeepTheirModesInFiles) {
  for (const LightMode sky : {LightMode::realtime, LightMode::mixed, LightMode::baked}) {
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
