#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/query.h>

#include "check_indices.h"
#include "repairs.h"
#include "validate_mesh.h"

namespace ssphh::scene {
namespace {

void check_finite(std::initializer_list<float> values, const std::string& where, const char* what) {
  for (const float v : values) {
    if (!std::isfinite(v)) throw Error(where, fmt::format("{} is not finite", what));
  }
}

void check_finite(const vec3& v, const std::string& where, const char* what) {
  check_finite({v.x, v.y, v.z}, where, what);
}

/// Clamps, and counts under `kind` when that changed something.
void clamp(float& value, float low, float high, Repairs& repairs, const std::string& kind) {
  if (value >= low && value <= high) return;
  value = std::min(std::max(value, low), high);
  repairs.count(kind);
}

void clamp(vec3& value, float low, float high, Repairs& repairs, const std::string& kind) {
  const vec3 clamped = glm::clamp(value, low, high);
  if (clamped == value) return;
  value = clamped;
  repairs.count(kind);
}

constexpr float unlimited = std::numeric_limits<float>::max();

void validate_use(const TextureUse& use, const std::string& where) {
  check_finite({use.offset.x, use.offset.y, use.scale.x, use.scale.y, use.rotation}, where,
               "texture transform");
}

void validate_material(Material& m, const std::string& where, Repairs& repairs) {
  check_finite(m.base_color, where, "base colour");
  check_finite(m.emission, where, "emission");
  check_finite(m.attenuation_color, where, "attenuation colour");
  check_finite({m.alpha, m.metallic, m.diffuse_roughness, m.specular_roughness, m.specular, m.ior,
                m.transmission, m.thickness, m.attenuation_distance, m.alpha_cutoff, m.normal_scale},
               where, "a parameter");
  for (const TextureUse* use : m.texture_uses()) validate_use(*use, where);
  const std::string kind = "material parameters out of range: clamped";
  clamp(m.base_color, 0, 1, repairs, kind);
  clamp(m.emission, 0, unlimited, repairs, kind);
  clamp(m.alpha, 0, 1, repairs, kind);
  clamp(m.metallic, 0, 1, repairs, kind);
  clamp(m.diffuse_roughness, -1, 1, repairs, kind);
  clamp(m.specular_roughness, -1, 1, repairs, kind);
  clamp(m.specular, 0, 1, repairs, kind);
  clamp(m.ior, 1, 1e6f, repairs, kind);
  clamp(m.transmission, 0, 1, repairs, kind);
  clamp(m.thickness, 0, unlimited, repairs, kind);
  clamp(m.attenuation_color, 0, 1, repairs, kind);
  clamp(m.attenuation_distance, 0, unlimited, repairs, kind);
}

void normalize_rotation(quat& q, Repairs& repairs) {
  const float length = glm::length(q);
  if (std::abs(length - 1) < 1e-4f) return;
  q = length > 1e-20f && std::isfinite(length) ? q / length : quat(1, 0, 0, 0);
  repairs.count("rotations were not unit quaternions: normalised");
}

void validate_node(Node& node, const std::string& where, Repairs& repairs) {
  Transform& t = node.local;
  check_finite(t.translation, where, "translation");
  check_finite(t.scale, where, "scale");
  check_finite({t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w}, where, "rotation");
  normalize_rotation(t.rotation, repairs);
  if (!node.matrix) return;
  for (int column = 0; column < 4; ++column) {
    const vec4& c = (*node.matrix)[column];
    check_finite({c.x, c.y, c.z, c.w}, where, "matrix");
    if (std::abs(c.w - (column == 3 ? 1.0f : 0.0f)) > 1e-6f) throw Error(where, "matrix is not affine");
  }
}

void validate_channel(const AnimationChannel& channel, const std::string& where) {
  check_finite({channel.times.front()}, where, "a key's time");
  for (std::size_t i = 1; i < channel.times.size(); ++i) {
    if (!(channel.times[i] > channel.times[i - 1]) || !std::isfinite(channel.times[i])) {
      throw Error(where, "times do not increase");
    }
  }
  for (const vec4& v : channel.values) check_finite({v.x, v.y, v.z, v.w}, where, "a key's value");
}

void validate_camera(const Camera& camera, const std::string& where) {
  check_finite({camera.yfov, camera.yheight, camera.aspect.value_or(1.0f)}, where, "a parameter");
  if (!camera.orthographic && !(camera.yfov > 0 && camera.yfov < pi)) {
    throw Error(where, fmt::format("yfov is {} rad", camera.yfov), "it must lie between 0 and π");
  }
  if (camera.orthographic && !(camera.yheight > 0)) throw Error(where, "has no height");
}

void validate_light(Light& light, const std::string& where, Repairs& repairs) {
  check_finite(light.color, where, "colour");
  check_finite({light.intensity, light.radius, light.size.x, light.size.y, light.angular_radius,
                light.inner_cone, light.outer_cone, light.range, light.emission.rate, light.emission.start},
               where, "a parameter");
  if (light.type == LightType::sphere && !(light.radius > 0)) {
    throw Error(where, fmt::format("sphere of radius {} m", light.radius), "give it a radius above 0");
  }
  if (light.type == LightType::disc && !(light.radius > 0))
    throw Error(where, fmt::format("disc of radius {} m", light.radius), "give it a radius above 0");
  if (light.type == LightType::rectangle && !(light.size.x > 0 && light.size.y > 0))
    throw Error(where, fmt::format("rectangle of {} × {} m", light.size.x, light.size.y),
                "give it a width and a height above 0");
  if (light.type == LightType::sphl) {
    if (!(light.radius > 0))
      throw Error(where, fmt::format("SPHL of radius {} m", light.radius), "give it a radius above 0");
    check_emission(light.emission, where);
  }
  if (!light.profile.empty()) check_profile(*light.profile.table, where);
  const std::string kind = "light parameters out of range: clamped";
  clamp(light.color, 0, unlimited, repairs, kind);
  clamp(light.intensity, 0, unlimited, repairs, kind);
  clamp(light.angular_radius, 0, pi / 2, repairs, kind);
  clamp(light.outer_cone, 0, pi, repairs, kind);
  clamp(light.inner_cone, 0, light.outer_cone, repairs, kind);
  clamp(light.range, 0, unlimited, repairs, kind);
}

void validate_environment(const Environment& e) {
  const std::string where = label("environment", 0, e.name);
  check_finite(e.color, where, "colour");
  check_finite({e.rotation}, where, "rotation");
  const image::Image& image = e.equirect;
  if (image.empty()) return;
  const bool known = image.channels == 1 || image.channels == 3 || image.channels == 4;
  if (!known || image.width < 1 || image.height < 1 || image.pixels.size() != image.offset(0, image.height)) {
    throw Error(where, fmt::format("image of {}×{}×{} has {} values", image.width, image.height,
                                   image.channels, image.pixels.size()));
  }
  for (const float v : image.pixels) {
    if (!std::isfinite(v)) throw Error(where, "image holds a value that is not finite");
  }
}

/// TRS of an affine matrix; shear is lost. In double: squares of large floats are no floats.
Transform decompose(const mat4& m) {
  glm::dmat3 axes{glm::dmat4(m)};
  Transform t;
  t.translation = vec3(m[3]);
  for (int i = 0; i < 3; ++i) {
    const double length = glm::length(axes[i]);
    t.scale[i] = static_cast<float>(length);
    axes[i] = length > 0 ? axes[i] / length : glm::dvec3(i == 0, i == 1, i == 2);
  }
  if (glm::determinant(axes) < 0) axes = -axes, t.scale = -t.scale;
  t.rotation = quat(glm::normalize(glm::quat_cast(axes)));
  return t;
}

/// Gives every object at node −1 one common root node.
class RootNode {
 public:
  RootNode(Scene& scene, Repairs& repairs) : scene_(scene), repairs_(repairs) {}
  void attach(int& node) {
    if (node != -1) return;
    if (root_ < 0) {
      root_ = static_cast<int>(scene_.nodes.size());
      scene_.nodes.push_back({});
      scene_.nodes.back().name = "root";
    }
    node = root_;
    repairs_.count("objects without a node: placed at the origin");
  }

 private:
  Scene& scene_;
  Repairs& repairs_;
  int root_ = -1;
};

}  // namespace

std::vector<std::string> validate(Scene& scene) {
  check_indices(scene);
  Repairs repairs;
  // Surfaces.
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    validate_material(scene.materials[i], label("material", i, scene.materials[i].name), repairs);
  }
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    validate_mesh(scene.meshes[i], label("mesh", i, scene.meshes[i].name), repairs);
  }

  // Nodes and what moves them.
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    validate_node(scene.nodes[i], label("node", i, scene.nodes[i].name), repairs);
  }
  for (std::size_t i = 0; i < scene.animations.size(); ++i) {
    const std::string animation = label("animation", i, scene.animations[i].name);
    const std::vector<AnimationChannel>& channels = scene.animations[i].channels;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      validate_channel(channels[c], fmt::format("{} channel {}", animation, c));
      Node& node = scene.nodes[channels[c].node];
      if (!node.matrix) continue;
      node.local = decompose(*node.matrix);
      check_finite(node.local.scale, label("node", static_cast<std::size_t>(channels[c].node), node.name),
                   "the matrix's scale");
      node.matrix.reset();
      repairs.count("animated nodes with a matrix: decomposed");
    }
  }
  mark_movable(scene);

  // What stands at nodes.
  RootNode root(scene, repairs);
  for (Instance& instance : scene.instances) root.attach(instance.node);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const std::string where = label("camera", i, scene.cameras[i].name);
    validate_camera(scene.cameras[i], where);
    root.attach(scene.cameras[i].node);
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const std::string where = label("light", i, scene.lights[i].name);
    validate_light(scene.lights[i], where, repairs);
    root.attach(scene.lights[i].node);
  }
  for (std::size_t i = 0; i < scene.sphls.size(); ++i) {
    const std::string where = label("SPHL", i, scene.sphls[i].name);
    if (!(scene.sphls[i].radius > 0) || !std::isfinite(scene.sphls[i].radius)) {
      throw Error(where, fmt::format("radius is {} m", scene.sphls[i].radius), "give it a radius above 0");
    }
    root.attach(scene.sphls[i].node);
  }
  if (scene.environment) validate_environment(*scene.environment);
  return repairs.lines();
}

}  // namespace ssphh::scene
