#pragma once
/// The fields of a scene in the order of a manifest, for reading and writing alike. `io` takes every field as
/// a reference; enums with their last value.

#include <ssphh/scene/scene.h>

namespace ssphh::farm {

void fields(auto& io, auto& t, const scene::Texture*) {
  io(t.name), io(t.width), io(t.height), io(t.rgba);
}
void fields(auto& io, auto& t, const scene::TextureUse*) {
  io(t.texture), io(t.uv_set), io(t.offset), io(t.scale), io(t.rotation);
  io.choice(t.wrap_u, scene::Wrap::clamp), io.choice(t.wrap_v, scene::Wrap::clamp), io(t.nearest);
}
void fields(auto& io, auto& m, const scene::Material*) {
  io(m.name), io(m.base_color), io(m.alpha), io(m.metallic), io(m.diffuse_roughness);
  io(m.specular_roughness), io(m.specular), io(m.ior), io(m.transmission), io(m.thickness);
  io(m.attenuation_color), io(m.attenuation_distance), io(m.emission), io(m.unlit), io(m.double_sided);
  io.choice(m.alpha_mode, scene::AlphaMode::blend), io(m.alpha_cutoff), io(m.normal_scale);
  io(m.base_color_texture), io(m.metallic_roughness_texture), io(m.emission_texture), io(m.normal_texture);
  io(m.transmission_texture);
}
void fields(auto& io, auto& m, const scene::Mesh*) {
  io(m.name), io(m.positions), io(m.normals), io(m.tangents), io(m.uvs[0]), io(m.uvs[1]), io(m.colors);
  io(m.triangles), io(m.material);
}
void fields(auto& io, auto& n, const scene::Node*) {
  io(n.name), io(n.parent), io(n.local.translation), io(n.local.rotation), io(n.local.scale);
  io(n.matrix), io(n.movable);
}
void fields(auto& io, auto& i, const scene::Instance*) {
  io(i.mesh), io(i.node), io(i.material), io(i.light_group);
}
void fields(auto& io, auto& c, const scene::Camera*) {
  io(c.name), io(c.node), io(c.orthographic), io(c.yfov), io(c.yheight), io(c.aspect);
}
void fields(auto& io, auto& s, const sh::IntensitySh*) {
  io(s.values);
}
void fields(auto& io, auto& e, const scene::Emission*) {
  io(e.frames), io(e.rate), io(e.start), io(e.repeat);
}
void fields(auto& io, auto& t, const scene::PhotometricTable*) {
  io.choice(t.type, scene::Photometry::a), io(t.polar), io(t.turn), io(t.candela);
}
void fields(auto& io, auto& l, const scene::Light*) {
  io(l.name), io(l.group), io(l.node), io.choice(l.type, scene::LightType::disc), io(l.color);
  io(l.intensity), io(l.radius), io(l.size), io(l.angular_radius), io(l.inner_cone), io(l.outer_cone),
      io(l.range);
  io(l.emission), io(l.profile.name), io(l.profile.table);
}
void fields(auto& io, auto& e, const scene::Environment*) {
  io(e.name), io(e.group), io(e.equirect.width), io(e.equirect.height), io(e.equirect.channels);
  io(e.equirect.pixels), io(e.color), io(e.rotation);
}
void fields(auto& io, auto& s, const scene::Sphl*) {
  io(s.name), io(s.node), io(s.radius), io(s.enabled);
}
void fields(auto& io, auto& c, const scene::AnimationChannel*) {
  io(c.node), io.choice(c.path, scene::AnimationPath::scale);
  io.choice(c.interpolation, scene::Interpolation::cubic_spline), io(c.times), io(c.values);
}
void fields(auto& io, auto& a, const scene::Animation*) {
  io(a.name), io(a.channels);
}
void fields(auto& io, auto& m, const scene::GroupMode*) {
  io(m.group), io.choice(m.mode, scene::LightMode::baked);
}
void fields(auto& io, auto& s, const scene::Scene*) {
  io(s.name), io(s.textures), io(s.materials), io(s.meshes), io(s.nodes), io(s.instances), io(s.cameras);
  io(s.lights), io(s.sphls), io(s.animations), io(s.environment), io(s.light_modes);
  io(s.dark_groups), io(s.ignored);
}

}  // namespace ssphh::farm
