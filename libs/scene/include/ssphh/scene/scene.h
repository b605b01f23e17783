#pragma once
/// A scene as plain data: arrays that refer to each other by index (−1: none), with defaults and units. Knows
/// neither files nor renderers. World: right-handed, y up, metres; colours scene-linear Rec.709
/// (docs/conventions.md).

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/math.h>
#include <ssphh/image/image.h>
#include <ssphh/scene/emission.h>
#include <ssphh/scene/lamp_profile.h>
#include <ssphh/scene/light_mode.h>
#include <ssphh/scene/sun_sky_params.h>

namespace ssphh::scene {

/// 8-bit RGBA texels, row 0 on top, as stored in the file. The slot that uses a texture decides whether its
/// RGB is sRGB-encoded (base colour, emission) or linear (everything else).
struct Texture {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

enum class Wrap { repeat, mirror, clamp };
constexpr auto enum_table(Wrap) {
  using enum Wrap;
  return std::to_array<EnumName<Wrap>>({{repeat, "repeat"}, {mirror, "mirror"}, {clamp, "clamp"}});
}

/// A texture as a material uses it: uv' = translate(offset) · rotate(rotation) · scale(scale) · uv, as
/// KHR_texture_transform; v points down the image.
struct TextureUse {
  int texture = -1;
  int uv_set = 0;  ///< 0 or 1
  vec2 offset{0}, scale{1};
  float rotation = 0;  ///< radians, counter-clockwise
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool nearest = false;  ///< no interpolation
};

enum class AlphaMode { opaque, mask, blend };
constexpr auto enum_table(AlphaMode) {
  using enum AlphaMode;
  return std::to_array<EnumName<AlphaMode>>({{opaque, "opaque"}, {mask, "mask"}, {blend, "blend"}});
}

/// Surface. Diffuse and specular roughness are *bipolar* as in the paper (§5): the sign chooses the model,
/// the magnitude is the roughness.
struct Material {
  std::string name;
  vec3 base_color{0.8f};        ///< diffuse albedo of a dielectric, F0 of a metal; multiplied by its texture
  float alpha = 1;              ///< coverage, multiplied by the base colour texture's alpha
  float metallic = 0;           ///< 0..1
  float diffuse_roughness = 0;  ///< −1..0: Oren–Nayar of |value|; 0: Lambert; 0..1: Disney diffuse of value
  float specular_roughness =
      1;               ///< −1..0: normalised Blinn–Phong of |value|; 0..1: GGX, perceptual (α = value²)
  float specular = 1;  ///< weight of the dielectric specular lobe; 0 leaves pure diffuse
  float ior = 1.5f;    ///< dielectric F0 = ((ior − 1)/(ior + 1))²; of glass, also how it refracts
  /// Share of a dielectric's base that is glass, 0..1: light goes through it, tinted by the base colour,
  /// where it would be scattered. Times the red channel of its texture.
  float transmission = 0;
  float thickness = 0;        ///< of glass: 0 is a thin sheet, passed straight; above 0 [m] the mesh is the
                              ///< boundary of a solid body, whose real extent counts
  vec3 attenuation_color{1};  ///< share of white light that is left after attenuation_distance in a body
  float attenuation_distance = 0;  ///< metres; 0: the body absorbs nothing
  vec3 emission{0};    ///< emitted radiance [W sr⁻¹ m⁻²], emissive strength included; times its texture
  bool unlit = false;  ///< KHR_materials_unlit: emits base_color, reflects nothing
  bool double_sided = false;  ///< emission from both faces; reflection is two-sided in any case
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  float normal_scale = 1;
  TextureUse base_color_texture, metallic_roughness_texture, emission_texture, normal_texture;
  TextureUse transmission_texture;

  /// Every place for a texture, used or not.
  std::array<const TextureUse*, 5> texture_uses() const {
    return {&base_color_texture, &metallic_roughness_texture, &emission_texture, &normal_texture,
            &transmission_texture};
  }
  /// Light may go through it.
  bool is_glass() const {
    return transmission > 0 && !unlit && (metallic < 1 || metallic_roughness_texture.texture >= 0);
  }
  bool emissive() const { return max_component(emission) > 0 || unlit; }
};

/// Triangles in object space. Optional arrays are empty or as long as `positions`.
struct Mesh {
  std::string name;
  std::vector<vec3> positions;
  std::vector<vec3> normals;             ///< unit; empty: geometric normals
  std::vector<vec4> tangents;            ///< xyz and handedness w
  std::array<std::vector<vec2>, 2> uvs;  ///< TEXCOORD_0, TEXCOORD_1
  std::vector<vec4> colors;              ///< linear RGBA factors on the base colour
  std::vector<uvec3> triangles;          ///< counter-clockwise seen from the front
  int material = -1;                     ///< −1: Material{}
};

struct Transform {
  vec3 translation{0};
  quat rotation{1, 0, 0, 0};
  vec3 scale{1};

  mat4 matrix() const;
};

struct Node {
  std::string name;
  int parent = -1;  ///< always smaller than the node's own index
  Transform local;
  std::optional<mat4> matrix;  ///< replaces `local` where a file gives a matrix
  bool movable = false;        ///< it or an ancestor is animated
};

/// A mesh at a node. Emissive triangles belong to the instance's light group.
struct Instance {
  int mesh = -1, node = -1;
  int material = -1;        ///< −1: the mesh's material
  std::string light_group;  ///< of its emission; empty: the node's name
};

/// Looks along −z of its node, y up.
struct Camera {
  std::string name;
  int node = -1;
  bool orthographic = false;
  float yfov = 0.8f;            ///< radians, perspective
  float yheight = 2;            ///< metres seen vertically, orthographic
  std::optional<float> aspect;  ///< width/height as the file asks; a render's own size wins
};

/// `sphl`: an SPHL that shines, a small lamp whose intensity is a function of the direction (emission.h).
/// `rectangle`, `disc`: flat, and shine from the side toward −z of their node alone (area_lamp.h).
enum class LightType { point, spot, directional, sphere, sphl, rectangle, disc };
constexpr auto enum_table(LightType) {
  using enum LightType;
  return std::to_array<EnumName<LightType>>({{point, "point"},
                                             {spot, "spot"},
                                             {directional, "directional"},
                                             {sphere, "sphere"},
                                             {sphl, "sphl"},
                                             {rectangle, "rectangle"},
                                             {disc, "disc"}});
}

/// A light that is not a mesh. Position and direction (−z) are its node's.
struct Light {
  std::string name;
  std::string group;  ///< empty: the name
  int node = -1;
  LightType type = LightType::point;
  vec3 color{1};
  /// point, spot: radiant intensity [W/sr] (glTF's candela read as W/sr); directional: irradiance on a facing
  /// plane [W/m²] (glTF's lux); sphere, rectangle, disc: emitted radiance [W sr⁻¹ m⁻²]; sphl: factor on its
  /// emission.
  float intensity = 1;
  /// sphere, sphl, disc: metres, not scaled by the node. What stands within an SPHL shadows nothing, since
  /// the SPHL shines in its place; no point is lit more than from this distance.
  float radius = 0;
  vec2 size{0};              ///< rectangle: along the node's x and y [m], likewise
  Emission emission;         ///< sphl: in the node's axes
  float angular_radius = 0;  ///< directional: radians; 0 is a delta light, the sun's is 0.00465
  float inner_cone = 0, outer_cone = pi / 4;  ///< spot, radians from the axis
  float range = 0;  ///< 0: unlimited; else the falloff KHR_lights_punctual recommends
  /// point, spot: shares of `intensity`, which is that of the brightest direction; empty: alike in all
  /// directions. A spot's cones narrow it further.
  LampProfile profile{};

  bool has_profile() const {
    return !profile.empty() && (type == LightType::point || type == LightType::spot);
  }
};

/// Infinitely distant light: an equirectangular image (see docs/conventions.md for its axes) or a constant.
struct Environment {
  std::string name = "environment";
  std::string group;                      ///< empty: the name
  image::Image equirect;                  ///< radiance; empty: `color` everywhere
  vec3 color{1};                          ///< factor on the image, or the constant radiance
  float rotation = 0;                     ///< radians about +y, counter-clockwise seen from above
  std::optional<SunSkyParams> sun_sky{};  ///< what the image was computed from; none: it was not
};

/// A spherical-harmonics light of the paper: a probe, and an emitter for VIZ.
struct Sphl {
  std::string name;
  int node = -1;
  float radius = 0.1f;  ///< metres; of the VIZ emitter sphere
  bool enabled = true;
};

enum class AnimationPath { translation, rotation, scale };
enum class Interpolation { step, linear, cubic_spline };

/// Keyframes of one property of one node; cubic_spline has three values (in-tangent, value, out-tangent) per
/// time.
struct AnimationChannel {
  int node = -1;
  AnimationPath path = AnimationPath::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;  ///< seconds, increasing
  std::vector<vec4> values;  ///< xyz, or quaternion xyzw
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
};

struct Scene {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<Instance> instances;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<Sphl> sphls;
  std::vector<Animation> animations;
  std::optional<Environment> environment;
  std::vector<GroupMode> light_modes;  ///< of light groups that ask for one, each once
  /// Light groups that are switched off, each once: their factor is 0, but what they would emit is kept for
  /// those who turn it up again. Renderers are given scenes without_dark_light() (with_lighting.h).
  std::vector<std::string> dark_groups;
  /// What the file holds and this project does not use, one line each ("extension KHR_materials_sheen (2
  /// uses)").
  std::vector<std::string> ignored;
};

}  // namespace ssphh::scene
