// Charts, layout, texels, places, light and the lit scene of one small room, number by number.

#include <gmock/gmock.h>

#include <ssphh/lightmap/encode.h>
#include <ssphh/lightmap/lit_scene.h>

#include "error_message.h"
#include "expected_text.h"
#include "rooms.h"
#include "scene_text.h"
#include "triangle_source.h"

namespace ssphh::lightmap {
namespace {

/// A floor, a crate that stands a little in it, a ball, a bent sheet with coordinates of its own, and a
/// gable; turned and scaled unevenly, one of them mirrored.
scene::Scene small_room() {
  scene::Mesh sheet = scene::make_quad({0, 0, 0}, {1, 0.2f, 0}, {0, 0.3f, 1});
  sheet.name = "sheet", sheet.uvs[1] = {{0.1f, 0.2f}, {0.9f, 0.1f}, {0.8f, 0.9f}, {0.1f, 0.8f}};
  scene::Mesh gable;
  gable.positions = {{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1.2f}, {0, 1, 2}, {2, 1.1f, 2}, {1, 1, 0}};
  gable.triangles = {{0, 2, 1}, {0, 3, 2}, {3, 5, 2}, {3, 4, 5}, {0, 1, 6}, {1, 1, 2}};
  scene::Scene scene = scene_of({scene::make_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}),
                                 scene::make_box({-0.4f, -0.02f, -0.3f}, {0.4f, 0.9f, 0.5f}),
                                 scene::make_sphere(0.5f, 8, 5), sheet, gable});
  scene.nodes[1].matrix =
      mat4(vec4(0.9f, 0, 0.3f, 0), vec4(0, 1, 0, 0), vec4(-0.3f, 0, 0.9f, 0), vec4(0.5f, 0, 0.2f, 1));
  scene.nodes[2].matrix =
      mat4(vec4(-1, 0, 0, 0), vec4(0, 1.4f, 0, 0), vec4(0, 0, 1, 0), vec4(-1, 1.1f, -1, 1));
  scene.nodes[3].matrix =
      mat4(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0), vec4(-1.6f, 0.4f, 0.6f, 1));
  scene.nodes[4].matrix =
      mat4(vec4(0.5f, 0, 0, 0), vec4(0, 0.5f, 0, 0), vec4(0, 0, 0.5f, 0), vec4(0.9f, 0.01f, -1.7f, 1));
  return scene;
}

template <class Values>
std::string numbers_of(const Values& values) {
  std::vector<float> numbers;
  for (const auto& v : values) numbers.push_back(static_cast<float>(v));
  return test::array_text(numbers.data(), numbers.size(), 1);
}

std::string texels_text(const Texels& texels) {
  std::string text;
  std::vector<float> indices, faces, shares, ways, face;
  for (const Texel& t : texels.texels) {
    indices.push_back(static_cast<float>(t.index)), faces.push_back(static_cast<float>(t.face));
    for (int c = 0; c < 3; ++c) shares.push_back(t.share[c]);
    for (int c = 0; c < 2; ++c) ways.push_back(t.way[c]);
  }
  for (const Face& f : texels.faces) {
    for (std::size_t k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c)
        face.insert(face.end(),
                    {f.position[k][c], f.normal[k][c], c < 2 ? f.at[k][c] : f.front[static_cast<int>(k)]});
    face.push_back(f.open), face.push_back(f.moves);
  }
  text += fmt::format("texels {}\n of faces {}\n shares {}\n ways {}\n faces {}\n first {}\n",
                      numbers_of(indices), numbers_of(faces), numbers_of(shares), numbers_of(ways),
                      numbers_of(face), numbers_of(texels.first));
  return text;
}

std::string mesh_text(const scene::Mesh& m) {
  const auto floats = [](const auto& v) {
    return v.empty() ? std::string("none")
                     : test::array_text(&v[0][0], v.size(), static_cast<std::size_t>(v[0].length()));
  };
  std::vector<uvec3> triangles = m.triangles;
  return fmt::format(
      "mesh \"{}\" {}\n positions {}\n normals {}\n tangents {}\n colours {}\n uvs {}\n uvs {}\n triangles "
      "{}\n",
      m.name, m.material, floats(m.positions), floats(m.normals), floats(m.tangents), floats(m.colors),
      floats(m.uvs[0]), floats(m.uvs[1]), floats(triangles));
}

TEST(AtlasList, OfASmallRoom) {
  const Unwrapped u(small_room(), {.size = 96});
  std::string text;
  for (const Chart& chart : u.charts.charts) {
    text += fmt::format("chart of {}, {:.6g} {:.6g}\n", chart.instance, chart.size.x, chart.size.y);
    if (chart.triangles.size() > 4) {
      std::vector<float> all;
      for (const FlatTriangle& t : chart.triangles) {
        all.push_back(static_cast<float>(t.triangle)), all.push_back(t.open);
        for (const vec2& at : t.at) all.push_back(at.x), all.push_back(at.y);
      }
      text += fmt::format("  {} {}\n", chart.triangles.size(), numbers_of(all));
    } else {
      for (const FlatTriangle& t : chart.triangles)
        text += fmt::format("  {} open {}: {:.6g} {:.6g}, {:.6g} {:.6g}, {:.6g} {:.6g}\n", t.triangle, t.open,
                            t.at[0].x, t.at[0].y, t.at[1].x, t.at[1].y, t.at[2].x, t.at[2].y);
    }
  }
  text += fmt::format("layout {} {} density {:.6g}\n", u.layout.width, u.layout.height, u.layout.density);
  for (const PlacedChart& p : u.layout.places)
    text += fmt::format("  {} {} of {} {}, {:.6g} {:.6g}\n", p.first.x, p.first.y, p.count.x, p.count.y,
                        p.scale.x, p.scale.y);
  text += texels_text(u.texels);

  const test::TriangleSource source(u.scene);
  const Places places = find_places(u.texels, rays::PosedWorld(source, 0));
  std::vector<float> points;
  for (const rays::SurfacePoint& p : places.points)
    for (int c = 0; c < 3; ++c) points.push_back(p.position[c]), points.push_back(p.normal[c]);
  text += fmt::format("places {}\n hidden {} of {}\n", numbers_of(points), numbers_of(places.hidden),
                      places.hidden_count);
  const image::Image atlas = light_texels(u.texels, places, [](const rays::SurfacePoint& at) {
    return vec3(3 + at.position.x * at.position.z, 2 + at.position.y + at.normal.y,
                4 + std::sin(5 * at.position.x));
  });
  text += fmt::format("atlas {}\n", numbers_of(atlas.pixels));
  for (const vec2& uv : {vec2(0), vec2(1), vec2(0.31f, 0.12f), vec2(0.5f, 0.07f), vec2(0.999f, 0.3f)}) {
    const vec3 e = sample(atlas, uv);
    text += fmt::format("  {:g} {:g}: {:.6g} {:.6g} {:.6g}\n", uv.x, uv.y, e.x, e.y, e.z);
  }
  const Rgbm rgbm = encode_rgbm(atlas);
  text += fmt::format("rgbm {:g} {}\n", rgbm.scale, numbers_of(rgbm.picture.rgba));
  const scene::Scene lit = with_lightmap(u.scene, u.charts.charts, u.layout);
  for (const scene::Mesh& mesh : lit.meshes) text += mesh_text(mesh);
  for (const scene::Instance& i : lit.instances)
    text += fmt::format("instance {} {} {}\n", i.mesh, i.node, i.material);
  test::expect_text_of("libs/lightmap/tests/expected/room.txt", text);
}

TEST(AtlasList, OfLayoutsAndRefusals) {
  const std::vector<Chart> charts = make_charts(small_room(), 0).charts;
  std::string text;
  const auto add = [&](const char* name, const std::vector<Chart>& some, const LayoutParams& params) {
    text += std::string(name) + ": ";
    const std::string error = test::message_of([&] {
      const Layout l = lay_out(some, params);
      text += fmt::format("{} {} density {:.5g}, the last {} {} of {} {}", l.width, l.height, l.density,
                          l.places.back().first.x, l.places.back().first.y, l.places.back().count.x,
                          l.places.back().count.y);
    });
    text += (error == "no error" ? "" : error) + "\n";
  };
  for (const int size : {15, 16, 32, 64, 100, 8192, 8193}) add("size", charts, {.size = size});
  add("usual", charts, {});
  for (const float density : {0.0f, -1.0f, NAN, 0.01f, 3.0f, 10.0f, 40.0f, 5000.0f})
    add("density", charts, {.density = density});
  add("both", charts, {.size = 64, .density = 5.0f});
  add("both, too dense", charts, {.size = 64, .density = 500.0f});
  std::vector<Chart> large = charts;
  for (Chart& chart : large) chart.size *= 30;
  add("thirtyfold", large, {});
  for (Chart& chart : large) chart.size *= 10;
  add("three hundredfold", large, {});
  large[0].size.x = 1e9f;
  add("as large as may be", large, {});
  large[0].size.x = 1.1e9f;
  add("larger", large, {});
  add("none", {}, {});
  add("many in little", std::vector<Chart>(200, charts[0]), {.size = 64});
  add("many in little, dense", std::vector<Chart>(200, charts[0]), {.size = 64, .density = 1.0f});
  test::expect_text_of("libs/lightmap/tests/expected/layouts.txt", text);
}

TEST(AtlasList, OfChartsThatAreParted) {
  std::string text;
  const auto add = [&](const char* name, const scene::Scene& scene, const ChartParams& params) {
    const Charts charts = make_charts(scene, 0, params);
    text += fmt::format("{}: {}", name, charts.charts.size());
    for (const Chart& chart : charts.charts)
      text += fmt::format(", {} of {}", chart.triangles.size(), chart.instance);
    text += "\n";
    for (const std::string& note : charts.notes) text += "  " + note + "\n";
  };
  const scene::Scene ball = scene_of({scene::make_sphere(1, 16, 9)});
  for (const float cone : {0.3f, 0.87f, 1.5f}) add("cone", ball, {.cone = cone});
  for (const float crease : {0.1f, 0.35f, 2.0f})
    add("crease", scene_of({scene::make_box(vec3(0), vec3(1)), scene::make_sphere(1, 16, 9)}),
        {.crease = crease});
  scene::Scene flat_ball = ball;
  flat_ball.meshes[0].normals.clear();
  for (const float crease : {0.1f, 0.35f, 0.6f}) add("crease of faces", flat_ball, {.crease = crease});
  scene::Scene room = small_room();
  add("own", room, {.uvs = UvChoice::own});
  text += test::message_of([&] { make_charts(room, 0, {.uvs = UvChoice::scene}); }) + "\n";
  room.materials.resize(6);
  for (int i = 0; i < 5; ++i) room.instances[static_cast<std::size_t>(i)].material = i;
  room.materials[0].unlit = true;
  room.materials[1].transmission = 1;
  room.materials[2].transmission = 0.99f;
  room.materials[3].base_color_texture = {.texture = 0, .uv_set = 0};
  room.materials[3].emission_texture = {.texture = 0, .uv_set = 1};
  room.nodes[4].movable = true;
  room.textures.push_back({"t", 1, 1, {1, 2, 3, 4}});
  add("left out", room, {});
  add("left out, moving", room, {.moving = true});
  test::expect_text_of("libs/lightmap/tests/expected/charts.txt", text);
}

TEST(Rgbm, HoldsWhatItMustAtItsEdges) {
  image::Image picture(3, 1);
  picture.set_rgb(0, 0, {0, 0, 0}), picture.set_rgb(1, 0, {64, 16, -1}), picture.set_rgb(2, 0, {1e-6f, 0, 4});
  const Rgbm rgbm = encode_rgbm(picture);
  EXPECT_EQ(rgbm.scale, 1);
  EXPECT_THAT(rgbm.picture.rgba, testing::ElementsAre(0, 0, 0, 1, 255, 128, 0, 255, 0, 0, 254, 64));
  picture.set_rgb(0, 0, {128, 0, 0});
  EXPECT_EQ(encode_rgbm(picture).scale, 2);
  const auto said = [&](int x, int y) { return test::message_of([&] { decode_rgbm(rgbm, x, y); }); };
  EXPECT_EQ(said(2, 0), "no error");
  for (const auto& [x, y] : {std::pair(3, 0), {-1, 0}, {0, 1}, {0, -1}})
    EXPECT_EQ(said(x, y), "RGBM: the picture has no such texel");
  image::Image gray(1, 1, 1);
  EXPECT_EQ(test::message_of([&] { encode_rgbm(gray); }), "RGBM: an image of three channels is needed");
  picture.pixels[4] = NAN;
  EXPECT_EQ(test::message_of([&] { encode_rgbm(picture); }), "RGBM: a value is not finite");
}

}  // namespace
}  // namespace ssphh::lightmap
