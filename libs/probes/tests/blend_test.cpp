#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/math.h>
#include <ssphh/probes/blend.h>
#include <ssphh/probes/probe_file.h>

#include "error_message.h"

namespace ssphh::probes {
namespace {

using test::message_of;

sh::RadianceSh constant(int degree, const vec3& value) {
  sh::RadianceSh f(degree);
  f[0] = value;
  f.values.back() = 0.5f * value;
  return f;
}

/// Two probes and two groups, the last of which is dark at the second probe; a record beside them.
ProbeSet make_set(float light) {
  ProbeSet set;
  set.degree = 2;
  set.generator.time = light;
  set.light_groups = {{.name = "lamp"}, {.name = "sky", .scale = vec3(2)}};
  set.probes.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    Probe& probe = set.probes[i];
    probe.name = i == 0 ? "a" : "b";
    probe.position = vec3(static_cast<float>(i), 0, 0);
    probe.groups.push_back({{}, constant(2, vec3(light, 2 * light, 3))});
    probe.groups.push_back({{}, sh::RadianceSh(2)});
    if (i == 0) probe.groups[1] = {constant(2, vec3(1)), constant(2, vec3(light))};
  }
  set.probes[0].edges.push_back({1, light, constant(2, vec3(light)), {}});
  SurfaceRecords records;
  records.points.resize(1);
  records.points[0].normal = vec3(0, 1, 0);
  RecordLight record(0);
  record[3] = vec3(light, 1, 2);
  for (int g = 0; g < 2; ++g) records.groups.push_back({pack(record, vec3(0, 1, 0))});
  set.surface = records;
  merge_groups(set);
  return set;
}

TEST(Blend, IsLinearInAllLight) {
  const ProbeSet a = make_set(1), b = make_set(5);
  const BlendedSet blended = blend(a, b, 0.25f);
  EXPECT_TRUE(blended.left_out.empty());
  const ProbeSet& set = blended.set;
  EXPECT_EQ(set.generator.time, 2);
  EXPECT_FLOAT_EQ(set.probes[0].groups[0].reflected[0].x, 2);
  EXPECT_FLOAT_EQ(set.probes[0].groups[0].reflected[0].y, 4);
  EXPECT_FLOAT_EQ(set.probes[0].groups[0].reflected[0].z, 3);
  EXPECT_FLOAT_EQ(set.probes[0].groups[1].emitted[0].x, 1);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < set.probes[i].self.values.size(); ++k) {
      const vec3 expected = 0.75f * a.probes[i].self.values[k] + 0.25f * b.probes[i].self.values[k];
      EXPECT_LT(glm::distance(set.probes[i].self.values[k], expected), 1e-5f);
    }
  }
  EXPECT_FLOAT_EQ(set.probes[0].edges.at(0).transfer, 2);
  EXPECT_NEAR(set.surface.value().light.at(0)[3].x, 3 * 2, 1e-3f);  // both groups, scales 1 and 2
  validate(set, "blend");
}

TEST(Blend, EndsAreTheSetsThemselves) {
  const ProbeSet a = make_set(1), b = make_set(5);
  EXPECT_EQ(blend(a, b, 0).set, a);
  EXPECT_EQ(blend(a, b, 1).set, b);
}

TEST(Blend, FactorsThatDifferAreInTheLight) {
  const ProbeSet a = make_set(1);
  ProbeSet b = make_set(1);
  relight(b, "lamp", vec3(3));
  const ProbeSet set = blend(a, b, 0.5f).set;
  EXPECT_EQ(set.light_groups[0].scale, vec3(1));
  EXPECT_FLOAT_EQ(set.probes[1].reflected[0].x, 2);
  EXPECT_NEAR(set.surface->light[0][3].x, 2 + 2, 1e-3f);
}

TEST(Blend, AnEdgeThatOneLacksIsDarkThere) {
  ProbeSet a = make_set(1), b = make_set(1);
  a.probes[0].edges.clear();
  EXPECT_FLOAT_EQ(blend(a, b, 0.25f).set.probes[0].edges.at(0).transfer, 0.25f);
}

TEST(Blend, WhatCannotBeBlendedIsLeftOutAndNamed) {
  ProbeSet a = make_set(1), b = make_set(2);
  b.surface->points[0].position.x = 1;
  a.fitted.emplace();
  const BlendedSet blended = blend(a, b, 0.5f);
  EXPECT_FALSE(blended.set.surface || blended.set.fitted);
  EXPECT_EQ(blended.left_out, (std::vector<std::string>{"surface records", "fitted weights"}));
}

TEST(Blend, SetsOfAnotherNetworkAreRefused) {
  const ProbeSet a = make_set(1);
  const auto said = [&](const auto& change) {
    ProbeSet b = make_set(1);
    change(b);
    return message_of([&] { blend(a, b, 0.5f); });
  };
  EXPECT_EQ(said([](ProbeSet&) {}), "no error");
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(said([](ProbeSet& b) { b.degree = 3; }), "degree 2 and 3");
  has(said([](ProbeSet& b) { b.probes.pop_back(); }), "2 and 1 probes");
  has(said([](ProbeSet& b) { b.probes[1].position.y = 0.1f; }),
      "probe \"b\" stands at (1, 0, 0) and (1, 0.1, 0) m");
  has(said([](ProbeSet& b) { b.light_groups[1].name = "sun"; }), "light group \"sky\" and \"sun\"");
  has(said([](ProbeSet& b) { b.light_groups[0].mode = scene::LightMode::baked; }), "realtime and baked");
  has(message_of([&] { blend(a, a, 1.5f); }), "t must be from 0 to 1");
}

TEST(LightAt, TakesTheKeysAround) {
  const std::vector<KeyedSet> keys = {{0, make_set(0)}, {1, make_set(1)}, {3, make_set(7)}};
  const auto light = [&](float time) { return light_at(keys, time).set.probes[0].groups[0].reflected[0].x; };
  EXPECT_EQ(light(-1), 0);
  EXPECT_EQ(light(0), 0);
  EXPECT_FLOAT_EQ(light(0.5f), 0.5f);
  EXPECT_EQ(light(1), 1);
  EXPECT_FLOAT_EQ(light(2), 4);
  EXPECT_EQ(light(9), 7);
  EXPECT_NE(message_of([] { light_at({}, 0); }), "no error");
  EXPECT_NE(message_of([&] { light_at({keys[1], keys[0]}, 0); }), "no error");
}

}  // namespace
}  // namespace ssphh::probes
