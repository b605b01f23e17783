// Corona Standalone's files, against their documentation (wiki.corona-renderer.com/standalone: scn, mtl,
// mtl-maps, obj, conf) and, for the children of geometryGroup, what the paper's own exporter writes.

#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>

#include "export_fixture.h"
#include "temp_dir.h"
#include "xml_reader.h"

namespace ssphh::test {
namespace {

struct CoronaFiles {
  scene_io::ExportReport report;
  XmlElement scn, mtl;
};

CoronaFiles corona_files(const scene::Scene& scene, const scene_io::ExportSettings& settings,
                         const TempDir& dir) {
  CoronaFiles e{scene_io::export_corona(scene, settings, dir.path()), {}, {}};
  const std::string scn = read_text_file(dir / "scene.scn"), mtl = read_text_file(dir / "scene.mtl");
  e.scn = XmlReader(scn).document();
  e.mtl = XmlReader(mtl).document();
  for (const auto& file : e.report.files) EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
  return e;
}

struct Obj {
  std::vector<vec3> positions, normals;
  std::vector<vec2> uvs;
  std::vector<uvec3> triangles;
};

Obj read_obj(const std::filesystem::path& path) {
  Obj obj;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t blank = line.find(' ');
    const std::string command = line.substr(0, blank), rest = line.substr(blank + 1);
    if (command == "f") {
      std::istringstream corners(rest);
      uvec3 triangle;
      int count = 0;
      for (std::string corner; corners >> corner; ++count) {
        unsigned v = 0, t = 0, n = 0;
        const bool textured = std::sscanf(corner.c_str(), "%u/%u/%u", &v, &t, &n) == 3;
        if (!textured) {
          EXPECT_EQ(std::sscanf(corner.c_str(), "%u//%u", &v, &n), 2) << corner;
        }
        EXPECT_EQ(textured, !obj.uvs.empty());
        EXPECT_TRUE(v >= 1 && v <= obj.positions.size() && n >= 1 && n <= obj.normals.size()) << line;
        if (textured) {
          EXPECT_TRUE(t >= 1 && t <= obj.uvs.size()) << line;
        }
        if (count < 3) triangle[count] = v - 1;
      }
      EXPECT_EQ(count, 3);
      obj.triangles.push_back(triangle);
      continue;
    }
    const std::vector<float> x = numbers_of(rest);
    EXPECT_EQ(x.size(), 3u) << line;
    if (command == "v")
      obj.positions.emplace_back(x[0], x[1], x[2]);
    else if (command == "vt")
      obj.uvs.emplace_back(x[0], x[1]);
    else if (command == "vn")
      obj.normals.emplace_back(x[0], x[1], x[2]);
    else
      ADD_FAILURE() << line;
  }
  return obj;
}

void check_slot(const XmlElement& slot, std::size_t numbers, const std::filesystem::path& directory) {
  if (slot.children.empty()) {
    const std::vector<float> v = numbers_of(slot.text);
    EXPECT_EQ(v.size(), numbers) << slot.name;
    for (const float x : v) EXPECT_GE(x, 0);
    return;
  }
  const XmlElement& map = slot.child("map");
  EXPECT_EQ(slot.children.size(), 1u);
  EXPECT_EQ(map.at("class"), "Texture");
  for (const XmlElement& c : map.children)
    EXPECT_TRUE(c.name == "image" || c.name == "gamma" || c.name == "uvMap");
  EXPECT_TRUE(std::filesystem::is_regular_file(directory / map.child("image").text))
      << map.child("image").text;
  EXPECT_EQ(numbers_of(map.child("gamma").text).size(), 1u);
  const XmlElement& uv = map.child("uvMap");
  EXPECT_EQ(uv.child("mode").text, "uvw");
  for (const char* axis : {"wrapModeU", "wrapModeV"})
    EXPECT_TRUE(uv.child(axis).text == "clamp" || uv.child(axis).text == "repeat");
}

void check_material(const XmlElement& material, const std::filesystem::path& directory) {
  EXPECT_EQ(material.at("class"), "Native");
  std::set<std::string> seen;
  for (const XmlElement& c : material.children) {
    EXPECT_TRUE(seen.insert(c.name).second);
    if (c.name == "diffuse") {
      check_slot(c, 3, directory);
    } else if (c.name == "reflect") {
      EXPECT_EQ(c.children.size(), 3u);
      check_slot(c.child("color"), 3, directory);
      check_slot(c.child("ior"), 1, directory);
      check_slot(c.child("glossiness"), 1, directory);
    } else {
      EXPECT_EQ(c.name, "emission");
      check_slot(c.child("color"), 3, directory);
    }
  }
}

void check(const CoronaFiles& e, const std::filesystem::path& directory) {
  std::set<std::string> materials;
  EXPECT_EQ(e.mtl.name, "mtlLib");
  for (const XmlElement& d : e.mtl.children) {
    EXPECT_EQ(d.name, "materialDefinition");
    // Names are read as identifiers in lower case: they must differ so.
    std::string name = d.at("name");
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    EXPECT_THAT(name, testing::MatchesRegex("[a-z][a-z0-9_]*"));
    EXPECT_TRUE(materials.insert(name).second) << name << " twice";
    check_material(d.child("material"), directory);
  }
  EXPECT_EQ(e.scn.name, "scene");
  for (const XmlElement& c : e.scn.children) {
    if (c.name == "confFile" || c.name == "mtlLib") {
      EXPECT_TRUE(std::filesystem::is_regular_file(directory / c.text));
    } else if (c.name == "environment") {
      check_slot(c, 3, directory);
    } else if (c.name == "geometryGroup") {
      EXPECT_EQ(c.children.size(), 2u);
      EXPECT_EQ(c.child("object").at("class"), "file");
      EXPECT_GT(read_obj(directory / c.child("object").text).triangles.size(), 0u);
      const XmlElement& instance = c.child("instance");
      EXPECT_EQ(instance.child("material").at("class"), "Reference");
      std::string name = instance.child("material").text;
      for (char& letter : name) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      EXPECT_TRUE(materials.contains(name)) << name;
      EXPECT_EQ(numbers_of(instance.child("transform").text).size(), 16u);
    } else {
      EXPECT_EQ(c.name, "camera");
    }
  }
  EXPECT_EQ(e.scn.all("camera").size(), 1u);
}

TEST(ExportCorona, EveryElementIsDocumented) {
  const TempDir dir;
  check(corona_files(scene_of_everything(), export_settings(), dir), dir.path());
  // [type] [name] = [value]; the names are the paper's.
  EXPECT_EQ(read_text_file(dir / "scene.conf"),
            "Int image.width = 64\nInt image.height = 36\nFloat colorMap.simpleExposure = 0\n"
            "Int shading.maxRayDepth = 3\nInt progressive.passLimit = 16\n");
}

TEST(ExportCorona, BuiltinScenesAreDocumentedToo) {
  for (const char* name : {"box", "cornell", "two-rooms"}) {
    const TempDir dir;
    const scene::Scene scene = scene::make_builtin(name);
    scene_io::ExportSettings settings = export_settings();
    settings.camera = scene::camera_pose(scene, "");
    check(corona_files(scene, settings, dir), dir.path());
  }
}

TEST(ExportCorona, TheCameraSeesTheSamePicture) {
  const TempDir dir;
  const scene_io::ExportSettings settings = export_settings();
  const CoronaFiles e = corona_files(scene::make_builtin("box"), settings, dir);
  const XmlElement& camera = e.scn.child("camera");
  const auto vector = [&](const char* name) {
    const std::vector<float> v = numbers_of(camera.child(name).text);
    return vec3(v.at(0), v.at(1), v.at(2));
  };
  const vec3 forward = glm::normalize(vector("target") - vector("origin"));
  const vec3 right = glm::normalize(glm::cross(forward, vector("roll")));
  const float t = std::tan(glm::radians(numbers_of(camera.child("fov").text)[0]) / 2);  // horizontal
  for (const vec3& p : visible_points()) {
    const vec3 d = p - vector("origin");
    const float z = glm::dot(d, forward);
    const vec2 ours = place_on_picture(settings, p);
    EXPECT_NEAR(0.5f + 0.5f * glm::dot(d, right) / z / t, ours.x, 1e-4f);
    EXPECT_NEAR(0.5f - 0.5f * glm::dot(d, glm::cross(right, forward)) / z / t * 64 / 36, ours.y, 1e-4f);
  }
}

// A scene file for each face, which share materials, settings and geometry.
TEST(ExportCorona, ACubeMapHasASceneForEachFace) {
  const TempDir dir;
  const scene_io::ExportReport report =
      scene_io::export_corona(scene_of_everything(), cube_settings(), dir.path());
  const std::string mtl = read_text_file(dir / "scene.mtl");
  for (std::size_t face = 0; face < 6; ++face) {
    EXPECT_EQ(report.files[face], dir / fmt::format("face{}.scn", face));
    const std::string scn = read_text_file(report.files[face]);
    CoronaFiles e{report, XmlReader(scn).document(), XmlReader(mtl).document()};
    check(e, dir.path());
    const XmlElement& camera = e.scn.child("camera");
    const auto vector = [&](const char* name) {
      const std::vector<float> v = numbers_of(camera.child(name).text);
      return vec3(v.at(0), v.at(1), v.at(2));
    };
    const vec3 ahead = vector("target") - vector("origin"), up = vector("roll");
    expect_camera_of_face(face, vector("origin"), ahead, glm::cross(ahead, up), up);
    EXPECT_NEAR(numbers_of(camera.child("fov").text)[0], 90, 1e-4f);
  }
  EXPECT_THAT(read_text_file(dir / "scene.conf"),
              testing::HasSubstr("Int image.width = 16\nInt image.height = 16\n"));
  EXPECT_THAT(report.command, testing::HasSubstr("face$f.scn"));
  EXPECT_EQ(differences_with(report, "lamps and sky are in the pictures").size(), 1u);
}

TEST(ExportCorona, RefusesAnOrthographicCamera) {
  const TempDir dir;
  scene_io::ExportSettings settings = export_settings();
  settings.camera.camera.orthographic = true;
  EXPECT_THROW(scene_io::export_corona(scene::make_builtin("box"), settings, dir.path()), Error);
}

/// The mesh of the material whose name begins so.
Obj mesh_of(const CoronaFiles& e, const std::string& material, const std::filesystem::path& directory) {
  for (const XmlElement* g : e.scn.all("geometryGroup"))
    if (g->child("instance").child("material").text.starts_with(material))
      return read_obj(directory / g->child("object").text);
  throw std::runtime_error("no mesh of " + material);
}

vec3 emission_of(const CoronaFiles& e, const std::string& material) {
  for (const XmlElement& d : e.mtl.children) {
    if (!d.at("name").starts_with(material)) continue;
    const std::vector<float> v = numbers_of(d.child("material").child("emission").child("color").text);
    return {v.at(0), v.at(1), v.at(2)};
  }
  throw std::runtime_error("no material " + material);
}

// A lamp's power: radiance times π times surface, for a point light 4π times its intensity.
TEST(ExportCorona, LampsGiveTheSameLight) {
  const TempDir dir;
  const scene::Scene scene = scene_of_everything();
  const CoronaFiles e = corona_files(scene, export_settings(), dir);
  const std::vector<mat4> world = scene::world_matrices(scene);
  const auto area = [](const Obj& obj) {
    double sum = 0;
    for (const uvec3& t : obj.triangles)
      sum += 0.5 * static_cast<double>(glm::length(glm::cross(obj.positions[t.y] - obj.positions[t.x],
                                                              obj.positions[t.z] - obj.positions[t.x])));
    return sum;
  };
  const Obj lamp = mesh_of(e, "light0", dir.path());
  vec3 center(0);
  for (const vec3& p : lamp.positions) center += p / static_cast<float>(lamp.positions.size());
  EXPECT_LT(glm::distance(center, vec3(world[scene.lights[0].node][3])), 1e-3f);
  EXPECT_NEAR(area(lamp) * pi_d * static_cast<double>(emission_of(e, "light0").x) / (4 * pi_d * 8), 1, 1e-3);

  // The spot: outside the hole the shell is whole, and its mean over the cone is the hole's.
  const vec3 place(world[scene.lights[1].node][3]);
  const vec3 axis = -vec3(world[scene.lights[1].node][2]);
  const Obj shell = mesh_of(e, "light1_shell", dir.path());
  float cos_hole = -1;
  for (const vec3& p : shell.positions)
    cos_hole = std::max(cos_hole, glm::dot(glm::normalize(p - place), axis));
  double power = 0;  // of glTF's cone, by quadrature
  for (int i = 0; i < 100000; ++i) {
    const double c = std::cos(0.5) + (1 - std::cos(0.5)) * (i + 0.5) / 100000;
    const double ramp = std::min(1.0, (c - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5)));
    power += ramp * ramp * (1 - std::cos(0.5)) / 100000;
  }
  EXPECT_NEAR((1 - static_cast<double>(cos_hole)) / power, 1, 1e-3);
  // The shell's area: all of the sphere but the hole.
  EXPECT_NEAR(area(shell) / (2 * pi_d * 4e-4 * (1 + static_cast<double>(cos_hole))), 1, 0.01);

  // The sun: irradiance = radiance · projected solid angle, its front toward the scene.
  const Obj sun = mesh_of(e, "light3", dir.path());
  const vec3 direction = -vec3(world[scene.lights[3].node][2]);
  const vec3 normal =
      glm::normalize(glm::cross(sun.positions[1] - sun.positions[0], sun.positions[2] - sun.positions[0]));
  EXPECT_GT(glm::dot(normal, direction), 0.9999f);
  vec3 middle(0);
  for (const vec3& p : sun.positions) middle += p / static_cast<float>(sun.positions.size());
  EXPECT_GT(glm::dot(glm::normalize(-middle), direction), 0.99f);
  const double irradiance = static_cast<double>(emission_of(e, "light3").x) * area(sun) /
                            static_cast<double>(glm::dot(middle, middle));
  EXPECT_NEAR(irradiance / 8, 1, 0.02);  // seen from the origin, not from the scene's centre: 1/500 away
}

// The ray from the scene meets the sky where its texture coordinate shows the environment of that direction.
TEST(ExportCorona, TheSkyLooksTheSameInEveryDirection) {
  const TempDir dir;
  const scene::Scene scene = scene_of_everything();
  const CoronaFiles e = corona_files(scene, export_settings(), dir);
  const Obj sky = mesh_of(e, "sky", dir.path());
  vec3 min(1e30f), max(-1e30f);
  for (const vec3& p : sky.positions) min = glm::min(min, p), max = glm::max(max, p);
  const vec3 center = 0.5f * (min + max);
  int inward = 0;
  for (const uvec3& t : sky.triangles) {
    const vec3 a = sky.positions[t.x];
    const vec3 normal = glm::cross(sky.positions[t.y] - a, sky.positions[t.z] - a);
    if (glm::dot(normal, center - a) > 0) ++inward;
  }
  EXPECT_EQ(inward, static_cast<int>(sky.triangles.size()));
  for (std::size_t i = 0; i < sky.positions.size(); i += 97) {
    const vec3 direction = glm::normalize(sky.positions[i] - center);
    const vec2 uv(sky.uvs[i].x, 1 - sky.uvs[i].y);
    // docs/conventions.md: the image's centre looks to +X, u = 3/4 to +Z
    const float theta = pi * uv.y, a = 2 * pi * (uv.x - 0.5f);
    const vec3 on_image(std::sin(theta) * std::cos(a), std::cos(theta), std::sin(theta) * std::sin(a));
    scene::Environment plain = *scene.environment;
    plain.rotation = 0;
    const vec3 shown = environment_radiance(plain, on_image),
               wanted = environment_radiance(*scene.environment, direction);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], wanted[c], 1e-3f * wanted[c]);
  }
}

TEST(ExportCorona, WhatDiffersIsSaid) {
  const TempDir dir;
  const scene_io::ExportReport report =
      scene_io::export_corona(scene_of_everything(), export_settings(), dir.path());
  for (const char* part :
       {"point lights become", "range: lamp", "spots become a sphere", "directional lights get", "suns stand",
        "sphere lights block other light: globe", "Corona's own lobe", "partial metals", "Oren-Nayar",
        "normal maps are left out", "cut-outs are left out", "unlit", "vertex colours", "which side"})
    EXPECT_EQ(differences_with(report, part).size(), 1u) << part;
}

}  // namespace
}  // namespace ssphh::test
