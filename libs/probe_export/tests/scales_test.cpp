// Light of known size comes out of each file by the engine's own arithmetic as it went in.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/core/random.h>

#include "error_message.h"
#include "expect_near.h"
#include "json_schema.h"
#include "places.h"
#include "readers.h"
#include "thread_count.h"

namespace ssphh::probe_export {
namespace {

Exported exported(const char* target, const probes::ProbeSet& set, float spacing = 0.25f) {
  ExportSource source{set, open_space};
  source.grid.spacing = spacing;
  return find_target(target).write(source, "grid", {});
}

/// Moving least squares keep slopes a little flat (mls_ridge, 5 %), half floats have 11 bits.
constexpr float for_half_floats = 0.03f, for_ridge = 0.25f;
/// Of the engines' constants.
constexpr float six_digits = 1e-4f;

template <class Check>
void for_places(const Check& check) {
  Pcg32 random(3);
  for (int i = 0; i < 300; ++i) {
    const vec3 at = 1.2f * random.uniform3() - 0.6f;
    check(at, glm::normalize(2.0f * random.uniform3() - 1.0f));
  }
}

TEST(Scales, ThreeReadsIrradiance) {
  for (const bool linear : {false, true}) {
    const ThreeReader reader(exported("three", field_set(linear)));
    for_places([&](const vec3& at, const vec3& n) {
      ASSERT_TRUE(reader.holds(at, n));
      // The engine looks half a cell along the normal.
      const vec3 place = at + 0.5f * reader.cell() * n;
      test::expect_near(reader.irradiance(at, n), field_irradiance(place, n, linear),
                        linear ? for_ridge : for_half_floats);
    });
  }
}

TEST(Scales, SubVolumesForThreeEndInCopiesOfTheirOuterSlices) {
  const Exported file = exported("three", field_set(true));
  const json::Value size = json::parse(text_of(file.files[0]), "header")["resolution"];
  const auto slices = static_cast<std::size_t>(*size[2].integer());
  const std::size_t slice = 8 * static_cast<std::size_t>(*size[0].integer() * *size[1].integer());
  const auto at = [&](std::size_t volume, std::size_t z) {
    const auto begin =
        file.files[1].data.begin() + static_cast<std::ptrdiff_t>((volume * (slices + 2) + z) * slice);
    return std::vector<std::byte>(begin, begin + static_cast<std::ptrdiff_t>(slice));
  };
  for (std::size_t volume = 0; volume < 7; ++volume) {
    EXPECT_EQ(at(volume, 0), at(volume, 1));
    EXPECT_EQ(at(volume, slices + 1), at(volume, slices));
    EXPECT_NE(at(volume, 0), at(volume, slices));
  }
}

TEST(Scales, BevyReadsIrradianceOverPiAlongTheAxes) {
  for (const bool linear : {false, true}) {
    const BevyReader reader(exported("bevy", field_set(linear)));
    for_places([&](const vec3& at, const vec3&) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0f, 1.0f}) {
          vec3 n(0);
          n[axis] = sign;
          test::expect_near(reader.diffuse(at, n), field_irradiance(at, n, linear) / pi,
                            (linear ? for_ridge : for_half_floats) / pi);
        }
      }
    });
  }
}

TEST(Scales, BabylonReadsIrradianceOverPi) {
  for (const bool linear : {false, true}) {
    const ObjectGridReader reader(exported("babylon", field_set(linear)), "ssphh-babylon-grid");
    for_places([&](const vec3& at, const vec3& n) {
      test::expect_near(babylon_diffuse(reader.colors(at), n), field_irradiance(at, n, linear) / pi,
                        linear ? for_ridge / pi : six_digits);
    });
  }
}

TEST(Scales, PlayCanvasReadsIrradianceOverPi) {
  for (const bool linear : {false, true}) {
    const ObjectGridReader reader(exported("playcanvas", field_set(linear)), "ssphh-playcanvas-grid");
    for_places([&](const vec3& at, const vec3& n) {
      test::expect_near(playcanvas_diffuse(reader.colors(at), n), field_irradiance(at, n, linear) / pi,
                        linear ? for_ridge / pi : six_digits);
    });
  }
}

TEST(Scales, CsvHoldsEveryProbesRadianceOfAllBands) {
  const probes::ProbeSet set = field_set(true, 3);
  const Exported file = exported("csv", set);
  std::string line = "name,x,y,z,radius";
  for (int k = 0; k < 16; ++k) line += fmt::format(",r{0},g{0},b{0}", k);
  for (const probes::Probe& p : set.probes) {
    line += fmt::format("\n\"{}\",{},{},{},{}", p.name, p.position.x, p.position.y, p.position.z, p.radius);
    for (const vec3& v : p.reflected.values) line += fmt::format(",{},{},{}", v.x, v.y, v.z);
  }
  EXPECT_EQ(text_of(file.files[0]), line + "\n");
  test::expect_near(set.probes[7].reflected[2], field(2, set.probes[7].position, true));
}

TEST(Scales, UnityReadsIrradianceOverPiInItsMirroredAxes) {
  for (const bool linear : {false, true}) {
    const probes::ProbeSet set = field_set(linear);
    const Exported files = exported("unity", set);
    const json::Value file = json::parse(text_of(files.files.at(0)), "unity");
    EXPECT_EQ(file["format"], "ssphh-unity-probes");
    ASSERT_EQ(file["positions"].size(), 3 * set.probes.size());
    ASSERT_EQ(file["light"].size(), 27 * set.probes.size());
    for (std::size_t i = 0; i < set.probes.size(); ++i) {
      const vec3 at = set.probes[i].position;
      const auto coordinate = [&](std::size_t axis) { return file["positions"][3 * i + axis].number(); };
      test::expect_near(vec3(coordinate(0), coordinate(1), coordinate(2)), vec3(-at.x, at.y, at.z), 1e-6f);
      for (const vec3& n : {vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0.6f, 0.64f, 0.48f)}) {
        const vec3 mirrored(-n.x, n.y, n.z);
        test::expect_near(unity_diffuse(file["light"], i, mirrored), field_irradiance(at, n, linear) / pi,
                          six_digits);
      }
    }
    for (const char* word : {"ssphh-unity-probes", "27 * p + n", "positions", "#endif"})
      EXPECT_THAT(std::string(text_of(files.files.at(1))), testing::HasSubstr(word));
  }
}

TEST(Scales, GltfHoldsEveryProbesRadianceOfAllBands) {
  for (const bool linear : {false, true}) {
    const probes::ProbeSet set = field_set(linear, 3);
    const GltfReader file(exported("gltf", set));
    ASSERT_EQ(file.places.size(), set.probes.size());
    for (std::size_t i = 0; i < file.places.size(); ++i) {
      EXPECT_EQ(file.places[i], set.probes[i].position);
      EXPECT_TRUE(std::ranges::equal(file.light[i], set.probes[i].reflected.values));
      for (const vec3& n : {vec3(1, 0, 0), vec3(0, -1, 0), vec3(0.6f, 0, 0.8f)})
        test::expect_near(irradiance_of(file.light[i], n), field_irradiance(file.places[i], n, linear),
                          1e-3f);
      EXPECT_EQ(file.document["nodes"][i]["name"], set.probes[i].name);
    }
    EXPECT_THAT(test::schema_errors(test::source_dir() / "schemas/light-probes-extension.schema.json",
                                    json::print(file.document["extensions"]["SSPHH_light_probes"])),
                testing::IsEmpty());
  }
}

TEST(Scales, AGroupAloneIsItsShareOfTheSum) {
  probes::ProbeSet set = field_set(false);
  set.light_groups.push_back({"sky", vec3(1)});
  for (probes::Probe& probe : set.probes) probe.groups.push_back({{}, sh::RadianceSh(2)});
  for (probes::Probe& probe : set.probes) probe.groups[1].reflected[0] = vec3(1, 2, 3);
  probes::merge_groups(set);
  const vec3 at(0.1f, 0.2f, 0.3f), up(0, 1, 0);
  const vec3 both = ThreeReader(exported("three", set)).irradiance(at, up);
  const vec3 lamp = ThreeReader(exported("three", only_group(set, "lamp"))).irradiance(at, up);
  const vec3 sky = ThreeReader(exported("three", only_group(set, "sky"))).irradiance(at, up);
  test::expect_near(sky, 0.886227f * vec3(1, 2, 3), for_half_floats);
  test::expect_near(lamp + sky, both, for_half_floats);
  EXPECT_THAT(test::message_of([&] { only_group(set, "moon"); }), testing::HasSubstr("none of: lamp, sky"));
}

TEST(Scales, SameBitsWhateverTheNumberOfThreads) {
  for (const char* target : {"three", "bevy", "babylon", "playcanvas"}) {
    const Exported one = [&] {
      const test::Threads limit(1);
      return exported(target, field_set(true));
    }();
    const Exported many = exported(target, field_set(true));
    for (std::size_t i = 0; i < one.files.size(); ++i) EXPECT_EQ(one.files[i].data, many.files[i].data);
  }
}

TEST(Scales, WhatHasNoHalfFloatIsNamed) {
  probes::ProbeSet set = field_set(false);
  relight(set, "lamp", vec3(1e5f));
  EXPECT_THAT(test::message_of([&] { exported("three", set); }),
              testing::HasSubstr("is more than a half float holds"));
}

TEST(Grid, TooManyPointsAreNamedWithMetresThatFit) {
  const probes::ProbeSet set = field_set(false);
  const FreeLight light(set, open_space, probes::ProbeLight::reflected);
  GridParams params{.spacing = 0.002f};
  const std::string said = test::message_of([&] { fit_grid(set, light, params); });
  EXPECT_THAT(said, testing::HasSubstr("0.002 m make 1e+09 points of 2 x 2 x 2 m"));
  const std::size_t at = said.find('(');
  ASSERT_NE(at, std::string::npos) << said;
  params.spacing = std::stof(said.substr(at + 1));
  EXPECT_GT(fit_grid(set, light, params).count(), params.most / 2);
}

TEST(Losses, NameWhatASetHasAndATargetHasNot) {
  const probes::ProbeSet plain = field_set(false);
  const std::vector<std::string> few = lost(plain, find_target("three"));
  EXPECT_THAT(few, testing::ElementsAre(testing::HasSubstr("poses"), testing::HasSubstr("visibility")));
  probes::ProbeSet set = field_set(false, 4);
  set.light_groups = {{"lamp", vec3(2)}, {"sky", vec3(1), scene::LightMode::baked}};
  for (probes::Probe& probe : set.probes) probe.groups.push_back({sh::RadianceSh(4), sh::RadianceSh(4)});
  set.surface.emplace().points.resize(3);
  set.fitted.emplace();
  set.probes[0].edges.push_back({1, 0.5f, sh::RadianceSh(4), {}});
  set.hierarchy.emplace();
  const std::vector<std::string> many = lost(set, find_target("three"));
  for (const char* word : {"bands 3 to 4", "lamp, sky are summed", "baked groups is within (sky)",
                           "3 surface records", "fitted weights", "1 edge between", "hierarchy"})
    EXPECT_THAT(many, testing::Contains(testing::HasSubstr(word)));
  EXPECT_THAT(test::message_of([&] { only_group(set, "sky"); }), testing::HasSubstr("hierarchy"));
}

TEST(Scales, GridsHaveAsManyCellsAsCommonTexturesHold) {
  EXPECT_EQ(GridParams().most_cells, 290);
  EXPECT_EQ(GridParams().most, std::size_t{1} << 20);
}

}  // namespace
}  // namespace ssphh::probe_export
