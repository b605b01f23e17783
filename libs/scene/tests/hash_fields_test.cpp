// Which fields of a scene its hashes know: all, but for those listed here with their reason.

#include <algorithm>
#include <map>
#include <optional>
#include <regex>

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>

#include "scene_fields.h"

namespace ssphh::scene {
namespace {

/// Two of everything that has an index, different from each other, so that 0 and 1 are both allowed and not
/// the same. Instance 0 has its mesh's material, 1.
Scene scene_with_all_fields() {
  Scene s;
  for (int i = 0; i < 2; ++i) {
    const auto n = static_cast<std::uint8_t>(i);
    s.textures.push_back({"t", 1, 2, {n, 1, 2, 3, 4, 5, 6, 7}});
    Material m;
    m.emission = vec3(1, 2, 3), m.metallic = i == 0 ? 0.25f : 0.5f;
    m.alpha_mode = AlphaMode::mask;
    m.transmission = 0.5f, m.thickness = 1, m.attenuation_distance = 2;
    for (TextureUse Material::*use :
         {&Material::base_color_texture, &Material::metallic_roughness_texture, &Material::emission_texture,
          &Material::normal_texture, &Material::transmission_texture})
      (m.*use).texture = 0;
    s.materials.push_back(m);
    Mesh mesh = make_box(vec3(0), vec3(1 + i));
    mesh.uvs[1] = mesh.uvs[0];
    mesh.tangents.assign(24, vec4(1, 0, 0, 1));
    mesh.colors.assign(24, vec4(1));
    mesh.material = 1;
    s.meshes.push_back(mesh);
    s.nodes.emplace_back();
    s.nodes.back().local.translation = vec3(i, 3, 4);
  }
  s.nodes[0].name = "n";
  s.nodes[1].matrix = mat4(2);
  s.instances = {{0, 0, -1, ""}, {0, 1, 0, ""}};
  s.cameras.resize(2);
  s.cameras[1].orthographic = true, s.cameras[1].yheight = 3;
  s.lights.resize(7);
  for (int i = 0; i < 7; ++i) s.lights[i].type = static_cast<LightType>(i);
  for (Light& l : s.lights) {
    l.node = 0, l.radius = 0.5f, l.size = {0.5f, 1};
    l.emission = {.frames = {sh::IntensitySh(1), sh::IntensitySh(1)}, .rate = 2};
    l.profile = {
        "p", std::make_shared<const PhotometricTable>(PhotometricTable{Photometry::c, {0, 90}, {0}, {1, 2}})};
  }
  for (Camera& c : s.cameras) c.node = 0;
  s.sphls.push_back({"s", 0, 0.1f, true});
  s.animations.resize(1);
  s.animations[0].name = "a";
  s.animations[0].channels.push_back(
      {0, AnimationPath::translation, Interpolation::linear, {0, 1}, {vec4(0), vec4(1)}});
  s.environment.emplace();
  s.environment->equirect = image::Image(2, 1);
  return s;
}

/// How many numbers a field has that are changed one at a time.
template <class T>
constexpr int parts = 1;
template <>
constexpr int parts<vec2> = 2;
template <>
constexpr int parts<vec3> = 3;
template <>
constexpr int parts<vec4> = 4;
template <>
constexpr int parts<quat> = 4;
template <>
constexpr int parts<uvec3> = 3;
template <>
constexpr int parts<std::optional<mat4>> = 17;  // there or not, and its elements
template <class T>
constexpr int parts<std::vector<T>> = parts<T>;

template <class T>
void change(T& v, int part) {
  if constexpr (parts < T >> 1) {
    v[part] += static_cast<std::remove_reference_t<decltype(v[part])>>(1);
  } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, int>) {
    v = static_cast<T>(static_cast<int>(v) == 0 ? 1 : 0);  // also an index that is allowed
  } else if constexpr (std::is_same_v<T, bool>) {
    v = !v;
  } else if constexpr (std::is_same_v<T, std::string>) {
    v += "x";
  } else {
    v = static_cast<T>(v + T(1));
  }
}
void change(std::optional<float>& v, int) {
  v = v.value_or(0) + 0.5f;
}
void change(std::optional<mat4>& v, int part) {
  if (!v) {
    v = mat4(1);
  } else if (part == 0) {
    v.reset();
  } else {
    (*v)[(part - 1) / 4][(part - 1) % 4] += 1;
  }
}
template <class T>
void change(std::vector<T>& v, int part) {
  if (v.empty()) v.emplace_back();
  change(v.back(), part);
}

struct Field {
  std::string path;
  Scene scene;  ///< with one number of this field changed and nothing else
};

/// The full scene once for every number of every field of it.
std::vector<Field> changed_scenes() {
  std::vector<Field> all;
  const auto next = [&] {
    Field field{"", scene_with_all_fields()};
    std::size_t i = 0;
    const auto visit = [&](const std::string& path, auto& member) {
      using Member = std::remove_reference_t<decltype(member)>;
      if (path == "nodes[0].parent") return;  // no node stands before the first
      for (int part = 0; part < parts<Member>; ++part) {
        if (i++ == all.size()) field.path = path, change(member, part);
      }
    };
    test::SceneFields(field.scene, visit);
    return field;
  };
  for (Field field = next(); !field.path.empty(); field = next()) all.push_back(std::move(field));
  return all;
}

/// Fields that no picture and no light depends on, as patterns of paths.
bool invisible(const std::string& path) {
  static const std::regex patterns(
      "name|ignored.*"                                                 // of the scene: for people
      "|dark_groups"                                                   // a name of none; others: DarkGroups
      "|light_modes.*"                                                 // what is to be kept of the light
      "|(textures|materials|meshes|animations)\\[.*\\]\\.name"         // for people
      "|(meshes|textures)\\[1\\]\\..*"                                 // not used
      "|materials\\[.\\]\\.thickness"                                  // whether there is one counts
      "|nodes\\[1\\]\\.(translation|rotation|scale)"                   // its matrix replaces them
      "|nodes\\[.\\]\\.movable"                                        // follows from the animations
      "|cameras\\[0\\]\\.yheight|cameras\\[1\\]\\.yfov"                // of the other projection
      "|lights\\[[0125]\\]\\.radius"                                   // spheres and discs have one
      "|lights\\[[0-46]\\]\\.size"                                     // rectangles have one
      "|lights\\[[0-356]\\]\\.emission.*"                              // SPHLs have one
      "|lights\\[.\\]\\.profile\\.name|lights\\[[2-6]\\]\\.profile.*"  // for people; of points and spots
      "|lights\\[[013-6]\\]\\.angular_radius|lights\\[2\\]\\.range"    // suns have one, and reach everywhere
      "|lights\\[[02-6]\\]\\.(inner|outer)_cone");                     // spots have one
  return std::regex_match(path, patterns);
}

/// Those that only an observer has.
bool of_observers(const std::string& path) {
  return path.starts_with("cameras") || path.starts_with("sphls");
}

TEST(SceneHash, EveryFieldThatIsSeenCounts) {
  const Hash128 before = scene_hash(scene_with_all_fields());
  for (const Field& field : changed_scenes())
    EXPECT_EQ(scene_hash(field.scene) == before, invisible(field.path)) << field.path;
}

TEST(LightHash, EveryFieldThatDecidesLightCounts) {
  const Hash128 before = light_hash(scene_with_all_fields());
  for (const Field& field : changed_scenes()) {
    EXPECT_EQ(light_hash(field.scene) == before, invisible(field.path) || of_observers(field.path))
        << field.path;
  }
}

}  // namespace
}  // namespace ssphh::scene
