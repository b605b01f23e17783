#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

// Names count only where they choose something: cameras, SPHLs and light groups.

Hasher& add(Hasher& h, const vec2& v) {
  return h.value(v.x).value(v.y);
}
Hasher& add(Hasher& h, const vec3& v) {
  return h.value(v.x).value(v.y).value(v.z);
}
Hasher& add(Hasher& h, const quat& q) {
  return h.value(q.x).value(q.y).value(q.z).value(q.w);
}

void add(Hasher& h, const TextureUse& t) {
  h.value(t.texture);
  if (t.texture < 0) return;
  add(add(h.value(t.uv_set), t.offset), t.scale);
  h.value(t.rotation).value(t.wrap_u).value(t.wrap_v).value(t.nearest);
}

void add(Hasher& h, const Texture& t) {
  h.value(t.width).value(t.height).array(t.rgba);
}

void add(Hasher& h, const Material& m) {
  add(h, m.base_color);
  h.value(m.alpha).value(m.metallic).value(m.diffuse_roughness).value(m.specular_roughness);
  h.value(m.specular).value(m.ior);
  add(h, m.emission);
  h.value(m.unlit).value(m.double_sided).value(m.alpha_mode).value(m.alpha_cutoff).value(m.normal_scale);
  add(h, m.base_color_texture);
  add(h, m.metallic_roughness_texture);
  add(h, m.emission_texture);
  add(h, m.normal_texture);
}

void add(Hasher& h, const Mesh& m) {
  h.array(m.positions).array(m.normals).array(m.tangents).array(m.uvs[0]).array(m.uvs[1]).array(m.colors);
  h.array(m.triangles);  // the material counts where an instance uses it
}

void add(Hasher& h, const Node& n) {
  h.value(n.parent).value(n.matrix.has_value());
  if (n.matrix) {
    for (int column = 0; column < 4; ++column) add(h, vec3((*n.matrix)[column])).value((*n.matrix)[column].w);
  } else {
    add(add(add(h, n.local.translation), n.local.rotation), n.local.scale);
  }
}

void add(Hasher& h, const Camera& c) {
  h.text(c.name).value(c.node).value(c.orthographic).value(c.orthographic ? c.yheight : c.yfov);
  h.value(c.aspect.value_or(0.0f));
}

void add(Hasher& h, const Light& l) {
  add(h.text(light_group(l)).value(l.node).value(l.type), l.color);
  h.value(l.intensity).value(l.radius).value(l.angular_radius).value(l.inner_cone).value(l.outer_cone);
  h.value(l.range);
}

void add(Hasher& h, const Environment& e) {
  add(h.text(light_group(e)), e.color).value(e.rotation);
  h.value(e.equirect.width).value(e.equirect.height).value(e.equirect.channels).array(e.equirect.pixels);
}

void add(Hasher& h, const AnimationChannel& c) {
  h.value(c.node).value(c.path).value(c.interpolation).array(c.times).array(c.values);
}

template <class T>
void add_all(Hasher& h, const std::vector<T>& items) {
  h.value(static_cast<std::uint64_t>(items.size()));
  for (const T& item : items) add(h, item);
}

}  // namespace

Hash128 scene_hash(const Scene& scene) {
  Hasher h;
  add_all(h, scene.textures);
  add_all(h, scene.materials);
  add_all(h, scene.meshes);
  add_all(h, scene.nodes);
  h.value(static_cast<std::uint64_t>(scene.instances.size()));
  for (const Instance& instance : scene.instances) {
    h.value(instance.mesh).value(instance.node).value(instance_material(scene, instance));
    const int material = instance_material(scene, instance);
    const bool emits = material >= 0 && scene.materials[static_cast<std::size_t>(material)].emissive();
    h.text(emits ? light_group(scene, instance) : "");
  }
  add_all(h, scene.cameras);
  add_all(h, scene.lights);
  h.value(static_cast<std::uint64_t>(scene.sphls.size()));
  for (const Sphl& s : scene.sphls) h.text(s.name).value(s.node).value(s.radius).value(s.enabled);
  for (const Animation& animation : scene.animations) add_all(h, animation.channels);
  h.value(scene.environment.has_value());
  if (scene.environment) add(h, *scene.environment);
  return h.finish();
}

}  // namespace ssphh::scene
