// What the functions of lamps, suns and things say, number by number and word by word.

#include <gtest/gtest.h>

#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/calendar.h>
#include <ssphh/scene/lamp_profile.h>
#include <ssphh/scene/studio.h>
#include <ssphh/scene/sun_position.h>
#include <ssphh/scene/thing_alone.h>
#include <ssphh/scene/turn_surroundings.h>

#include "error_message.h"
#include "number_list.h"

namespace ssphh::scene {
namespace {

TEST(SceneFunctions, OfSunsAreThoseOfTheList) {
  test::NumberList list;
  const auto add = [&](const char* name, const SunTime& time) {
    const SunPosition p = sun_position(time);
    list.add(name, p.elevation, p.refraction, p.azimuth);
  };
  SunTime munich{
      .year = 2026, .month = 3, .day = 21, .hour = 0, .utc_offset = 1, .latitude = 48.1, .longitude = 11.6};
  for (double hour = 0.25; hour < 48; hour += 1.9) munich.hour = hour, add("Munich", munich);
  munich.hour = 6.3;  // the sun rises
  for (int k = 0; k < 8; ++k) munich.hour += 0.02, add("rising", munich);
  for (int month = 1; month <= 12; ++month)
    add("Quito", {.year = 1900 + 17 * month - 4,
                  .month = month,
                  .day = 28,
                  .hour = 12.25,
                  .utc_offset = -5,
                  .latitude = -0.2,
                  .longitude = -78.5});
  add("pole", {.hour = 3, .latitude = -90, .longitude = 180});
  for (const double longitude : {-180.0, -7.4, -7.6, 7.4, 7.6, 11.6, 172.6})
    list.add("nautical", nautical_utc_offset(longitude));
  for (const int year : {1900, 2000, 2024, 2026, 2100})
    for (const int month : {1, 2, 4, 12}) list.add("days", days_of_month(year, month));
  list.expect("libs/scene/tests/expected/suns.txt");
}

TEST(SceneFunctions, OfWrittenTimesAreThoseOfTheList) {
  std::string text;
  const auto add = [&](const std::string& what, const auto& read) {
    const std::string error = test::message_of([&] { text += what + ": " + read(); });
    text += (error == "no error" ? "" : what + ": " + error) + "\n";
  };
  for (const char* word :
       {"2026-06-21", "1899-1-1", "1900-1-1", "2100-12-31", "2101-1-1", "2023-2-29", "2024-2-29", "2026-13-1",
        "2026-4-31", "2026-06", "2026-06-21-1", "2026-6.5-1", "2026-0-1", "2026-1-0", ""})
    add(word, [&] {
      SunTime t;
      read_date(t, word, "--date");
      return fmt::format("{} {} {}", t.year, t.month, t.day);
    });
  for (const char* word : {"17:30", "17:30:15", "00:00", "24:00", "24:01", "23:59:59.5", "17", "17:60",
                           "17:59:60", "1.5:30", "17:2.5", "17:30:15:1", "-1:30", "7:-1", "late"})
    add(word, [&] { return fmt::format("{:.8g}", read_hour(word, "--time-of-day")); });
  for (const char* word : {"48.1,11.6", "-90,180", "90.1,0", "0,-180.5", "1", "1,2,3", "a,b"})
    add(word, [&] {
      SunTime t;
      read_place(t, word, "--place");
      return fmt::format("{} {}", t.latitude, t.longitude);
    });
  for (const double hour : {0.0, 17.5, 17.5042, 23.9999, 24.0, 24.25, 47.5})
    text += fmt::format("{}: {}\n", hour, clock_text(hour));
  test::expect_text_of("libs/scene/tests/expected/times.txt", text);
}

TEST(SceneFunctions, OfLampsAreThoseOfTheList) {
  test::NumberList list;
  PhotometricTable table;
  table.polar = {0, 30, 75, 120}, table.turn = {10, 90, 200, 310};
  for (int i = 0; i < 16; ++i) table.candela.push_back(static_cast<float>(1 + i * 7 % 11));
  PhotometricTable round = table;
  round.turn = {0}, round.candela.resize(4);
  const vec3 directions[] = {{0, 0, 1},        {0, 0, -1},          {1, 0, 0},           {0, 1, 0.5f},
                             {-1, 0.3f, 0.2f}, {0.4f, -0.8f, 0.1f}, {0.9f, 0.1f, -0.2f}, {0.1f, -0.02f, 1}};
  for (const PhotometricTable& t : {table, round}) {
    for (const vec3& d : directions) list.add("candela", d, eval_candela(t, glm::normalize(d)));
    list.add("greatest, mean", greatest_candela(t), mean_candela(t));
  }
  for (const Photometry type : {Photometry::a, Photometry::b, Photometry::c}) {
    const mat3 axes = photometric_axes(type);
    list.add("axes", axes[0], axes[1], axes[2]);
  }
  for (const Lobe lobe : {Lobe::uniform, Lobe::cosine, Lobe::beam}) {
    const sh::IntensitySh e = lobe_emission(lobe, glm::normalize(vec3(1, 2, -1)), 0.6f);
    list.add("lobe", e.values.size(), e.values[0], e.values.back(), mean_intensity(e));
    for (const vec3& d : directions) list.add("  toward", eval_intensity(e, glm::normalize(d)));
  }
  Emission film;
  for (int i = 0; i < 3; ++i)
    film.frames.emplace_back(0), film.frames.back().values[0] = vec3(1 + i * i, 2 + i, 3);
  film.rate = 4, film.start = 0.5f;
  for (const bool repeat : {false, true}) {
    film.repeat = repeat;
    list.add("end", emission_end(film));
    for (const float time : {-1.1f, 0.5f, 0.6f, 0.8f, 1.0f, 1.2f, 1.25f, 9.3f})
      list.add("  at", time, emission_at(film, time).values[0]);
  }
  for (const vec3& d : directions) list.add("studio", studio_radiance(glm::normalize(d)));
  list.expect("libs/scene/tests/expected/lamps.txt");
}

TEST(SceneFunctions, OfThingsAreThoseOfTheScene) {
  Scene scene;
  for (int i = 0; i < 45; ++i) {
    scene.nodes.emplace_back().name = "n" + std::to_string(i);
    scene.instances.push_back({0, i, -1, ""});
  }
  scene.meshes.emplace_back();
  scene.nodes[5].parent = 3, scene.nodes[7].parent = 5, scene.nodes[8].name = "n9", scene.nodes[10].name = "";
  for (const LightType type : {LightType::point, LightType::directional, LightType::spot}) {
    Light& light = scene.lights.emplace_back();
    light.type = type, light.node = type == LightType::spot ? 4 : 7;
  }
  scene.environment.emplace(), scene.cameras.emplace_back(), scene.sphls.emplace_back();
  scene.cameras[0].node = scene.sphls[0].node = 7;
  scene.light_modes = {{"environment", LightMode::baked}};
  const auto said = [&](const char* name) { return test::message_of([&] { find_node(scene, name); }); };
  EXPECT_EQ(find_node(scene, "n7"), 7);
  EXPECT_TRUE(said("n9").starts_with("node \"n9\": 2 nodes have that name (there are: n0, n1, n2, "))
      << said("n9");
  EXPECT_TRUE(said("x").starts_with("node \"x\": the scene has none of that name (there are: n0, "))
      << said("x");
  EXPECT_TRUE(said("x").ends_with(", n40, n41, ...)")) << said("x");
  const Scene alone = thing_alone(scene, 3);
  ASSERT_EQ(alone.instances.size(), 3u);
  EXPECT_EQ(alone.instances[0].node, 3);
  EXPECT_EQ(alone.instances[1].node, 5);
  EXPECT_EQ(alone.instances[2].node, 7);
  ASSERT_EQ(alone.lights.size(), 1u);
  EXPECT_EQ(alone.lights[0].type, LightType::point);
  EXPECT_FALSE(alone.environment);
  EXPECT_TRUE(alone.light_modes.empty() && alone.cameras.empty() && alone.sphls.empty());
  for (const int node : {-1, 45})
    EXPECT_EQ(test::message_of([&] { thing_alone(scene, node); }), "thing: the scene has no such node");
}

}  // namespace
}  // namespace ssphh::scene
