#include "digests.h"

namespace ssphh::scene {

// −0 + 0 is 0: the sign of a zero is no difference, and files that leave out defaults lose it.
Hasher& add(Hasher& h, const vec2& v) {
  return h.value(v.x + 0.0f).value(v.y + 0.0f);
}
Hasher& add(Hasher& h, const vec3& v) {
  return add(h, vec2(v)).value(v.z + 0.0f);
}
Hasher& add(Hasher& h, const quat& q) {
  return add(h, vec3(q.x, q.y, q.z)).value(q.w + 0.0f);
}

Hasher& add(Hasher& h, const Hash128& hash) {
  return h.value(hash.high).value(hash.low);
}

Hash128 digest(const Texture& t) {
  Hasher h;
  h.value(t.width).value(t.height).array(t.rgba);
  return h.finish();
}

void add(Hasher& h, const TextureUse& t, const std::vector<Hash128>& textures) {
  h.value(t.texture >= 0);
  if (t.texture < 0) return;
  add(h, textures[t.texture]);
  add(add(h.value(t.uv_set), t.offset), t.scale);
  h.value(t.rotation).value(t.wrap_u).value(t.wrap_v).value(t.nearest);
}

Hash128 digest(const Material& m, const std::vector<Hash128>& textures) {
  Hasher h;
  add(h, m.base_color);
  h.value(m.alpha).value(m.metallic).value(m.diffuse_roughness).value(m.specular_roughness);
  h.value(m.specular).value(m.ior);
  if (m.transmission > 0) {
    h.text("glass").value(m.transmission).value(m.thickness > 0);
    if (m.thickness > 0) add(h, m.attenuation_color).value(m.attenuation_distance);
    add(h, m.transmission_texture, textures);
  }
  add(h, m.emission);
  h.value(m.unlit).value(m.double_sided).value(m.alpha_mode);
  if (m.alpha_mode == AlphaMode::mask) h.value(m.alpha_cutoff);
  if (m.normal_texture.texture >= 0) h.value(m.normal_scale);
  add(h, m.base_color_texture, textures);
  add(h, m.metallic_roughness_texture, textures);
  add(h, m.emission_texture, textures);
  add(h, m.normal_texture, textures);
  return h.finish();
}

Hash128 digest(const Mesh& m) {
  Hasher h;
  h.array(m.positions).array(m.normals).array(m.tangents).array(m.uvs[0]).array(m.uvs[1]).array(m.colors);
  return h.array(m.triangles).finish();
}

void add(Hasher& h, const Node& n) {
  h.value(n.parent).value(n.matrix.has_value());
  if (n.matrix) {
    for (int column = 0; column < 4; ++column) add(h, vec3((*n.matrix)[column])).value((*n.matrix)[column].w);
  } else {
    add(add(add(h, n.local.translation), n.local.rotation), n.local.scale);
  }
}

void add(Hasher& h, const Light& l) {
  add(h.text(light_group(l)).value(l.node).value(l.type), l.color).value(l.intensity);
  h.value(l.type == LightType::directional ? l.angular_radius : l.range);
  if (l.type == LightType::spot) h.value(l.inner_cone).value(l.outer_cone);
  if (l.type == LightType::sphere || l.type == LightType::sphl || l.type == LightType::disc)
    h.value(l.radius);
  if (l.type == LightType::rectangle) add(h, l.size);
  if (l.has_profile()) {
    const PhotometricTable& t = *l.profile.table;
    h.text("profile").value(t.type).array(t.polar).array(t.turn).array(t.candela);
  }
  if (l.type != LightType::sphl) return;
  h.value(l.emission.frames.size()).value(l.emission.rate).value(l.emission.start).value(l.emission.repeat);
  for (const sh::IntensitySh& frame : l.emission.frames) h.array(frame.values);
}

void add(Hasher& h, const Environment& e) {
  add(h.text(light_group(e)), e.color).value(e.rotation);
  h.value(e.equirect.width).value(e.equirect.height).value(e.equirect.channels).array(e.equirect.pixels);
}

void add(Hasher& h, const Camera& c) {
  h.text(c.name).value(c.node).value(c.orthographic).value(c.orthographic ? c.yheight : c.yfov);
  h.value(c.aspect.value_or(0.0f));
}

void add(Hasher& h, const Sphl& s) {
  h.text(s.name).value(s.node).value(s.radius).value(s.enabled);
}

void add(Hasher& h, const AnimationChannel& c) {
  h.value(c.node).value(c.path).value(c.interpolation).array(c.times).array(c.values);
}

std::vector<Hash128> node_digests(const Scene& scene) {
  std::vector<std::vector<const AnimationChannel*>> channels(scene.nodes.size());
  for (const Animation& animation : scene.animations) {
    for (const AnimationChannel& c : animation.channels) channels[c.node].push_back(&c);
  }
  std::vector<Hash128> digests;  // parents stand before their children
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    Node node = scene.nodes[i];
    Hasher h;
    add(h, node.parent < 0 ? Hash128{} : digests[node.parent]);
    node.parent = -1;
    add(h, node);
    for (const AnimationChannel* c : channels[i])
      h.value(c->path).value(c->interpolation).array(c->times).array(c->values);
    digests.push_back(h.finish());
  }
  return digests;
}

}  // namespace ssphh::scene
