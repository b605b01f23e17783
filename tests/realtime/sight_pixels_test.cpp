/// Light looked up where walls hide probes: every pixel of what OpenGL draws against the CPU's lookups, in
/// colour. What a texel of a probe's map decides may be either way; all else is as the CPU's rays see it.

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>

#include "doubtful_sight.h"
#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"

namespace ssphh::test {
namespace {

using probes::WeightMethod;

constexpr PictureSize sight_size{80, 45};

/// As tests/realtime/lookup_pixels_test.cpp derives it: interpolation in tiles, 0.55 % of the mean, and
/// colours of few bits. Where weights of both signs leave next to nothing, the same of a mean of 0.1 remains.
constexpr float sight_tile = 0.01f, least = 5e-4f;

class SightPixels : public WithGl {
 protected:
  /// Matte scenes, whose indirect light is ρ E / π.
  void compare(const scene::Scene& scene, const std::string& camera, const probes::ProbeSet& probes,
               WeightMethod method) {
    const trace::PathTracer tracer(scene);
    const trace::TransportScene source(scene);
    scene::CameraPose pose = scene::camera_pose(scene, camera);
    pose.world[3] += vec4(0.013f, 0.003f, 0, 0);  // no edge passes through the middle of pixels
    const PixelPoints points(source, pose, sight_size);

    std::vector<vec3> places;
    for (const probes::Probe& probe : probes.probes) places.push_back(probe.position);
    probes::LookupParams params;
    params.weights.method = method;
    DoubtfulSight sight(tracer);
    const probes::IrradianceLookup lookup(probes, probes::make_weights(places, sight.sees(), params.weights),
                                          params);

    const image::Image black(sight_size.width, sight_size.height, 3);
    PictureBounds bounds{black, black, {}, {}};
    int doubtful = 0;
    for (int y = 0; y < sight_size.height; ++y) {
      for (int x = 0; x < sight_size.width; ++x) {
        const PixelPoint& p = points.at(x, y);
        if (p.hit.escaped()) continue;
        vec3 low(INFINITY), high(-INFINITY);
        const int doubts = sight.for_each_choice(p.point, [&] {
          const vec3 value = p.hit.albedo / pi * lookup.irradiance(p.point);
          low = glm::min(low, (1 - sight_tile) * value - least),
          high = glm::max(high, (1 + sight_tile) * value + least);
        });
        EXPECT_LE(doubts, DoubtfulSight::most);
        doubtful += doubts > 0;
        bounds.low.set_rgb(x, y, low), bounds.high.set_rgb(x, y, high);
      }
    }
    EXPECT_LT(doubtful, 0.2 * sight_size.width * sight_size.height);
    realtime::Renderer renderer(gl(), scene);
    renderer.set_probes(probes);
    realtime::FrameSettings settings;
    settings.view = realtime::View::indirect;
    settings.weights = method;
    renderer.draw(pose, settings, {.width = sight_size.width, .height = sight_size.height});
    EXPECT_TRUE(picture_is(renderer.read_back(), bounds));
  }
};

struct Case {
  const char* scene;
  const char* camera;
  WeightMethod method;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.scene << " " << c.camera << " " << name_of(c.method);
}

class SightOfProbes : public SightPixels, public testing::WithParamInterface<Case> {};

TEST_P(SightOfProbes, LightsEveryPixelAsTheCpuDoes) {
  const Case& c = GetParam();
  const scene::Scene scene = scene::make_builtin(c.scene);
  compare(scene, c.camera, smooth_probes(probe_places(scene)), c.method);
}

INSTANTIATE_TEST_SUITE_P(Builtin, SightOfProbes,
                         testing::Values(Case{"two-rooms", "room-a", WeightMethod::mls},
                                         Case{"two-rooms", "room-b", WeightMethod::mls},
                                         Case{"two-rooms", "room-a", WeightMethod::distance},
                                         Case{"two-rooms", "room-b", WeightMethod::trilinear},
                                         Case{"cornell", "", WeightMethod::mls},
                                         Case{"cornell", "", WeightMethod::distance}));

/// Nothing may come through walls from probes outside of them, though some stand at the height of a surface:
/// seen along it, the place in the middle of a texel is as near to the probe as one likes.
TEST_F(SightPixels, OfProbesBehindWallsLetsNoneIn) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  const scene::Bounds room = scene::world_bounds(scene, scene::world_matrices(scene, 0));
  std::vector<vec3> outside;
  for (const float u : {-0.3f, 1.3f}) {
    outside.push_back(glm::mix(room.min, room.max, vec3(u, 0.4f, 0.6f)));
    outside.push_back(glm::mix(room.min, room.max, vec3(0.6f, u, 0.4f)));
    outside.push_back(glm::mix(room.min, room.max, vec3(0.4f, 0.6f, u)));
  }
  compare(scene, "", smooth_probes(outside), WeightMethod::distance);
}

}  // namespace
}  // namespace ssphh::test
