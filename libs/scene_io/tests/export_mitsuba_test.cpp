// Mitsuba 3's scene files, against its documentation (mitsuba.readthedocs.io: scene format, plugin
// reference).

#include <map>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/image/io.h>
#include <ssphh/scene/builtin.h>

#include "export_fixture.h"
#include "temp_dir.h"
#include "xml_reader.h"

namespace ssphh::test {
namespace {

/// Parameters of each plugin: name and the elements that may give it. "bsdf", "emitter" … without a name are
/// nested plugins, listed as "*bsdf".
using Parameters = std::map<std::string, std::string>;
const std::map<std::string, Parameters>& plugins() {
  static const std::map<std::string, Parameters> table = {
      {"integrator path", {{"max_depth", "integer"}, {"rr_depth", "integer"}, {"hide_emitters", "boolean"}}},
      {"integrator volpath",
       {{"max_depth", "integer"}, {"rr_depth", "integer"}, {"hide_emitters", "boolean"}}},
      {"sensor perspective",
       {{"to_world", "transform"},
        {"fov", "float"},
        {"fov_axis", "string"},
        {"near_clip", "float"},
        {"far_clip", "float"},
        {"*sampler", ""},
        {"*film", ""}}},
      {"sensor orthographic",
       {{"to_world", "transform"},
        {"near_clip", "float"},
        {"far_clip", "float"},
        {"*sampler", ""},
        {"*film", ""}}},
      {"sampler independent", {{"sample_count", "integer"}, {"seed", "integer"}}},
      {"film hdrfilm",
       {{"width", "integer"},
        {"height", "integer"},
        {"pixel_format", "string"},
        {"component_format", "string"},
        {"*rfilter", ""}}},
      {"rfilter box", {}},
      {"bsdf twosided", {{"*bsdf", ""}}},
      {"bsdf mask", {{"opacity", "float texture"}, {"*bsdf", ""}}},
      {"bsdf normalmap", {{"normalmap", "texture"}, {"*bsdf", ""}}},
      {"bsdf diffuse", {{"reflectance", "rgb texture"}}},
      {"bsdf roughplastic",
       {{"diffuse_reflectance", "rgb texture"},
        {"specular_reflectance", "rgb texture"},
        {"distribution", "string"},
        {"alpha", "float"},
        {"int_ior", "float"},
        {"ext_ior", "float"},
        {"nonlinear", "boolean"}}},
      {"bsdf roughconductor",
       {{"material", "string"},
        {"specular_reflectance", "rgb texture"},
        {"distribution", "string"},
        {"alpha", "float texture"}}},
      {"bsdf principled",
       {{"base_color", "rgb texture"},
        {"roughness", "float texture"},
        {"metallic", "float texture"},
        {"eta", "float"}}},
      {"texture bitmap",
       {{"filename", "string"},
        {"filter_type", "string"},
        {"wrap_mode", "string"},
        {"raw", "boolean"},
        {"to_uv", "transform"}}},
      {"texture mesh_attribute", {{"name", "string"}}},
      {"shape ply",
       {{"filename", "string"},
        {"face_normals", "boolean"},
        {"to_world", "transform"},
        {"*ref", ""},
        {"*emitter", ""}}},
      {"shape sphere", {{"center", "point"}, {"radius", "float"}, {"*bsdf", ""}, {"*emitter", ""}}},
      {"emitter area", {{"radiance", "rgb texture"}}},
      {"emitter point", {{"position", "point"}, {"intensity", "rgb"}}},
      {"emitter spot",
       {{"intensity", "rgb"}, {"cutoff_angle", "float"}, {"beam_width", "float"}, {"to_world", "transform"}}},
      {"emitter directional", {{"direction", "vector"}, {"irradiance", "rgb"}}},
      {"emitter constant", {{"radiance", "rgb"}}},
      {"emitter envmap", {{"filename", "string"}, {"scale", "float"}, {"to_world", "transform"}}},
  };
  return table;
}

const std::map<std::string, std::set<std::string>>& choices() {
  static const std::map<std::string, std::set<std::string>> table = {
      {"fov_axis", {"x", "y", "diagonal", "smaller", "larger"}},
      {"pixel_format", {"rgb", "rgba", "luminance"}},
      {"component_format", {"float16", "float32"}},
      {"distribution", {"ggx", "beckmann"}},
      {"filter_type", {"nearest", "bilinear"}},
      {"wrap_mode", {"repeat", "mirror", "clamp"}},
      {"material", {"none"}},
  };
  return table;
}

mat4 matrix_of(const XmlElement& transform) {
  const std::vector<float> v = numbers_of(transform.child("matrix").at("value"));
  EXPECT_EQ(v.size(), 16u);
  mat4 m(1);
  for (std::size_t i = 0; i < 16 && i < v.size(); ++i)
    m[static_cast<int>(i % 4)][static_cast<int>(i / 4)] = v[i];
  return m;
}

/// The value of a parameter, none if the plugin does not have it.
const XmlElement* parameter(const XmlElement& plugin, const std::string& name) {
  for (const XmlElement& c : plugin.children) {
    const auto found = c.attributes.find("name");
    if (found != c.attributes.end() && found->second == name) return &c;
  }
  return nullptr;
}

class Checker {
 public:
  explicit Checker(std::filesystem::path directory) : directory_(std::move(directory)) {}

  void check_scene(const XmlElement& scene, std::size_t cameras = 1) {
    EXPECT_EQ(scene.name, "scene");
    EXPECT_EQ(scene.attributes.size(), 1u);
    EXPECT_THAT(scene.at("version"), testing::MatchesRegex("3\\.[0-9]\\.[0-9]"));
    EXPECT_EQ(scene.all("sensor").size(), cameras);
    EXPECT_EQ(scene.all("integrator").size(), 1u);
    for (const XmlElement& c : scene.children) check_plugin(c);
  }

 private:
  void check_plugin(const XmlElement& plugin) {
    const std::string key = plugin.name + " " + plugin.at("type");
    const auto known = plugins().find(key);
    ASSERT_NE(known, plugins().end()) << key;
    for (const auto& [attribute, value] : plugin.attributes) {
      EXPECT_TRUE(attribute == "type" || attribute == "id" || attribute == "name") << key << " " << attribute;
      if (attribute != "id") continue;
      EXPECT_THAT(value, testing::MatchesRegex("[A-Za-z][A-Za-z0-9_]*"));
      EXPECT_TRUE(ids_.insert(value).second) << value << " twice";
    }
    std::set<std::string> seen;
    for (const XmlElement& c : plugin.children) {
      const auto name = c.attributes.find("name");
      const std::string label = name == c.attributes.end() ? "*" + c.name : name->second;
      const auto allowed = known->second.find(label);
      ASSERT_NE(allowed, known->second.end()) << key << " has no " << label;
      EXPECT_TRUE(seen.insert(label).second) << key << ": " << label << " twice";
      if (label.front() != '*') {
        EXPECT_THAT(" " + allowed->second + " ", testing::HasSubstr(" " + c.name + " "))
            << key << " " << label;
      }
      check_value(c, label);
    }
  }

  void check_value(const XmlElement& c, const std::string& label) {
    const auto has_exactly = [&](const std::set<std::string>& wanted) {
      std::set<std::string> got;
      for (const auto& [k, v] : c.attributes) got.insert(k);
      EXPECT_EQ(got, wanted) << c.name;
    };
    if (c.name == "float" || c.name == "integer") {
      has_exactly({"name", "value"});
      EXPECT_EQ(numbers_of(c.at("value")).size(), 1u);
    } else if (c.name == "rgb") {
      has_exactly({"name", "value"});
      const std::vector<float> v = numbers_of(c.at("value"));
      EXPECT_EQ(v.size(), 3u);
      const bool albedo = label.find("reflectance") != std::string::npos || label == "base_color";
      for (const float x : v) EXPECT_TRUE(x >= 0 && (!albedo || x <= 1)) << label;
    } else if (c.name == "boolean") {
      has_exactly({"name", "value"});
      EXPECT_TRUE(c.at("value") == "true" || c.at("value") == "false");
    } else if (c.name == "point" || c.name == "vector") {
      has_exactly({"name", "x", "y", "z"});
      for (const char* axis : {"x", "y", "z"}) EXPECT_EQ(numbers_of(c.at(axis)).size(), 1u);
    } else if (c.name == "string") {
      has_exactly({"name", "value"});
      EXPECT_EQ(c.at("value").find('$'), std::string::npos) << "would be a variable";
      if (label == "filename") {
        EXPECT_TRUE(std::filesystem::is_regular_file(directory_ / c.at("value"))) << c.at("value");
      }
      const auto choice = choices().find(label);
      if (choice != choices().end()) {
        EXPECT_TRUE(choice->second.contains(c.at("value"))) << c.at("value");
      }
    } else if (c.name == "transform") {
      EXPECT_NE(glm::determinant(matrix_of(c)), 0);
    } else if (c.name == "ref") {
      has_exactly({"id"});
      EXPECT_TRUE(ids_.contains(c.at("id"))) << c.at("id") << " is defined nowhere before";
    } else {
      check_plugin(c);
    }
  }

  std::filesystem::path directory_;
  std::set<std::string> ids_;
};

struct MitsubaFiles {
  scene_io::ExportReport report;
  XmlElement scene;
};

MitsubaFiles mitsuba_files(const scene::Scene& scene, const scene_io::ExportSettings& settings,
                           const TempDir& dir) {
  MitsubaFiles e{scene_io::export_mitsuba(scene, settings, dir.path()), {}};
  const std::string text = read_text_file(dir / "scene.xml");
  e.scene = XmlReader(text).document();
  for (const auto& file : e.report.files) EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
  return e;
}

TEST(ExportMitsuba, EveryElementIsDocumented) {
  const TempDir dir;
  const MitsubaFiles e = mitsuba_files(scene_of_everything(), export_settings(), dir);
  Checker(dir.path()).check_scene(e.scene);
  EXPECT_EQ(parameter(e.scene.child("integrator"), "max_depth")->at("value"), "4");
  EXPECT_EQ(e.scene.child("integrator").at("type"), "volpath");
  for (const XmlElement* shape : e.scene.all("shape")) {
    if (shape->at("type") == "sphere") continue;
    const Ply ply = read_ply(dir / parameter(*shape, "filename")->at("value"));
    EXPECT_GT(ply.triangles.size(), 0u);
    const bool smooth = std::find(ply.properties.begin(), ply.properties.end(), "nx") != ply.properties.end();
    EXPECT_EQ(parameter(*shape, "face_normals") == nullptr, smooth);
  }
}

TEST(ExportMitsuba, BuiltinScenesAreDocumentedToo) {
  for (const char* name : {"box", "cornell", "two-rooms"}) {
    const TempDir dir;
    const scene::Scene scene = scene::make_builtin(name);
    scene_io::ExportSettings settings = export_settings();
    settings.camera = scene::camera_pose(scene, "");
    const MitsubaFiles e = mitsuba_files(scene, settings, dir);
    Checker(dir.path()).check_scene(e.scene);
    EXPECT_EQ(e.scene.child("integrator").at("type"), "path") << name;
  }
}

TEST(ExportMitsuba, TheCameraSeesTheSamePicture) {
  for (const bool orthographic : {false, true}) {
    const TempDir dir;
    scene_io::ExportSettings settings = export_settings();
    settings.camera.camera.orthographic = orthographic, settings.camera.camera.yheight = 5;
    const MitsubaFiles e = mitsuba_files(scene::make_builtin("box"), settings, dir);
    const XmlElement& sensor = e.scene.child("sensor");
    const mat4 to_camera = glm::inverse(matrix_of(*parameter(sensor, "to_world")));
    const float aspect = 64.0f / 36;
    for (const vec3& p : visible_points()) {
      const vec3 c(to_camera * vec4(p, 1));
      EXPECT_GT(c.z, 0);  // looks along +z, x to the left
      vec2 place;
      if (orthographic) {
        place = {0.5f - 0.5f * c.x, 0.5f - 0.5f * c.y * aspect};  // [-1, 1] across
      } else {
        EXPECT_EQ(parameter(sensor, "fov_axis")->at("value"), "y");
        const float t = std::tan(glm::radians(numbers_of(parameter(sensor, "fov")->at("value"))[0]) / 2);
        place = {0.5f - 0.5f * c.x / c.z / (t * aspect), 0.5f - 0.5f * c.y / c.z / t};
      }
      const vec2 ours = place_on_picture(settings, p);
      EXPECT_NEAR(place.x, ours.x, 1e-4f);
      EXPECT_NEAR(place.y, ours.y, 1e-4f);
    }
  }
}

// A sensor for each face, in one file: --sensor chooses.
TEST(ExportMitsuba, ACubeMapHasASensorForEachFace) {
  const TempDir dir;
  const MitsubaFiles e = mitsuba_files(scene_of_everything(), cube_settings(), dir);
  Checker(dir.path()).check_scene(e.scene, 6);
  EXPECT_EQ(parameter(e.scene.child("integrator"), "hide_emitters")->at("value"), "true");
  std::size_t face = 0;
  for (const XmlElement* sensor : e.scene.all("sensor")) {
    const mat4 world = matrix_of(*parameter(*sensor, "to_world"));
    expect_camera_of_face(face++, vec3(world[3]), vec3(world[2]), -vec3(world[0]), vec3(world[1]));
    EXPECT_EQ(parameter(*sensor, "fov")->at("value"), "90");
    const XmlElement& film = sensor->child("film");
    for (const char* side : {"width", "height"}) EXPECT_EQ(parameter(film, side)->at("value"), "16");
  }
  EXPECT_THAT(e.report.command, testing::HasSubstr("-s $f -o face$f.exr " + (dir / "scene.xml").string()));
  const TempDir seen;
  scene_io::ExportSettings settings = cube_settings();
  settings.shows_emitters = true;
  const MitsubaFiles with = mitsuba_files(scene_of_everything(), settings, seen);
  EXPECT_EQ(parameter(with.scene.child("integrator"), "hide_emitters"), nullptr);
}

// emitters/envmap.cpp: u = atan2(x, -z)/2π, v = acos(y)/π; columns are centres, rows reach from pole to pole.
TEST(ExportMitsuba, TheEnvironmentLooksTheSameInEveryDirection) {
  const TempDir dir;
  const scene::Scene scene = scene_of_everything();
  const MitsubaFiles e = mitsuba_files(scene, export_settings(), dir);
  for (const XmlElement* emitter : e.scene.all("emitter")) {
    if (emitter->at("type") != "envmap") continue;
    const image::Image image = image::read_image(dir / parameter(*emitter, "filename")->at("value"));
    const mat4 to_local = glm::inverse(matrix_of(*parameter(*emitter, "to_world")));
    for (const vec3& direction : directions_around()) {
      const vec3 d(to_local * vec4(direction, 0));
      float u = std::atan2(d.x, -d.z) / (2 * pi);
      u -= std::floor(u);
      const float x = u * static_cast<float>(image.width) - 0.5f;
      const float y = std::acos(glm::clamp(d.y, -1.0f, 1.0f)) / pi * static_cast<float>(image.height - 1);
      const int x0 = static_cast<int>(std::floor(x)), y0 = std::min(static_cast<int>(y), image.height - 2);
      const auto at = [&](int dx, int dy) {
        return image.rgb((x0 + dx + image.width) % image.width, y0 + dy);
      };
      const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
      const vec3 value = glm::mix(glm::mix(at(0, 0), at(1, 0), fx), glm::mix(at(0, 1), at(1, 1), fx), fy);
      const vec3 ours = environment_radiance(*scene.environment, direction);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], ours[c], 1e-4f * ours[c]);
    }
    return;
  }
  FAIL() << "no envmap";
}

TEST(ExportMitsuba, LightsStandAndShineWhereTheyDoHere) {
  const TempDir dir;
  const scene::Scene scene = scene_of_everything();
  const MitsubaFiles e = mitsuba_files(scene, export_settings(), dir);
  const std::vector<mat4> world = scene::world_matrices(scene);
  const auto emitter = [&](const std::string& type) -> const XmlElement& {
    for (const XmlElement* c : e.scene.all("emitter"))
      if (c->at("type") == type) return *c;
    throw std::runtime_error("no " + type);
  };
  const auto place = [&](std::size_t light) { return world[scene.lights[light].node]; };
  const auto vector = [](const XmlElement& p) {
    return vec3(numbers_of(p.at("x"))[0], numbers_of(p.at("y"))[0], numbers_of(p.at("z"))[0]);
  };
  EXPECT_LT(glm::distance(vector(*parameter(emitter("point"), "position")), vec3(place(0)[3])), 1e-5f);
  EXPECT_EQ(parameter(emitter("point"), "intensity")->at("value"), "8 4 2");
  const mat4 spot = matrix_of(*parameter(emitter("spot"), "to_world"));
  EXPECT_LT(glm::distance(vec3(spot[3]), vec3(place(1)[3])), 1e-5f);
  EXPECT_LT(glm::distance(vec3(spot[2]), -vec3(place(1)[2])), 1e-5f);  // along its +z
  EXPECT_NEAR(numbers_of(parameter(emitter("spot"), "cutoff_angle")->at("value"))[0], glm::degrees(0.5f),
              1e-4f);
  EXPECT_LT(glm::distance(vector(*parameter(emitter("directional"), "direction")), -vec3(place(2)[2])),
            1e-5f);
}

TEST(ExportMitsuba, TexturesGoThroughTheSameTransform) {
  const TempDir dir;
  const scene::Scene scene = scene_of_everything();
  const MitsubaFiles e = mitsuba_files(scene, export_settings(), dir);
  const XmlElement* bitmap = nullptr;
  for (const XmlElement* bsdf : e.scene.all("bsdf"))
    if (bsdf->at("id") == "material2") bitmap = parameter(bsdf->child("bsdf"), "reflectance");
  ASSERT_NE(bitmap, nullptr);
  EXPECT_EQ(parameter(*bitmap, "raw"), nullptr);
  // KHR_texture_transform: translate · rotate · scale, counter-clockwise on the image whose v points down.
  const mat4 to_uv = matrix_of(*parameter(*bitmap, "to_uv"));
  const vec2 uv(0.3f, 0.9f), scaled(2 * uv.x, 3 * uv.y);
  const vec2 wanted(std::cos(0.3f) * scaled.x + std::sin(0.3f) * scaled.y + 0.25f,
                    -std::sin(0.3f) * scaled.x + std::cos(0.3f) * scaled.y + 0.5f);
  EXPECT_LT(glm::distance(vec2(to_uv * vec4(uv, 0, 1)), wanted), 1e-5f);
  // The file's own coordinates are the mesh's: v down, as Mitsuba's bitmaps.
  const Ply ply = read_ply(dir / "mesh2.ply");
  const std::size_t u = ply.properties.size() - 2;
  EXPECT_EQ(ply.properties[u], "u");
  for (std::size_t i = 0; i < ply.vertices.size(); ++i)
    EXPECT_EQ(vec2(ply.vertices[i][u], ply.vertices[i][u + 1]), scene.meshes[2].uvs[0][i]);
}

TEST(ExportMitsuba, WhatDiffersIsSaid) {
  const TempDir dir;
  const scene_io::ExportReport report =
      scene_io::export_mitsuba(scene_of_everything(), export_settings(), dir.path());
  for (const char* part : {"range: lamp", "spots fade", "unseen: sun", "sphere lights block: globe",
                           "roughplastic", "roughconductor", "principled", "Blinn-Phong", "Oren-Nayar",
                           "normal maps", "cut-outs", "unlit", "glows on the front alone: panel"}) {
    std::string key = part;
    if (key == "sphere lights block: globe") key = "sphere lights block other light: globe";
    EXPECT_EQ(differences_with(report, key).size(), 1u) << part;
  }
  const TempDir plain;
  scene_io::ExportSettings settings = export_settings();
  EXPECT_THAT(scene_io::export_mitsuba(scene::make_builtin("box"), settings, plain.path()).differences,
              testing::IsEmpty());
}

}  // namespace
}  // namespace ssphh::test
