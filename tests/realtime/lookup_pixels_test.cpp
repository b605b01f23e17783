/// Light looked up from probes, at the middle of every pixel: what OpenGL draws against the CPU's lookups of
/// the same probes, whose colours differ strongly from probe to probe and by direction. libs/probes/tests
/// hold these lookups against formulas.

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/shading/bsdf.h>

#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

constexpr PictureSize lookup_size{72, 48};

using probes::LookupMethod;
using probes::WeightMethod;

/// An empty room of walls of other colours, 4 × 3 × 5 m, seen from inside: no probe hides another.
scene::Scene room(const scene::Material& walls) {
  scene::Scene s;
  const std::array<std::array<vec3, 3>, 6> quads = {{{vec3(0, 0, 5), vec3(4, 0, 0), vec3(0, 0, -5)},
                                                     {vec3(0, 3, 0), vec3(4, 0, 0), vec3(0, 0, 5)},
                                                     {vec3(0, 0, 5), vec3(0, 0, -5), vec3(0, 3, 0)},
                                                     {vec3(4, 0, 0), vec3(0, 0, 5), vec3(0, 3, 0)},
                                                     {vec3(0, 0, 0), vec3(4, 0, 0), vec3(0, 3, 0)},
                                                     {vec3(4, 0, 5), vec3(-4, 0, 0), vec3(0, 3, 0)}}};
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const auto share = static_cast<float>(i) / 5;
    s.materials.push_back(walls);
    s.materials.back().base_color = {0.9f - 0.6f * share, 0.3f + 0.5f * share, 0.5f + 0.3f * (share - 0.5f)};
    add_mesh(s, scene::make_quad(quads[i][0], quads[i][1], quads[i][2]), static_cast<int>(i));
  }
  scene::Node& eye = s.nodes.emplace_back();
  eye.local.translation = {3.613f, 2.407f, 4.711f};
  eye.local.rotation = glm::quatLookAt(glm::normalize(vec3(-1, -0.5f, -1.3f)), vec3(0, 1, 0));
  s.cameras.emplace_back().node = static_cast<int>(s.nodes.size()) - 1;
  s.cameras.back().yfov = 1.3f;
  scene::validate(s);
  return s;
}

/// On a grid 1 m apart, half a metre off the walls.
std::vector<vec3> grid() {
  std::vector<vec3> places;
  for (int i = 0; i < 4 * 3 * 5; ++i) places.push_back(vec3(i % 4, i / 4 % 3, i / 12) + 0.5f);
  return places;
}

/// So few that the order in which they are taken does not matter: OpenGL's is by the cell's middle.
std::vector<vec3> eight() {
  std::vector<vec3> places;
  for (int i = 0; i < 8; ++i)
    places.push_back(vec3(0.9f, 0.7f, 1.1f) + vec3(i % 2, i / 2 % 2, i / 4) * vec3(2, 1.5f, 3));
  return places;
}

/// What surfaces reflect of a lookup: libs/trace does the same at the first hit.
image::Image looked_up(const PixelPoints& points, const rays::IndirectLight& light,
                       const scene::Material& walls = matte(vec3(1))) {
  const float root = (walls.ior - 1) / (walls.ior + 1), f0 = root * root * walls.specular;
  return points.picture([&](const PixelPoint& p) {
    const vec3 n = p.point.normal, mirror = glm::reflect(-p.wo, n);
    const vec3 irradiance = light.irradiance(p.point);
    if (f0 == 0) return p.hit.albedo / pi * irradiance;
    const auto wall = static_cast<float>(n.y > 0.5f    ? 0
                                         : n.y < -0.5f ? 1
                                         : n.x > 0.5f  ? 2
                                         : n.x < -0.5f ? 3
                                         : n.z > 0.5f  ? 4
                                                       : 5) /
                      5;
    const vec3 base(0.9f - 0.6f * wall, 0.3f + 0.5f * wall, 0.5f + 0.3f * (wall - 0.5f));
    const vec3 e =
        shading::directional_albedo({vec3(0), vec3(f0), 0, walls.specular_roughness}, glm::dot(p.wo, n));
    return base * (vec3(1) - e) / pi * irradiance +
           e * light.glossy(p.point, mirror, walls.specular_roughness);
  });
}

/// Every second one red, the others blue.
probes::ProbeSet coloured(probes::ProbeSet set) {
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    for (probes::GroupLight& light : set.probes[i].groups)
      light.reflected *= (i + i / 2 + i / 4) % 2 ? vec3(4, 1, 0.4f) : vec3(0.3f, 1.5f, 3);
  }
  probes::merge_groups(set);
  return set;
}

class LookupPixels : public WithGl {
 protected:
  /// Bounds of `truth`; places where it `differs` may lie a pixel aside.
  template <class Differs>
  static PictureBounds bounds_of(const PixelPoints& points, const image::Image& truth, float share,
                                 const Differs& differs) {
    PictureBounds bounds = PictureBounds::around(truth, share, 3e-4f);
    const std::vector<bool> edges = points.edges(differs);
    EXPECT_LT(bounds.widen([&](int x, int y) { return edges[y * lookup_size.width + x]; }), 0.25);
    // One texel of a probe's map tells whether it is seen: within 1.5 of them, 2 * 3.9 m / 254 wide, the next
    // wall may hide it. Closer still, rounding says which wall a pixel shows
    for (const PixelPoint& p : points.pixels) {
      const vec3 x = p.point.position,
                 away = glm::min(x, vec3(4, 3, 5) - x) + 10.0f * glm::abs(p.point.normal);
      bounds.left_out.push_back(std::min({away.x, away.y, away.z}) < 0.05f);
    }
    EXPECT_LT(std::ranges::count(bounds.left_out, true), 0.08 * lookup_size.width * lookup_size.height);
    return bounds;
  }
  static PictureBounds bounds_of(const PixelPoints& points, const image::Image& truth, float share) {
    return bounds_of(points, truth, share, [](std::size_t, std::size_t) { return false; });
  }
  image::Image draw(realtime::Renderer& renderer, const scene::Scene& scene, const std::string& camera,
                    LookupMethod method, WeightMethod weights) {
    realtime::FrameSettings settings;
    settings.view = realtime::View::indirect;
    settings.lookup = method, settings.weights = weights;
    renderer.draw(pose_of(scene, camera), settings,
                  {.width = lookup_size.width, .height = lookup_size.height});
    return renderer.read_back();
  }
  static scene::CameraPose pose_of(const scene::Scene& scene, const std::string& camera) {
    scene::CameraPose pose = scene::camera_pose(scene, camera);
    pose.world[3] += vec4(0.013f, 0.007f, 0, 0);  // no edge passes through the middle of pixels
    return pose;
  }
  static std::unique_ptr<rays::IndirectLight> lookup(const probes::ProbeSet& probes,
                                                     const trace::PathTracer& tracer, LookupMethod method,
                                                     WeightMethod weights) {
    probes::LookupParams params;
    params.weights.method = weights;
    return probes::make_lookup(method, probes, tracer, params);
  }
};

/// Drawing a leaf into shadow maps takes its texture's sampler, of mipmaps and repeat, to a unit where lists
/// of records are: the first frame, which draws those maps, looked nothing up there.
TEST_F(LookupPixels, TexturesInShadowMapsDoNotHideRecords) {
  scene::Scene scene = room(matte(vec3(1)));
  scene::Texture& leaf = scene.textures.emplace_back();
  leaf.name = "leaf", leaf.width = leaf.height = 2;
  for (int i = 0; i < 4; ++i)
    leaf.rgba.insert(leaf.rgba.end(), {80, 170, 90, i == 0 ? std::uint8_t{0} : std::uint8_t{255}});
  scene.materials.push_back(matte(vec3(1)));
  scene.materials.back().alpha_mode = scene::AlphaMode::mask;
  scene.materials.back().base_color_texture.texture = 0;
  add_mesh(scene, scene::make_quad({0.5f, 0.5f, 0.5f}, {0.3f, 0, 0}, {0, 0.3f, 0}), 6);
  const trace::PathTracer tracer(scene);
  probes::ProbeSet probes = made_up_probes(grid());
  probes.surface = made_up_records(made_up_fit(scene, probes, 800).points, probes.light_groups);
  realtime::Renderer renderer(gl(), scene);
  renderer.set_probes(probes);
  set_records(renderer, scene, *probes.surface, tracer);
  const auto picture = [&] {
    return draw(renderer, scene, "", LookupMethod::irradiance, WeightMethod::surface);
  };
  const image::Image first = picture();
  EXPECT_GT(renderer.stats().shadow_maps_drawn, 0);
  EXPECT_EQ(first.pixels, picture().pixels);
  EXPECT_EQ(renderer.stats().shadow_maps_drawn, 0);
}

/// Bilinear interpolation in an octahedral tile of 24 texels, pi / 24 rad apart or 1.6 times as much: h² / 8
/// of the curvature, up to l (l + 1) of band l. Bands of made-up light are 0.28, 0.25 √(2l + 1) at most of a
/// mean of 0.5 to 2: irradiance's curvature hardly exceeds its value, 0.55 %. And halves and 10 bits of a
/// colour's root, 0.4 %.
constexpr float tile = 0.01f;

struct Weights {
  LookupMethod method;
  WeightMethod weights;
  const char* name;
};
void PrintTo(const Weights& w, std::ostream* out) {
  *out << w.name;
}
const Weights all_weights[] = {{LookupMethod::irradiance, WeightMethod::distance, "distance"},
                               {LookupMethod::irradiance, WeightMethod::trilinear, "trilinear"},
                               {LookupMethod::irradiance, WeightMethod::mls, "mls"},
                               {LookupMethod::irradiance, WeightMethod::fitted, "fitted"},
                               {LookupMethod::irradiance, WeightMethod::surface, "surface"},
                               {LookupMethod::light, WeightMethod::distance, "light"}};

class EveryWeight : public LookupPixels, public testing::WithParamInterface<Weights> {};

TEST_P(EveryWeight, InAnEmptyRoomEveryPixelIsTheCpus) {
  const Weights& w = GetParam();
  const scene::Scene scene = room(matte(vec3(1)));
  const trace::PathTracer tracer(scene);
  probes::ProbeSet probes = w.method == LookupMethod::light       ? coloured(smooth_probes(eight()))
                            : w.weights == WeightMethod::distance ? coloured(made_up_probes(eight()))
                                                                  : made_up_probes(grid());
  if (w.weights == WeightMethod::fitted) probes.fitted = made_up_fit(scene, probes, 800);
  if (w.weights == WeightMethod::surface)
    probes.surface = made_up_records(made_up_fit(scene, probes, 800).points, probes.light_groups);
  const trace::TransportScene source(scene);
  const PixelPoints points(source, pose_of(scene, ""), lookup_size);
  realtime::Renderer renderer(gl(), scene);
  renderer.set_probes(probes);
  if (probes.surface) set_records(renderer, scene, *probes.surface, tracer);
  if (probes.fitted) renderer.set_fitted(prepared(scene, *probes.fitted, tracer));
  const image::Image truth = looked_up(points, *lookup(probes, tracer, w.method, w.weights));
  const image::Image picture = draw(renderer, scene, "", w.method, w.weights);
  if (w.method == LookupMethod::irradiance) {
    // Records differ by place and normal more than probes do. Lists of points hold places, normals and sight
    // of few bits: seen to differ by 4.5 % at a pixel
    EXPECT_TRUE(picture_is(picture, bounds_of(points, truth,
                                              probes.surface  ? 0.06f
                                              : probes.fitted ? 0.05f
                                                              : tile)));
    return;
  }
  // The nearest above the horizon changes from pixel to pixel. Radiance bends more than irradiance: band 1 by
  // its whole, not two thirds
  std::vector<int> chosen;
  for (const PixelPoint& p : points.pixels) {
    int best = -1;
    const auto way = [&](int i) { return probes.probes[i].position - p.point.position; };
    for (int i = 0; i < static_cast<int>(probes.probes.size()); ++i) {
      if (glm::dot(way(i), p.point.normal) > 0 && (best < 0 || glm::length(way(i)) < glm::length(way(best))))
        best = i;
    }
    chosen.push_back(best);
  }
  EXPECT_TRUE(picture_is(picture, bounds_of(points, truth, 1.5f * tile, [&](std::size_t a, std::size_t b) {
                           return chosen[a] != chosen[b];
                         })));
}

INSTANTIATE_TEST_SUITE_P(Lookups, EveryWeight, testing::ValuesIn(all_weights),
                         [](const auto& given) { return given.param.name; });

// Radiance L from everywhere leaves ρ L of every wall, the SPHLs being lights, from in front to grazing.
TEST_F(LookupPixels, OfAConstantFieldSphlsAsLightsLeaveTheSameAtEveryAngle) {
  const vec3 level(0.5f, 1, 2);
  const scene::Scene scene = room(matte(vec3(1)));
  probes::ProbeSet probes = smooth_probes(eight());
  for (probes::Probe& probe : probes.probes) {
    for (probes::GroupLight& light : probe.groups) {
      std::ranges::fill(light.reflected.values, vec3(0));
      light.reflected[0] = std::sqrt(4 * pi) / static_cast<float>(probe.groups.size()) * level;
    }
  }
  for (probes::LightGroup& group : probes.light_groups) group.scale = vec3(1);
  probes::merge_groups(probes);
  const trace::TransportScene source(scene);
  const PixelPoints points(source, pose_of(scene, ""), lookup_size);
  realtime::Renderer renderer(gl(), scene);
  renderer.set_probes(probes);
  const image::Image truth = points.picture([&](const PixelPoint& p) { return p.hit.albedo * level; });
  EXPECT_TRUE(picture_is(draw(renderer, scene, "", LookupMethod::light, WeightMethod::distance),
                         bounds_of(points, truth, tile)));
}

// Cells with fewer probes around them have shorter lists than others. Behind their end stands the origin of
// the world, which is nearer to this floor than any probe.
TEST_F(LookupPixels, WhatStandsBehindTheEndOfAListIsNoProbe) {
  scene::Scene scene;
  scene.materials = {matte(vec3(0.8f))};
  add_mesh(scene, scene::make_quad({-1.5f, -1, 1.5f}, {3, 0, 0}, {0, 0, -3}), 0);
  scene::Node& eye = scene.nodes.emplace_back();
  eye.local.translation = {0.1f, 4, 0.2f};
  eye.local.rotation = glm::quatLookAt(vec3(0, -1, 0), vec3(0, 0, -1));
  scene.cameras.emplace_back().node = static_cast<int>(scene.nodes.size()) - 1;
  scene.cameras.back().yfov = 0.5f;
  scene::validate(scene);
  std::vector<vec3> places;
  for (int i = 0; i < 48; ++i) {
    const auto column = static_cast<float>(i % 8), row = static_cast<float>(i / 8);
    places.push_back(
        {-1.4f + 0.39f * column, 0.9f + 0.1f * static_cast<float>(i * 5 % 7), -1.3f + 0.5f * row});
  }
  const probes::ProbeSet probes = coloured(smooth_probes(places));
  const trace::PathTracer tracer(scene);
  const trace::TransportScene source(scene);
  const PixelPoints points(source, pose_of(scene, ""), lookup_size);
  realtime::Renderer renderer(gl(), scene);
  renderer.set_probes(probes);
  const auto light = lookup(probes, tracer, LookupMethod::light, WeightMethod::distance);
  std::vector<std::size_t> nearest;
  for (const PixelPoint& p : points.pixels) {
    const auto far = [&](const vec3& place) { return glm::distance(place, p.point.position); };
    nearest.push_back(static_cast<std::size_t>(std::ranges::min_element(places, {}, far) - places.begin()));
  }
  PictureBounds bounds = PictureBounds::around(looked_up(points, *light), 1.5f * tile, 3e-4f);
  const std::vector<bool> edges =
      points.edges([&](std::size_t a, std::size_t b) { return nearest[a] != nearest[b]; });
  EXPECT_LT(bounds.widen([&](int x, int y) { return edges[y * lookup_size.width + x]; }), 0.35);
  EXPECT_TRUE(picture_is(draw(renderer, scene, "", LookupMethod::light, WeightMethod::distance), bounds));
}

/// Of radiance in tiles of 30 texels, up to 1.6 π / 30 rad apart: h² / 8 = 0.0035 of l (l + 1) of each band,
/// whose root mean squares behind these lobes are 0.07, 0.09, 0.10, 0.10, together 0.0136 of a mean of 0.7;
/// 0.4 % of rounding.
constexpr float mirrored = 0.03f;

TEST_F(LookupPixels, GlossyWallsMirrorTheProbesByTheirRoughness) {
  // Between the levels of the tiles, not in the middle: each has its share
  for (const float roughness : {0.34f, 0.64f, 0.9f}) {
    scene::Material gloss;
    gloss.specular_roughness = roughness, gloss.ior = 4;  // F0 0.36: the lobe counts
    const scene::Scene scene = room(gloss);
    const trace::PathTracer tracer(scene);
    // All bands, for lobes to differ by, over twice the mean, so that it is hardly ever dark
    probes::ProbeSet probes = made_up_probes(grid());
    for (probes::Probe& probe : probes.probes)
      for (probes::GroupLight& light : probe.groups) light.reflected[0] *= 2;
    probes::merge_groups(probes);
    const trace::TransportScene source(scene);
    const PixelPoints points(source, pose_of(scene, ""), lookup_size);
    realtime::Renderer renderer(gl(), scene);
    renderer.set_probes(probes);
    const auto light = lookup(probes, tracer, LookupMethod::irradiance, WeightMethod::mls);
    EXPECT_TRUE(picture_is(draw(renderer, scene, "", LookupMethod::irradiance, WeightMethod::mls),
                           bounds_of(points, looked_up(points, *light, gloss), mirrored)))
        << roughness;
  }
}

}  // namespace
}  // namespace ssphh::test
