/// Traced pictures and cube maps, pixel by pixel and in colour, against pictures by closed forms and rays of
/// the tests' own: z-tests of every pixel and of squares of them, at one in a thousand for each picture.

#include <gmock/gmock.h>

#include <ssphh/shading/bsdf.h>
#include <ssphh/trace/path_tracer.h>

#include "picture_bounds.h"
#include "stage_lamps.h"

namespace ssphh::test {
namespace {

constexpr PictureSize traced_size{40, 24};
constexpr int fine = 4;  ///< rays of the truth along each side of a pixel
constexpr PictureSize fine_size{fine * traced_size.width, fine* traced_size.height};
constexpr int pictures = 48;

/// Mean of each pixel's rays.
image::Image coarse(const image::Image& picture) {
  image::Image mean(picture.width / fine, picture.height / fine, 3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      mean.set_rgb(x / fine, y / fine,
                   mean.rgb(x / fine, y / fine) + picture.rgb(x, y) / static_cast<float>(fine * fine));
  }
  return mean;
}

/// Independent pictures of the scene by its own camera.
PictureSamples traced(const scene::Scene& scene, const rays::IndirectLight* indirect, int max_depth) {
  const trace::PathTracer tracer(scene);
  trace::RenderParams params;
  params.width = traced_size.width, params.height = traced_size.height;
  params.camera = scene::camera_pose(scene, "");
  if (params.camera.camera.orthographic) params.projection = trace::Projection::orthographic;
  PictureSamples samples;
  for (int i = 0; i < pictures; ++i) {
    params.path = {max_depth, 1, 1, static_cast<std::uint64_t>(i)};
    trace::RenderState state;
    indirect ? tracer.render_with(*indirect, params, state) : tracer.render(params, state);
    samples.add(trace::resolve(state.color, state.passes_done));
  }
  return samples;
}

/// `edge(x, y)` of the fine picture: 16 rays a pixel do not tell what share of it lies on which side. `light`
/// is what a sixteenth of them may miss.
template <class Edge>
void expect_traced(const PictureSamples& samples, const image::Image& fine_truth, double most_edges,
                   const Edge& edge) {
  // Of values that bend within a pixel, 4 x 4 midpoints err by a sixteenth of what its middle does: 0.1 %
  const image::Image truth = coarse(fine_truth);
  PictureBounds bounds = PictureBounds::around(truth, 1e-3f, 1e-5f);
  bounds.variance = samples.variance(), bounds.degrees = samples.degrees();
  const double share = bounds.widen([&](int x, int y) {
    for (int i = 0; i < fine * fine; ++i)
      if (edge(fine * x + i % fine, fine * y + i / fine)) return true;
    return false;
  });
  EXPECT_LT(share, most_edges);
  EXPECT_TRUE(picture_is(samples.mean(), bounds));
}

/// Whether two pixels side by side show other surfaces.
bool other_surface(const PixelPoint& a, const PixelPoint& b) {
  return a.hit.escaped() != b.hit.escaped() || a.hit.albedo != b.hit.albedo ||
         (!on_stage_ball(a.point) && glm::dot(a.point.normal, b.point.normal) < 0.99f);
}

class TracedLamp : public testing::TestWithParam<StageLamp> {};

TEST_P(TracedLamp, LightsEveryPixelAsItsClosedFormSays) {
  for (const bool parallel : {false, true}) {
    scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
    add_stage_lamp(scene, GetParam().light);
    scene.cameras[0].orthographic = parallel, scene.cameras[0].yheight = 3.5f;
    const LampPicture truth(scene, fine_size, GetParam().arriving, lambertian);
    const std::vector<bool> edges = truth.points.edges([&](std::size_t a, std::size_t b) {
      return truth.lit[a] != truth.lit[b] || other_surface(truth.points.pixels[a], truth.points.pixels[b]);
    });
    expect_traced(traced(scene, nullptr, 1), truth.picture, 0.35,
                  [&](int x, int y) { return edges[y * fine_size.width + x]; });
  }
}

INSTANTIATE_TEST_SUITE_P(Lamps, TracedLamp, testing::ValuesIn(lamps_without_extent()),
                         [](const auto& given) { return given.param.name; });

/// Indirect light by formula: linear in place and normal, each colour in its own way; lobes turn with the
/// direction and fade with roughness.
class FormulaLight final : public rays::IndirectLight {
 public:
  vec3 irradiance(const rays::SurfacePoint& at) const override {
    const vec3 &x = at.position, &n = at.normal;
    return vec3(3 + 0.5f * x.x, 2 + 0.3f * x.y, 2 - 0.4f * x.z) + vec3(0.8f * n.x, n.y, 1.2f * n.z);
  }
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override {
    return (vec3(2, 1.5f, 1) + vec3(r.y, r.z, r.x) * (1 - 0.5f * roughness)) * (1 + 0.1f * at.position.x);
  }
  bool follows_mirrors() const override { return false; }
};

TEST(TracedPixels, LookedUpLightIsReflectedByPlaceNormalAndRoughness) {
  scene::Material gloss = matte({0.9f, 0.3f, 0.5f});
  gloss.specular = 0.8f, gloss.specular_roughness = 0.4f, gloss.metallic = 0.3f;
  scene::Scene scene = stage(gloss);
  scene::validate(scene);
  const shading::BsdfParams ball{gloss.base_color * 0.7f,
                                 glm::mix(vec3(0.04f * 0.8f), gloss.base_color, 0.3f), 0, 0.4f};
  const FormulaLight light;
  const trace::TransportScene source(scene);
  const PixelPoints points(source, scene::camera_pose(scene, ""), fine_size);
  const image::Image truth = points.picture([&](const PixelPoint& p) {
    const vec3 n = stage_normal(p.point);
    const rays::SurfacePoint at{p.point.position, n};
    if (!on_stage_ball(p.point)) return p.hit.albedo / pi * light.irradiance(at);
    const vec3 e = shading::directional_albedo({vec3(0), ball.f0, 0, 0.4f}, glm::dot(n, p.wo));
    return ball.diffuse * (vec3(1) - e) / pi * light.irradiance(at) +
           e * light.glossy(at, glm::reflect(-p.wo, n), 0.4f);
  });
  const std::vector<bool> edges = points.edges(
      [&](std::size_t a, std::size_t b) { return other_surface(points.pixels[a], points.pixels[b]); });
  expect_traced(traced(scene, &light, 2), truth, 0.25,
                [&](int x, int y) { return edges[y * fine_size.width + x]; });
}

/// Right, down and forward of each face of a cube map, as docs/conventions.md has them.
const std::array<std::array<vec3, 3>, 6> faces = {{{vec3(0, 0, -1), vec3(0, -1, 0), vec3(1, 0, 0)},
                                                   {vec3(0, 0, 1), vec3(0, -1, 0), vec3(-1, 0, 0)},
                                                   {vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, 1, 0)},
                                                   {vec3(1, 0, 0), vec3(0, 0, -1), vec3(0, -1, 0)},
                                                   {vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, 1)},
                                                   {vec3(-1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)}}};

TEST(TracedPixels, ProbesSeeEveryTexelOfTheirSixFacesInItsPlace) {
  // A sky whose colour is linear in the direction, so that its image's interpolation hardly matters, and a
  // lamp's light on the stage around
  scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
  const StageLamp lamp = lamps_without_extent()[0];
  add_stage_lamp(scene, lamp.light);
  scene.environment.emplace().equirect = image::Image(128, 64, 3);
  const auto sky = [](const vec3& d) { return vec3(2) + vec3(d.x, d.y, d.z); };
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      // u = 1/2 + atan2(z, x) / 2 pi, theta = pi v from +y
      const float phi = 2 * pi * ((static_cast<float>(x) + 0.5f) / 128 - 0.5f),
                  theta = pi * (static_cast<float>(y) + 0.5f) / 64;
      scene.environment->equirect.set_rgb(
          x, y, sky({std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)}));
    }
  }
  const vec3 eye(0.4f, 1.7f, 1.3f);
  constexpr int n = 12;
  const trace::PathTracer tracer(scene);
  std::array<PictureSamples, 6> emitted;
  for (int i = 0; i < 32; ++i) {
    const auto groups = tracer.incident_radiance({eye, n, {0, 1, 1, static_cast<std::uint64_t>(i)}}, {});
    for (std::size_t f = 0; f < 6; ++f) emitted[f].add(groups.back().emitted.faces[f]);
  }
  const trace::TransportScene source(scene);
  const rays::PosedWorld surfaces(source, 0);
  for (std::size_t f = 0; f < 6; ++f) {
    const auto& [right, down, forward] = faces[f];
    image::Image truth(n * fine, n * fine, 3);
    for (int y = 0; y < n * fine; ++y) {
      for (int x = 0; x < n * fine; ++x) {
        const vec2 place = 2.0f * (vec2(x, y) + 0.5f) / static_cast<float>(n * fine) - 1.0f;
        const vec3 d = glm::normalize(forward + place.x * right + place.y * down);
        truth.set_rgb(x, y, surfaces.visible(eye, eye + 100.0f * d) ? sky(d) : vec3(0));
      }
    }
    SCOPED_TRACE(testing::Message() << "face " << f);
    PictureBounds bounds = PictureBounds::around(coarse(truth), 2e-3f, 1e-5f);
    bounds.variance = emitted[f].variance(), bounds.degrees = emitted[f].degrees();
    // Edges pass where some of the texel's rays meet a surface and others, or its neighbours', do not
    const double edges = bounds.widen([&](int x, int y) {
      int open = 0, all = 0;
      for (int sy = std::max(fine * y - 1, 0); sy < std::min(fine * y + fine + 1, n * fine); ++sy) {
        for (int sx = std::max(fine * x - 1, 0); sx < std::min(fine * x + fine + 1, n * fine); ++sx)
          ++all, open += truth.at(sx, sy)[0] > 0;
      }
      return open > 0 && open < all;
    });
    EXPECT_LT(edges, 0.3);
    EXPECT_TRUE(picture_is(emitted[f].mean(), bounds));
  }
}

}  // namespace
}  // namespace ssphh::test
