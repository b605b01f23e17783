// pbrt-v4's scene files, against their documentation (pbrt.org/fileformat-v4).

#include <map>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/image/io.h>
#include <ssphh/scene/builtin.h>

#include "export_fixture.h"
#include "pbrt_reader.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

/// Types of the parameters of each implementation; several types are separated by blanks.
const std::map<std::string, std::map<std::string, std::string>>& implementations() {
  static const std::map<std::string, std::string> imagemap = {
      {"filename", "string"}, {"wrap", "string"}, {"filter", "string"}, {"encoding", "string"}};
  static const std::map<std::string, std::map<std::string, std::string>> table = {
      {"Camera perspective", {{"fov", "float"}, {"screenwindow", "float"}}},
      {"Camera orthographic", {{"screenwindow", "float"}}},
      {"Film rgb",
       {{"xresolution", "integer"},
        {"yresolution", "integer"},
        {"filename", "string"},
        {"savefp16", "bool"}}},
      {"PixelFilter box", {{"xradius", "float"}, {"yradius", "float"}}},
      {"Sampler independent", {{"pixelsamples", "integer"}, {"seed", "integer"}}},
      {"Integrator path", {{"maxdepth", "integer"}}},
      {"LightSource point", {{"I", "rgb"}, {"from", "point3"}, {"scale", "float"}}},
      {"LightSource spot",
       {{"I", "rgb"},
        {"from", "point3"},
        {"to", "point3"},
        {"coneangle", "float"},
        {"conedeltaangle", "float"}}},
      {"LightSource distant", {{"L", "rgb"}, {"from", "point3"}, {"to", "point3"}}},
      {"LightSource infinite", {{"L", "rgb"}, {"filename", "string"}}},
      {"AreaLightSource diffuse", {{"L", "rgb"}, {"filename", "string"}, {"twosided", "bool"}}},
      {"Texture float imagemap", imagemap},
      {"Texture spectrum imagemap", imagemap},
      {"material diffuse", {{"reflectance", "rgb texture"}, {"normalmap", "string"}}},
      {"material coateddiffuse",
       {{"reflectance", "rgb texture"},
        {"roughness", "float texture"},
        {"remaproughness", "bool"},
        {"eta", "float"},
        {"normalmap", "string"}}},
      {"material conductor",
       {{"reflectance", "rgb texture"},
        {"roughness", "float texture"},
        {"remaproughness", "bool"},
        {"normalmap", "string"}}},
      {"material mix", {{"materials", "string"}, {"amount", "float texture"}}},
      {"Shape plymesh", {{"filename", "string"}, {"alpha", "float texture"}}},
      {"Shape sphere", {{"radius", "float"}}},
  };
  return table;
}

void check_parameters(const PbrtStatement& s, const std::string& key, const std::filesystem::path& directory,
                      const std::map<std::string, std::string>& textures) {
  const auto known = implementations().find(key);
  ASSERT_NE(known, implementations().end()) << key;
  for (const auto& [name, p] : s.parameters) {
    if (name == "type" && s.directive == "MakeNamedMaterial") continue;
    const auto allowed = known->second.find(name);
    ASSERT_NE(allowed, known->second.end()) << key << " has no " << name;
    EXPECT_THAT(" " + allowed->second + " ", testing::HasSubstr(" " + p.type + " ")) << key << " " << name;
    if (p.type == "rgb" || p.type == "point3") {
      EXPECT_EQ(p.numbers.size(), 3u);
    }
    if (name == "reflectance") {
      for (const float x : p.numbers) EXPECT_TRUE(x >= 0 && x <= 1);
    }
    if (p.type == "bool") {
      EXPECT_TRUE(p.strings.at(0) == "true" || p.strings.at(0) == "false");
    }
    if (p.type == "texture") {
      const auto texture = textures.find(p.strings.at(0));
      ASSERT_NE(texture, textures.end()) << p.strings.at(0) << " is defined nowhere before";
      EXPECT_EQ(texture->second, name == "reflectance" ? "spectrum" : "float");
    }
    if ((name == "filename" && s.directive != "Film") || name == "normalmap") {
      EXPECT_TRUE(std::filesystem::is_regular_file(directory / p.strings.at(0))) << p.strings.at(0);
    }
    if (name == "wrap") {
      EXPECT_TRUE(p.strings.at(0) == "repeat" || p.strings.at(0) == "clamp");
    }
    if (name == "filter") {
      EXPECT_TRUE(p.strings.at(0) == "point" || p.strings.at(0) == "bilinear");
    }
  }
}

void check_scene(const std::vector<PbrtStatement>& statements, const std::filesystem::path& directory) {
  std::map<std::string, std::string> textures;
  std::set<std::string> materials;
  bool world = false;
  int depth = 0;
  for (const PbrtStatement& s : statements) {
    const bool is_option =
        std::set<std::string>{"Camera", "Film", "PixelFilter", "Sampler", "Integrator"}.contains(s.directive);
    if (is_option) {
      EXPECT_FALSE(world) << s.directive;
    }
    if (s.directive == "WorldBegin") world = true;
    if (s.directive == "AttributeBegin") ++depth;
    if (s.directive == "AttributeEnd") {
      EXPECT_GE(--depth, 0);
    }
    if (s.directive == "Transform") {
      EXPECT_EQ(s.numbers.size(), 16u);
    }
    if (s.directive == "Translate") {
      EXPECT_EQ(s.numbers.size(), 3u);
    }
    if (s.directive == "NamedMaterial") {
      EXPECT_TRUE(materials.contains(s.names[0])) << s.names[0];
    }
    if (is_option || s.directive == "LightSource" || s.directive == "AreaLightSource" ||
        s.directive == "Shape")
      check_parameters(s, s.directive + " " + s.names[0], directory, textures);
    if (s.directive == "Material") check_parameters(s, "material " + s.names[0], directory, textures);
    if (s.directive == "Texture") {
      check_parameters(s, "Texture " + s.names[1] + " " + s.names[2], directory, textures);
      EXPECT_TRUE(textures.emplace(s.names[0], s.names[1]).second) << s.names[0] << " twice";
    }
    if (s.directive == "MakeNamedMaterial") {
      check_parameters(s, "material " + s.at("type").strings.at(0), directory, textures);
      EXPECT_TRUE(materials.insert(s.names[0]).second) << s.names[0] << " twice";
      if (s.at("type").strings.at(0) == "mix") {
        EXPECT_EQ(s.at("materials").strings.size(), 2u);
        for (const std::string& m : s.at("materials").strings) EXPECT_TRUE(materials.contains(m)) << m;
      }
    }
    if (s.directive == "Shape" && s.names[0] == "plymesh") read_ply(directory / s.at("filename").strings[0]);
  }
  EXPECT_TRUE(world);
  EXPECT_EQ(depth, 0);
}

std::vector<PbrtStatement> pbrt_statements(const scene::Scene& scene,
                                           const scene_io::ExportSettings& settings, const TempDir& dir) {
  const scene_io::ExportReport report = scene_io::export_pbrt(scene, settings, dir.path());
  for (const auto& file : report.files) EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
  return parse_pbrt(read_text_file(dir / "scene.pbrt"));
}

const PbrtStatement& find(const std::vector<PbrtStatement>& statements, const std::string& directive,
                          const std::string& name = "") {
  for (const PbrtStatement& s : statements)
    if (s.directive == directive && (name.empty() || s.names.at(0) == name)) return s;
  throw std::runtime_error("no " + directive + " " + name);
}

TEST(ExportPbrt, EveryStatementIsDocumented) {
  const TempDir dir;
  const std::vector<PbrtStatement> s = pbrt_statements(scene_of_everything(), export_settings(), dir);
  check_scene(s, dir.path());
  EXPECT_EQ(find(s, "Integrator").at("maxdepth").numbers, std::vector<float>{3});
}

TEST(ExportPbrt, BuiltinScenesAreDocumentedToo) {
  for (const char* name : {"box", "cornell", "two-rooms"}) {
    const TempDir dir;
    const scene::Scene scene = scene::make_builtin(name);
    scene_io::ExportSettings settings = export_settings();
    settings.camera = scene::camera_pose(scene, "");
    check_scene(pbrt_statements(scene, settings, dir), dir.path());
  }
}

// The camera looks along +z with y up; the screen window has its corners at z = 1, scaled by tan(fov/2).
TEST(ExportPbrt, TheCameraSeesTheSamePicture) {
  for (const bool orthographic : {false, true}) {
    const TempDir dir;
    scene_io::ExportSettings settings = export_settings();
    settings.camera.camera.orthographic = orthographic, settings.camera.camera.yheight = 5;
    const std::vector<PbrtStatement> s = pbrt_statements(scene::make_builtin("box"), settings, dir);
    mat4 m;
    for (int i = 0; i < 16; ++i)
      m[i / 4][i % 4] = find(s, "Transform").numbers.at(static_cast<std::size_t>(i));
    const PbrtStatement& camera = find(s, "Camera");
    const std::vector<float>& window = camera.at("screenwindow").numbers;
    ASSERT_EQ(window.size(), 4u);
    for (const vec3& p : visible_points()) {
      const vec3 c(m * vec4(p, 1));
      EXPECT_GT(c.z, 0);
      vec2 screen(c);
      if (!orthographic) screen /= c.z * std::tan(glm::radians(camera.at("fov").numbers.at(0)) / 2);
      const vec2 place((screen.x - window[0]) / (window[1] - window[0]),
                       (window[3] - screen.y) / (window[3] - window[2]));
      const vec2 ours = place_on_picture(settings, p);
      EXPECT_NEAR(place.x, ours.x, 1e-4f);
      EXPECT_NEAR(place.y, ours.y, 1e-4f);
    }
  }
}

// A file for each face, which includes the world.
TEST(ExportPbrt, ACubeMapHasAFileForEachFace) {
  const TempDir dir;
  const scene_io::ExportReport report =
      scene_io::export_pbrt(scene_of_everything(), cube_settings(), dir.path());
  for (const auto& file : report.files) EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
  const std::string world = read_text_file(dir / "world.pbrt"), include = "Include \"world.pbrt\"\n";
  for (std::size_t face = 0; face < 6; ++face) {
    EXPECT_EQ(report.files[face], dir / fmt::format("face{}.pbrt", face));
    std::string text = read_text_file(report.files[face]);
    ASSERT_TRUE(text.ends_with(include));
    text.replace(text.size() - include.size(), include.size(), world);
    const std::vector<PbrtStatement> s = parse_pbrt(text);
    check_scene(s, dir.path());
    const PbrtStatement& film = find(s, "Film");
    EXPECT_EQ(film.at("filename").strings[0], fmt::format("face{}.exr", face));
    for (const char* side : {"xresolution", "yresolution"}) EXPECT_EQ(film.at(side).numbers[0], 16);
    const PbrtStatement& camera = find(s, "Camera");
    EXPECT_EQ(camera.at("fov").numbers[0], 90);
    EXPECT_EQ(camera.at("screenwindow").numbers, (std::vector<float>{-1, 1, -1, 1}));
    mat4 to_camera;
    for (int i = 0; i < 16; ++i)
      to_camera[i / 4][i % 4] = find(s, "Transform").numbers.at(static_cast<std::size_t>(i));
    const mat4 to_world = glm::inverse(to_camera);
    expect_camera_of_face(face, vec3(to_world[3]), vec3(to_world[2]), vec3(to_world[0]), vec3(to_world[1]));
  }
  EXPECT_THAT(report.command, testing::HasSubstr("face$f.pbrt"));
  EXPECT_THAT(differences_with(report, "lamps and sky are in the pictures").at(0),
              testing::HasSubstr("globe"));
}

/// Clarberg's map from the sphere to the square.
vec2 equal_area_place(const vec3& d) {
  const float r = std::sqrt(1 - std::abs(d.z));
  const float phi = std::atan2(std::abs(d.y), std::abs(d.x)) * 2 / pi;
  float v = phi * r, u = r - v;
  if (d.z < 0) {
    const float swapped = 1 - u;
    u = 1 - v, v = swapped;
  }
  return {0.5f + 0.5f * std::copysign(u, d.x), 0.5f + 0.5f * std::copysign(v, d.y)};
}

TEST(ExportPbrt, TheEnvironmentLooksTheSameInEveryDirection) {
  const TempDir dir;
  const scene::Scene scene = scene_of_everything();
  const std::vector<PbrtStatement> s = pbrt_statements(scene, export_settings(), dir);
  const image::Image image =
      image::read_image(dir / find(s, "LightSource", "infinite").at("filename").strings[0]);
  ASSERT_EQ(image.width, image.height);  // pbrt refuses others
  for (const vec3& d : directions_around()) {
    const vec2 place = equal_area_place(d) * static_cast<float>(image.width);
    const vec3 value = image.rgb(static_cast<int>(place.x), static_cast<int>(place.y));
    const vec3 ours = environment_radiance(*scene.environment, d);
    // The nearest of 64 × 64 pixels, up to 2 degrees away, of an image whose slope is below 0.8 / 0.2 a
    // radian.
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(value[c], ours[c], 0.15f * ours[c]) << d.x << " " << d.y << " " << d.z;
  }
}

TEST(ExportPbrt, LightsStandAndShineWhereTheyDoHere) {
  const TempDir dir;
  const scene::Scene scene = scene_of_everything();
  const std::vector<PbrtStatement> s = pbrt_statements(scene, export_settings(), dir);
  const std::vector<mat4> world = scene::world_matrices(scene);
  const auto place = [&](std::size_t light) { return world[scene.lights[light].node]; };
  const PbrtStatement& point = find(s, "LightSource", "point");
  EXPECT_LT(glm::distance(point.vector("from"), vec3(place(0)[3])), 1e-5f);
  EXPECT_EQ(point.vector("I"), vec3(8, 4, 2));
  const PbrtStatement& spot = find(s, "LightSource", "spot");
  EXPECT_LT(glm::distance(spot.vector("to") - spot.vector("from"), -vec3(place(1)[2])), 1e-5f);
  EXPECT_NEAR(spot.at("coneangle").numbers[0], glm::degrees(0.5f), 1e-4f);
  EXPECT_NEAR(spot.at("conedeltaangle").numbers[0], glm::degrees(0.3f), 1e-4f);
  const PbrtStatement& sun = find(s, "LightSource", "distant");
  EXPECT_LT(glm::distance(sun.vector("to") - sun.vector("from"), -vec3(place(2)[2])), 1e-5f);
  EXPECT_EQ(sun.vector("L"), vec3(8, 4, 2));
}

// v points up in pbrt's images; one transform, the base colour's, is in the mesh.
TEST(ExportPbrt, TextureCoordinatesAreTransformedAndTurnedUp) {
  const TempDir dir;
  const scene::Scene scene = scene_of_everything();
  pbrt_statements(scene, export_settings(), dir);
  const Ply ply = read_ply(dir / "mesh2.ply");
  const std::size_t u = ply.properties.size() - 2;
  for (std::size_t i = 0; i < ply.vertices.size(); ++i) {
    const vec2 uv = scene.meshes[2].uvs[0][i], scaled(2 * uv.x, 3 * uv.y);
    const vec2 wanted(std::cos(0.3f) * scaled.x + std::sin(0.3f) * scaled.y + 0.25f,
                      1 - (-std::sin(0.3f) * scaled.x + std::cos(0.3f) * scaled.y + 0.5f));
    EXPECT_NEAR(ply.vertices[i][u], wanted.x, 1e-5f);
    EXPECT_NEAR(ply.vertices[i][u + 1], wanted.y, 1e-5f);
  }
}

TEST(ExportPbrt, WhatDiffersIsSaid) {
  const TempDir dir;
  const scene_io::ExportReport report =
      scene_io::export_pbrt(scene_of_everything(), export_settings(), dir.path());
  for (const char* part :
       {"range: lamp", "spots fade", "unseen: sun", "sphere lights block other light: globe",
        "coateddiffuse (exact", "conductor (exact", "becomes a mix", "Blinn-Phong", "Oren-Nayar", "tangents",
        "cut-outs", "unlit", "vertex colours", "spectra", "equal-area"})
    EXPECT_EQ(differences_with(report, part).size(), 1u) << part;
  const TempDir plain;
  EXPECT_THAT(scene_io::export_pbrt(scene::make_builtin("box"), export_settings(), plain.path()).differences,
              testing::Each(testing::StartsWith("colours are spectra")));
}

}  // namespace
}  // namespace ssphh::test
