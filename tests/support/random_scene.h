#pragma once
/// Scenes with at least one of everything that a Scene can hold, and a way to all their numbers.

#include <string>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/scene/scene.h>

namespace ssphh::test {

/// Draws valid values that are no defaults.
class SceneDraw {
 public:
  explicit SceneDraw(std::uint64_t seed) : random_(seed) {}

  float number(float low, float high) { return low + (high - low) * random_.uniform(); }
  int index(std::size_t count) { return static_cast<int>(random_.next() % count); }
  bool coin() { return random_.next() % 2 == 0; }
  vec2 pair(float low, float high) {
    const float x = number(low, high);
    return {x, number(low, high)};
  }
  vec3 triple(float low, float high) {
    const vec2 xy = pair(low, high);
    return {xy, number(low, high)};
  }
  vec3 direction() { return glm::normalize(sample_uniform_sphere(random_.uniform2())); }
  quat rotation() { return glm::angleAxis(number(0.1f, 3), direction()); }

  scene::Transform transform() { return {triple(-3, 3), rotation(), triple(0.3f, 2)}; }
  scene::TextureUse use(std::size_t textures) {
    const auto wrap = [&] { return static_cast<scene::Wrap>(index(3)); };
    return {index(textures), index(2), pair(-1, 1), pair(0.5f, 2), number(-3, 3), wrap(), wrap(), coin()};
  }
  scene::Texture texture(const std::string& name) {
    scene::Texture t{name, 1 + index(3), 1 + index(3), {}};
    for (int i = 0; i < 4 * t.width * t.height; ++i)
      t.rgba.push_back(static_cast<std::uint8_t>(random_.next() >> 24));
    return t;
  }
  scene::Material material(const std::string& name, std::size_t textures) {
    scene::Material m;
    m.name = name;
    m.base_color = triple(0.1f, 0.9f), m.alpha = number(0.1f, 0.9f), m.metallic = number(0.1f, 0.9f);
    m.diffuse_roughness = number(-0.9f, 0.9f), m.specular_roughness = number(-0.9f, 0.9f);
    m.specular = number(0.1f, 0.9f), m.ior = number(1.1f, 2);
    m.transmission = number(0.1f, 0.9f), m.thickness = number(0.1f, 2);
    m.attenuation_color = triple(0.1f, 0.9f), m.attenuation_distance = number(0.1f, 2);
    m.emission = triple(0.1f, 20);
    m.double_sided = coin();
    m.alpha_mode = scene::AlphaMode::mask, m.alpha_cutoff = number(0.1f, 0.9f);
    m.normal_scale = number(0.2f, 0.8f);
    m.base_color_texture = use(textures), m.metallic_roughness_texture = use(textures);
    m.emission_texture = use(textures), m.normal_texture = use(textures);
    m.transmission_texture = use(textures);
    return m;
  }
  scene::Mesh mesh(const std::string& name, int material) {
    scene::Mesh m;
    m.name = name;
    m.material = material;
    for (int i = 0; i < 6; ++i) {
      m.positions.push_back(triple(-1, 1));
      m.normals.push_back(direction());
      m.tangents.emplace_back(direction(), coin() ? 1.0f : -1.0f);
      for (std::vector<vec2>& uv : m.uvs) uv.push_back(pair(-2, 2));
      m.colors.emplace_back(triple(0.1f, 0.9f), number(0.1f, 0.9f));
    }
    m.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 2, 4}};
    return m;
  }
  scene::Light light(scene::LightType type) {
    scene::Light l;
    l.type = type;
    l.color = triple(0.1f, 1), l.intensity = number(0.5f, 50);
    l.radius = number(0.1f, 0.4f), l.angular_radius = number(0.01f, 0.1f);
    l.inner_cone = number(0.1f, 0.3f), l.outer_cone = number(0.4f, 1);
    l.range = number(3, 30);
    if (coin()) {
      l.profile = {"profile", std::make_shared<const scene::PhotometricTable>(
                                  scene::PhotometricTable{scene::Photometry::c,
                                                          {0, number(10, 80), 180},
                                                          {0},
                                                          {number(1, 9), number(1, 9), number(1, 9)}})};
    }
    return l;
  }
  scene::AnimationChannel channel(int node, scene::AnimationPath path) {
    scene::AnimationChannel c;
    c.node = node, c.path = path;
    c.interpolation = static_cast<scene::Interpolation>(index(3));
    float time = number(0, 1);
    for (int key = 0; key < 3; ++key, time += number(0.1f, 1)) {
      c.times.push_back(time);
      for (int n = c.interpolation == scene::Interpolation::cubic_spline ? 3 : 1; n > 0; --n) {
        const quat q = rotation();
        c.values.push_back(path == scene::AnimationPath::rotation ? vec4(q.x, q.y, q.z, q.w)
                                                                  : vec4(triple(0.5f, 2), 0));
      }
    }
    return c;
  }

 private:
  Pcg32 random_;
};

/// Valid; every emitter has a group of its own.
inline scene::Scene random_scene(std::uint64_t seed) {
  SceneDraw draw(seed);
  scene::Scene s;
  const auto numbered = [](const char* kind, std::size_t i) { return kind + std::to_string(i); };
  for (std::size_t i = 0; i < 2; ++i) s.textures.push_back(draw.texture(numbered("texture ", i)));
  for (std::size_t i = 0; i < 2; ++i)
    s.materials.push_back(draw.material(numbered("material ", i), s.textures.size()));
  for (int i = 0; i < 2; ++i) s.meshes.push_back(draw.mesh(numbered("mesh ", std::size_t(i)), 1 - i));
  const auto add_node = [&](const char* kind, std::size_t i) {
    scene::Node& node = s.nodes.emplace_back();
    node.name = numbered(kind, i);
    // Depth first, as files are read: on the node before, or on one that this hangs on.
    node.parent = static_cast<int>(s.nodes.size()) - 2;
    while (node.parent >= 0 && draw.coin()) node.parent = s.nodes[std::size_t(node.parent)].parent;
    node.local = draw.transform();
    return static_cast<int>(s.nodes.size()) - 1;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const int node = add_node("body ", i);
    s.instances.push_back({draw.index(s.meshes.size()), node, i == 2 ? 0 : -1, numbered("glow ", i)});
  }
  // An affine matrix, with shear.
  s.nodes[1].matrix = s.nodes[1].local.matrix() * scene::Transform(draw.transform()).matrix();
  s.nodes[1].local = {};
  for (std::size_t i = 0; i < 2; ++i) {
    scene::Camera camera{numbered("camera ", i), add_node("eye ", i), i == 1,
                         draw.number(0.3f, 1),   draw.number(1, 5),   draw.number(0.5f, 2)};
    s.cameras.push_back(camera);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    scene::Light light = draw.light(static_cast<scene::LightType>(i));
    light.name = numbered("light ", i), light.group = numbered("lit ", i);
    light.node = add_node("light ", i);
    s.lights.push_back(light);
  }
  for (std::size_t i = 0; i < 2; ++i)
    s.sphls.push_back({numbered("SPHL ", i), add_node("SPHL ", i), draw.number(0.05f, 0.2f), i == 0});
  s.animations.push_back({"motion", {}});
  for (const int path : {0, 1, 2})
    s.animations[0].channels.push_back(draw.channel(2, static_cast<scene::AnimationPath>(path)));
  scene::Environment& sky = s.environment.emplace();
  sky.group = "sky", sky.color = draw.triple(0.1f, 2), sky.rotation = draw.number(0.1f, 3);
  sky.equirect = image::Image(4, 2);
  for (float& x : sky.equirect.pixels) x = draw.number(0.1f, 9);
  scene::Light fire = draw.light(scene::LightType::sphl);
  fire.name = "fire", fire.node = add_node("fire ", 0);
  fire.emission = {{sh::IntensitySh(1), sh::IntensitySh(1)}, draw.number(1, 30), draw.number(0, 1), true};
  for (sh::IntensitySh& frame : fire.emission.frames) {
    for (vec3& value : frame.values) value = draw.triple(0.1f, 2);
  }
  s.lights.push_back(fire);
  for (const auto type : {scene::LightType::rectangle, scene::LightType::disc}) {
    scene::Light flat = draw.light(type);
    flat.name = name_of(type), flat.node = add_node("flat ", s.lights.size());
    flat.profile = {};
    if (type == scene::LightType::rectangle) flat.size = {draw.number(0.1f, 2), draw.number(0.1f, 2)};
    s.lights.push_back(flat);
  }
  return s;
}

/// use(name, number) for every float in a scene, in a fixed order.
template <class Use>
void each_float(scene::Scene& s, const Use& use) {
  const auto many = [&](const std::string& name, auto& vector) {
    for (glm::length_t c = 0; c < vector.length(); ++c) use(name + "[" + std::to_string(c) + "]", vector[c]);
  };
  const auto list = [&](const std::string& name, auto& vectors) {
    for (std::size_t i = 0; i < vectors.size(); ++i) many(name + " " + std::to_string(i), vectors[i]);
  };
  const auto each = [](const char* kind, auto& objects, const auto& one) {
    for (std::size_t i = 0; i < objects.size(); ++i) one(kind + std::to_string(i) + " ", objects[i]);
  };
  each("material ", s.materials, [&](const std::string& at, scene::Material& m) {
    many(at + "base_color", m.base_color), many(at + "emission", m.emission);
    use(at + "alpha", m.alpha), use(at + "metallic", m.metallic);
    use(at + "diffuse_roughness", m.diffuse_roughness), use(at + "specular_roughness", m.specular_roughness);
    use(at + "specular", m.specular), use(at + "ior", m.ior);
    use(at + "transmission", m.transmission), use(at + "thickness", m.thickness);
    many(at + "attenuation_color", m.attenuation_color);
    use(at + "attenuation_distance", m.attenuation_distance);
    use(at + "alpha_cutoff", m.alpha_cutoff), use(at + "normal_scale", m.normal_scale);
    int slot = 0;
    for (scene::TextureUse* t : {&m.base_color_texture, &m.metallic_roughness_texture, &m.emission_texture,
                                 &m.normal_texture, &m.transmission_texture}) {
      const std::string of = at + "texture use " + std::to_string(slot++) + " ";
      many(of + "offset", t->offset), many(of + "scale", t->scale), use(of + "rotation", t->rotation);
    }
  });
  each("mesh ", s.meshes, [&](const std::string& at, scene::Mesh& m) {
    list(at + "position", m.positions), list(at + "normal", m.normals), list(at + "tangent", m.tangents);
    list(at + "uv0", m.uvs[0]), list(at + "uv1", m.uvs[1]), list(at + "color", m.colors);
  });
  each("node ", s.nodes, [&](const std::string& at, scene::Node& n) {
    if (n.matrix) {
      for (glm::length_t c = 0; c < 4; ++c) many(at + "matrix column " + std::to_string(c), (*n.matrix)[c]);
    } else {
      many(at + "translation", n.local.translation), many(at + "rotation", n.local.rotation);
      many(at + "scale", n.local.scale);
    }
  });
  each("camera ", s.cameras, [&](const std::string& at, scene::Camera& c) {
    use(at + "yfov", c.yfov), use(at + "yheight", c.yheight);
    if (c.aspect) use(at + "aspect", *c.aspect);
  });
  each("light ", s.lights, [&](const std::string& at, scene::Light& l) {
    many(at + "color", l.color), use(at + "intensity", l.intensity), use(at + "radius", l.radius);
    many(at + "size", l.size);
    use(at + "angular_radius", l.angular_radius), use(at + "inner_cone", l.inner_cone);
    use(at + "outer_cone", l.outer_cone), use(at + "range", l.range);
  });
  each("SPHL ", s.sphls, [&](const std::string& at, scene::Sphl& p) { use(at + "radius", p.radius); });
  each("animation ", s.animations, [&](const std::string& at, scene::Animation& a) {
    for (std::size_t i = 0; i < a.channels.size(); ++i) {
      const std::string of = at + "channel " + std::to_string(i) + " ";
      for (float& time : a.channels[i].times) use(of + "time", time);
      list(of + "value", a.channels[i].values);
    }
  });
  if (s.environment) {
    many("environment color", s.environment->color), use("environment rotation", s.environment->rotation);
    for (float& x : s.environment->equirect.pixels) use("environment pixel", x);
  }
}

struct NamedFloat {
  std::string name;
  float* value = nullptr;
};

inline std::vector<NamedFloat> floats_of(scene::Scene& s) {
  std::vector<NamedFloat> result;
  each_float(s, [&](const std::string& name, float& value) { result.push_back({name, &value}); });
  return result;
}

}  // namespace ssphh::test
