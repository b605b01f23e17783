#include "export_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/image/sphere_map.h>
#include <ssphh/scene/primitives.h>

namespace ssphh::test {
namespace {

int add_node(scene::Scene& s, const std::string& name, const vec3& position, const vec3& scale = vec3(1)) {
  scene::Node node;
  node.name = name;
  node.local.translation = position;
  node.local.rotation = glm::angleAxis(0.4f, glm::normalize(vec3(1, 2, 3)));
  node.local.scale = scale;
  s.nodes.push_back(node);
  return static_cast<int>(s.nodes.size()) - 1;
}

void add_ball(scene::Scene& s, const scene::Material& material, bool colors = false) {
  const auto index = static_cast<int>(s.meshes.size());
  scene::Mesh mesh = scene::make_sphere(0.4f, 8, 4);
  for (const vec2& uv : mesh.uvs[0]) mesh.uvs[1].emplace_back(0.5f * uv.y, 1 - uv.x);
  if (colors) mesh.colors.assign(mesh.positions.size(), vec4(0.5f, 0.25f, 1, 1));
  mesh.material = static_cast<int>(s.materials.size());
  s.materials.push_back(material);
  s.meshes.push_back(std::move(mesh));
  // Every other one mirrored
  const int node = add_node(s, material.name, vec3(index, 0, -2), vec3(index % 2 == 0 ? 1 : -1, 1, 1));
  s.instances.push_back({index, node, -1, {}});
}

scene::Texture make_texture(const std::string& name, bool alpha) {
  scene::Texture t{name, 4, 2, {}};
  for (int i = 0; i < 8; ++i) {
    for (const int v : {30 * i, 255 - 30 * i, 128, alpha ? 36 * i : 255}) {
      t.rgba.push_back(static_cast<std::uint8_t>(v));
    }
  }
  return t;
}

void add_materials(scene::Scene& s) {
  s.textures = {make_texture("a \"b\"\n<c>", true), make_texture("", false)};
  scene::TextureUse use;
  use.texture = 0;
  use.offset = {0.25f, 0.5f}, use.scale = {2, 3}, use.rotation = 0.3f;
  scene::TextureUse clamped = use;
  clamped.texture = 1, clamped.wrap_u = clamped.wrap_v = scene::Wrap::clamp, clamped.nearest = true;

  const auto material = [](const std::string& name, const std::function<void(scene::Material&)>& change) {
    scene::Material m;
    m.name = name;
    m.specular = 0;
    change(m);
    return m;
  };
  add_ball(s, material("plain", [](auto&) {}));
  add_ball(s, material("plain", [](auto& m) { m.base_color = {0.8f, 0.1f, 0.2f}; }), true);
  add_ball(s, material("", [&](auto& m) { m.base_color_texture = use, m.base_color = vec3(1); }));
  add_ball(s, material("quote \" and\nline -- <b>&amp;</b> $x",
                       [&](auto& m) { m.base_color_texture = use, m.alpha_mode = scene::AlphaMode::mask; }));
  add_ball(s, material("glass", [](auto& m) { m.alpha_mode = scene::AlphaMode::blend, m.alpha = 0.5f; }));
  add_ball(s, material("varnish", [](auto& m) { m.specular = 1, m.specular_roughness = 0.3f; }));
  add_ball(s,
           material("\xC3\xA4\xE2\x82\xAC", [](auto& m) { m.metallic = 1, m.specular_roughness = -0.5f; }));
  add_ball(s, material("worn", [&](auto& m) {
             m.specular = 1, m.metallic = 0.8f, m.metallic_roughness_texture = clamped;
           }));
  add_ball(s, material("bumps", [&](auto& m) { m.normal_texture = use, m.diffuse_roughness = -0.5f; }));
  add_ball(s, material("screen", [&](auto& m) { m.emission = {3, 2, 1}, m.emission_texture = clamped; }));
  add_ball(s, material("panel", [](auto& m) { m.emission = vec3(5), m.double_sided = true; }));
  add_ball(s, material("sign", [](auto& m) { m.unlit = true; }));
}

void add_light(
    scene::Scene& s, const std::string& name, scene::LightType type,
    const std::function<void(scene::Light&)>& change = [](auto&) {}) {
  scene::Light light;
  light.name = name;
  light.type = type;
  light.color = {1, 0.5f, 0.25f};
  light.intensity = 8;
  light.node = add_node(s, name, vec3(s.lights.size(), 3, -1));
  change(light);
  s.lights.push_back(light);
}

}  // namespace

scene::Scene scene_of_everything() {
  scene::Scene s;
  s.name = "everything";
  add_materials(s);
  s.meshes.push_back(scene::make_quad({-9, -1, -9}, {0, 0, 18}, {18, 0, 0}));
  s.meshes.back().normals.clear();
  s.instances.push_back({static_cast<int>(s.meshes.size()) - 1, add_node(s, "floor", vec3(0)), -1, {}});
  add_light(s, "lamp \"1\"\n", scene::LightType::point, [](auto& l) { l.range = 7; });
  add_light(s, "", scene::LightType::spot, [](auto& l) { l.inner_cone = 0.2f, l.outer_cone = 0.5f; });
  add_light(s, "sun", scene::LightType::directional);
  add_light(s, "sun", scene::LightType::directional, [](auto& l) { l.angular_radius = 0.02f; });
  add_light(s, "globe", scene::LightType::sphere, [](auto& l) { l.radius = 0.25f; });
  s.environment.emplace();
  s.environment->color = {1, 2, 0.5f};
  s.environment->rotation = 0.7f;
  s.environment->equirect = image::Image(64, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const vec3 d =
          image::equirect_direction((static_cast<float>(x) + 0.5f) / 64, (static_cast<float>(y) + 0.5f) / 32);
      s.environment->equirect.set_rgb(x, y, vec3(1) + 0.8f * d);
    }
  }
  return s;
}

scene_io::ExportSettings export_settings() {
  scene_io::ExportSettings settings;
  settings.camera.world = glm::inverse(glm::lookAt(vec3(2, 1.5f, 4), vec3(1, 0.3f, -2), vec3(0.1f, 1, 0)));
  settings.camera.camera.yfov = 0.9f;
  settings.width = 64, settings.height = 36;
  settings.max_depth = 3, settings.spp = 16;
  return settings;
}

std::vector<float> numbers_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<float> result;
  for (std::string word; in >> word;) {
    std::size_t used = 0;
    const float value = std::stof(word, &used);
    EXPECT_EQ(used, word.size()) << text;
    EXPECT_TRUE(std::isfinite(value)) << text;
    result.push_back(value);
  }
  return result;
}

vec2 place_on_picture(const scene_io::ExportSettings& settings, const vec3& world) {
  const vec3 p(glm::inverse(settings.camera.world) * vec4(world, 1));
  const scene::Camera& camera = settings.camera.camera;
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  const float up = camera.orthographic ? 2 * p.y / camera.yheight : p.y / -p.z / std::tan(camera.yfov / 2);
  const float right = camera.orthographic ? 2 * p.x / camera.yheight : p.x / -p.z / std::tan(camera.yfov / 2);
  return {0.5f + 0.5f * right / aspect, 0.5f - 0.5f * up};
}

std::vector<vec3> visible_points() {
  return {{1, 0.3f, -2}, {0, 0, 0}, {3, 1, -1}, {2.5f, -0.5f, -6}, {-1, 2, -3}};
}

vec3 environment_radiance(const scene::Environment& environment, const vec3& direction) {
  const float c = std::cos(environment.rotation), s = std::sin(environment.rotation);
  // The image turns counter-clockwise seen from above: at angle 90 degrees, what stood at +x stands at -z.
  const vec3 d(c * direction.x - s * direction.z, direction.y, s * direction.x + c * direction.z);
  return environment.color * image::sample_equirect(environment.equirect, d);
}

std::vector<vec3> directions_around() {
  std::vector<vec3> result;
  for (int i = 0; i < 60; ++i) {
    const float y = 1 - (static_cast<float>(i) + 0.5f) / 30, r = std::sqrt(1 - y * y);
    const float phi = 2.399963f * static_cast<float>(i);  // golden angle
    result.emplace_back(r * std::cos(phi), y, r * std::sin(phi));
  }
  return result;
}

scene_io::ExportSettings cube_settings() {
  scene_io::ExportSettings settings = export_settings();
  settings.cube_at = vec3(0.5f, -0.25f, 2);
  settings.width = settings.height = 16;
  settings.shows_emitters = false;
  return settings;
}

void expect_camera_of_face(std::size_t face, const vec3& place, const vec3& ahead, const vec3& right,
                           const vec3& up) {
  const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const vec3 centers[] = {x, -x, y, -y, z, -z}, face_right[] = {-z, z, x, x, x, -x},
             face_down[] = {-y, -y, z, -z, -y, -y};
  ASSERT_LT(face, 6u);
  EXPECT_LT(glm::distance(place, vec3(0.5f, -0.25f, 2)), 1e-5f) << face;
  EXPECT_LT(glm::distance(ahead, centers[face]), 1e-5f) << face;
  EXPECT_LT(glm::distance(right, -face_right[face]), 1e-5f) << face;
  EXPECT_LT(glm::distance(up, -face_down[face]), 1e-5f) << face;
}

Ply read_ply(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t end = all.find("end_header\n");
  Ply ply;
  EXPECT_NE(end, std::string::npos) << path;
  if (end == std::string::npos) return ply;
  std::istringstream header(all.substr(0, end));
  std::size_t vertices = 0, faces = 0;
  std::string line, element;
  std::getline(header, line);
  EXPECT_EQ(line, "ply");
  std::getline(header, line);
  EXPECT_EQ(line, "format binary_little_endian 1.0");
  while (std::getline(header, line)) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "element") {
      element = second;
      EXPECT_TRUE(element == "vertex" || element == "face") << line;
      (element == "vertex" ? vertices : faces) = std::stoul(third);
    } else if (element == "vertex") {
      EXPECT_EQ(first + " " + second, "property float") << line;
      ply.properties.push_back(third);
    } else {
      EXPECT_EQ(line, "property list uchar int vertex_indices");
    }
  }
  const std::size_t body = end + 11, stride = 4 * ply.properties.size();
  EXPECT_EQ(bytes.size(), body + stride * vertices + 13 * faces) << path;
  if (bytes.size() != body + stride * vertices + 13 * faces) return ply;
  for (std::size_t i = 0; i < vertices; ++i) {
    std::vector<float> v(ply.properties.size());
    std::memcpy(v.data(), bytes.data() + body + stride * i, stride);
    for (const float x : v) EXPECT_TRUE(std::isfinite(x)) << path;
    ply.vertices.push_back(std::move(v));
  }
  for (std::size_t i = 0; i < faces; ++i) {
    const std::byte* face = bytes.data() + body + stride * vertices + 13 * i;
    EXPECT_EQ(static_cast<int>(face[0]), 3) << path;
    uvec3 t;
    std::memcpy(&t, face + 1, 12);
    EXPECT_LT(std::max({t.x, t.y, t.z}), vertices) << path;
    ply.triangles.push_back(t);
  }
  return ply;
}

std::vector<std::string> differences_with(const scene_io::ExportReport& report, const std::string& part) {
  std::vector<std::string> result;
  for (const std::string& line : report.differences)
    if (line.find(part) != std::string::npos) result.push_back(line);
  return result;
}

}  // namespace ssphh::test
