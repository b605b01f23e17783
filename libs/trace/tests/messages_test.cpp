/// What is meant where nobody says anything, and what is said of what cannot be.

#include <limits>

#include <gtest/gtest.h>

#include <ssphh/core/log.h>
#include <ssphh/trace/transport_scene.h>

#include "camera.h"
#include "error_message.h"
#include "hand_made.h"
#include "surface_gap.h"
#include "tracer_data.h"
#include "transport_data.h"

namespace ssphh::test {
namespace {

constexpr float endless = std::numeric_limits<float>::infinity();

TEST(TraceDefaults, AreNamed) {
  const trace::Tile tile;
  EXPECT_EQ(tile.x, 0);
  EXPECT_EQ(tile.y, 0);
  EXPECT_EQ(tile.width, 0);
  EXPECT_EQ(tile.height, 0);
  const trace::RenderParams params{};
  EXPECT_EQ(params.width, 1280);
  EXPECT_EQ(params.height, 720);
  EXPECT_EQ(params.projection, trace::Projection::pinhole);
  EXPECT_FALSE(params.per_group);
  EXPECT_EQ(trace::tile_of(params), (trace::Tile{0, 0, 1280, 720}));
  const trace::RenderState state{};
  EXPECT_EQ(state.passes_done, 0);
  EXPECT_EQ(state.paths + state.rays, 0u);
  const trace::TransportOptions transport;
  EXPECT_EQ(transport.light_samples, 16);
  EXPECT_EQ(transport.environment_samples, 64);
  EXPECT_EQ(transport.surface_tolerance, 5e-5f);
  EXPECT_EQ(trace::default_surface_tolerance, 5e-5f);
  const trace::PathOptions path;
  EXPECT_EQ(path.max_depth, 3);
  EXPECT_TRUE(path.roulette);
  EXPECT_EQ(path.strategy, trace::Strategy::mis);
  EXPECT_EQ(trace::SceneGeometry::default_flatten_limit, 4'000'000u);
  const trace::RayTask task;
  EXPECT_EQ(task.rays + task.invalid, 0u);
  EXPECT_EQ(task.record, nullptr);
  const trace::Ray ray{vec3(0), vec3(1)};
  EXPECT_EQ(ray.t_max, endless);
  const trace::PathVertex vertex{vec3(1)};
  EXPECT_EQ(vertex.normal, vec3(0));
  EXPECT_EQ(vertex.bsdf_pdf, 0);
  EXPECT_EQ(trace::SharedCount().total(), 0u);
}

// Multiples of half an ulp of the coordinate.
TEST(RayStarts, KeepAwayFromTheirSurfaceByRoundingErrors) {
  EXPECT_EQ(trace::position_error(3), 16 * 3 * 0x1p-24f);
  EXPECT_EQ(trace::max_abs_component(vec3(1, -5, 3)), 5);
  EXPECT_FLOAT_EQ(trace::shadow_distance(vec3(0), 7), 7 * 0.9999f);
  EXPECT_FLOAT_EQ(trace::shadow_distance(vec3(1, -3000, 2), 7),
                  7 * 0.9999f - 2 * trace::position_error(3000));
  EXPECT_EQ(trace::scene_size({}), 0);
  EXPECT_EQ(trace::scene_size({vec3(1, -9, 2), vec3(5, -5, 2)}), 7 + std::sqrt(8.0f));
  const vec3 up(0, 1, 0);
  EXPECT_EQ(trace::above_surface(vec3(0), up, 0.25f), vec3(0, 0.25f, 0));
  EXPECT_EQ(trace::above_surface(vec3(0x1p20f, 0, 0), up, 0.25f), vec3(0x1p20f, 1, 0));

  // From the start to the place that was sampled from the point itself.
  const shading::LightSample lamp{vec3(0, 0.6f, 0.8f), 10, vec3(1), 1, false, 0};
  const trace::Ray near = trace::shadow_ray(vec3(0, 0.5f, 0), vec3(0), lamp);
  EXPECT_EQ(near.origin, vec3(0, 0.5f, 0));
  EXPECT_LT(glm::distance(near.direction, vec3(0, 5.5f, 8)), 1e-6f);
  EXPECT_FLOAT_EQ(near.t_max,
                  trace::shadow_distance(near.origin, std::hypot(5.5f, 8.0f)) / std::hypot(5.5f, 8.0f));
  const shading::LightSample sun{vec3(0, 0.6f, 0.8f), endless, vec3(1), 1, false, 0};
  const trace::Ray far = trace::shadow_ray(vec3(0, 0.5f, 0), vec3(0), sun);
  EXPECT_EQ(far.direction, sun.wi);
  EXPECT_EQ(far.t_max, endless);
}

// A sheet across the way of two metres, which is shortened at either end by a ten thousandth of it.
TEST(RayStarts, VisibilityLeavesOutATenThousandthAtEitherEnd) {
  scene::Scene scene;
  add_object(scene, scene::make_quad(vec3(0, -1, -1), vec3(0, 2, 0), vec3(0, 0, 2)), lambertian(vec3(0.5f)));
  const trace::PathTracer tracer(scene);
  for (const float side : {1.0f, -1.0f}) {
    const auto seen = [&](float before) {
      return tracer.visible(side * vec3(-before, 0, 0), side * vec3(2 - before, 0, 0));
    };
    EXPECT_TRUE(seen(1.9e-4f));
    EXPECT_FALSE(seen(2.15e-4f)) << "with 4e-6 for rounding";
  }
}

TEST(TraceMessages, OfCheckpointsAndTiles) {
  const auto said_of_tile = [](const trace::Tile& tile, bool paste_it) {
    trace::RenderParams params = view_down(vec3(0), 1, 8);
    params.height = 6;
    params.path = {0, 1, 1, 1};
    const scene::Scene scene;
    return message_of([&] {
      trace::RenderState whole = trace::empty_state(params, 0), part;
      if (paste_it) {
        trace::RenderParams of_part = params;
        of_part.tile = {0, 0, tile.width, tile.height};
        trace::paste(whole, trace::empty_state(of_part, 0), tile);
      } else {
        params.tile = tile;
        trace::PathTracer(scene).render(params, part);
      }
    });
  };
  for (const trace::Tile& tile : {trace::Tile{7, 5, 1, 1}, {0, 0, 8, 6}, {5, 0, 3, 6}, {0, 4, 8, 2}}) {
    EXPECT_EQ(said_of_tile(tile, false), "no error");
    EXPECT_EQ(said_of_tile(tile, true), "no error");
  }
  for (const trace::Tile& tile :
       {trace::Tile{-1, 0, 1, 1}, {0, -1, 1, 1}, {8, 0, 1, 1}, {0, 6, 1, 1}, {6, 0, 3, 1}, {0, 5, 1, 2}}) {
    EXPECT_EQ(said_of_tile(tile, false), "render tile: it must lie inside the picture");
    EXPECT_EQ(said_of_tile(tile, true), "tile: it does not lie inside the picture");
  }
  EXPECT_EQ(said_of_tile({0, 0, 1, 0}, false), "render tile: it must lie inside the picture");
  EXPECT_EQ(said_of_tile({0, 0, -1, 1}, false), "render tile: it must lie inside the picture");

  trace::RenderParams params = view_down(vec3(0), 1, 8);
  params.per_group = true;
  trace::RenderState whole = trace::empty_state(params, 2), other = trace::empty_state(params, 1);
  EXPECT_EQ(message_of([&] {
              trace::paste(whole, other, {0, 0, 8, 8});
            }),
            "tile: the picture and its part keep different images");
  const std::string size = "tile: an image of the part is not of its size";
  EXPECT_EQ(message_of([&] { trace::paste(whole, whole, {0, 0, 8, 7}); }), size);
  EXPECT_EQ(message_of([&] { trace::paste(whole, whole, {0, 0, 7, 8}); }), size);
  trace::RenderState coloured = whole;
  coloured.depth = image::Image(8, 8, 3);
  EXPECT_EQ(message_of([&] { trace::paste(whole, coloured, {0, 0, 8, 8}); }), size);
  EXPECT_EQ(message_of([&] { trace::save_state(coloured, "/nowhere"); }),
            "render state: its images differ in size");
}

// Any image of the state that does not fit.
TEST(TraceMessages, OfStatesThatBelongToAnotherRender) {
  scene::Scene scene;
  add_light(scene, scene::LightType::point, 1, vec3(0));
  const trace::PathTracer tracer(scene);
  trace::RenderParams params = view_down(vec3(0), 1, 4);
  params.path = {0, 1, 1, 1}, params.per_group = true;
  using State = trace::RenderState;
  const std::vector<image::Image State::*> images = {&State::color,   &State::direct, &State::indirect,
                                                     &State::albedo,  &State::normal, &State::depth,
                                                     &State::coverage};
  const std::string other = "render state: it belongs to a render of another size or other light groups";
  const auto said = [&](State& state) { return message_of([&] { tracer.render(params, state); }); };
  State good = trace::empty_state(params, 1);
  EXPECT_EQ(said(good), "no error");
  for (const auto member : images) {
    const int channels = (good.*member).channels;
    for (const image::Image& wrong :
         {image::Image(4, 5, channels), image::Image(5, 4, channels), image::Image(4, 4, 4 - channels)}) {
      State state = trace::empty_state(params, 1);
      state.*member = wrong;
      EXPECT_EQ(said(state), other);
    }
  }
  for (const std::size_t groups : {0, 2}) {
    State state = trace::empty_state(params, groups);
    EXPECT_EQ(said(state), other);
  }
  State state = trace::empty_state(params, 1);
  state.groups[0] = image::Image(4, 5);
  EXPECT_EQ(said(state), other);
}

TEST(TraceMessages, OfPathsSizesAndTimes) {
  const scene::Scene scene;
  const trace::PathTracer tracer(scene);
  const auto said = [&](const rays::PathParams& path) {
    return message_of([&] { trace::check_path_params(path); });
  };
  EXPECT_EQ(said({0, 0, 1, 0}), "no error");
  EXPECT_EQ(said({-1, 1, 1, 0}), "max depth: it must not be negative");
  EXPECT_EQ(said({1, -1, 1, 0}), "passes: their number must not be negative");
  EXPECT_EQ(said({1, 1, 0, 0}), "spp: at least one sample is needed");
  EXPECT_EQ(said({1, 65537, 65535, 0}), "no error");
  EXPECT_EQ(said({1, 65536, 65536, 0}), "passes: more than 2^32 samples per pixel");
  EXPECT_EQ(message_of([&] { trace::check_image_memory("here", std::uint64_t{1} << 31, 2); }),
            "here: the images would need more than 8 GiB (ask for fewer pixels or light groups)");
  EXPECT_EQ(message_of([&] { trace::PathTracer(scene, NAN); }),
            "time: it must be a finite number of seconds");
  const auto cube = [&](const vec3& position, int size) {
    return message_of([&] { tracer.incident_radiance({position, size, {0, 0, 1, 0}}, {}); });
  };
  EXPECT_EQ(cube(vec3(0), 1), "no error");
  EXPECT_EQ(cube(vec3(0), 0), "face size: it must lie in 1..8192");
  EXPECT_EQ(cube(vec3(0), 8193), "face size: it must lie in 1..8192");
  EXPECT_EQ(cube(vec3(0, 0, endless), 1), "probe position: it must be finite");
  const auto ball = [&](const vec3& center, float radius) {
    const std::vector<rays::GhostSphere> ghosts = {{center, radius}};
    return message_of([&] { tracer.ghost_radiance({vec3(0), 1, {0, 1, 1, 0}}, ghosts, nullptr, {}); });
  };
  const std::string ghost = "ghost sphere: its centre must be finite and its radius a length";
  EXPECT_EQ(ball(vec3(1), 0), "no error");
  EXPECT_EQ(ball(vec3(NAN), 1), ghost);
  EXPECT_EQ(ball(vec3(1), -1), ghost);
  EXPECT_EQ(ball(vec3(1), endless), ghost);
  trace::RenderParams params = view_down(vec3(0), 1, 8);
  trace::RenderState state;
  for (const auto& [width, height] : {std::pair{0, 8}, {8, 0}, {-1, -1}}) {
    params.width = width, params.height = height;
    EXPECT_EQ(message_of([&] { tracer.render(params, state); }),
              "render size: width and height must be positive");
  }
}

TEST(TraceMessages, OfCameras) {
  trace::RenderParams params = view_down(vec3(0), 1, 8);
  params.camera.camera.name = "c";
  const auto said = [](const trace::RenderParams& p) { return message_of([&] { trace::CameraRays{p}; }); };
  EXPECT_EQ(said(params), "no error");
  for (const float height : {0.0f, -1.0f, endless}) {
    trace::RenderParams p = params;
    p.camera.camera.yheight = height;
    EXPECT_EQ(said(p), "camera \"c\": the height of an orthographic view must be positive");
  }
  for (const float fov : {0.0f, pi, -1.0f}) {
    trace::RenderParams p = params;
    p.projection = trace::Projection::pinhole;
    p.camera.camera.yfov = fov;
    EXPECT_EQ(said(p), "camera \"c\": the vertical field of view must lie between 0 and 180 degrees");
  }
  for (int column = 0; column < 4; ++column) {
    trace::RenderParams p = params;
    p.camera.world[column] = vec4(column == 3 ? NAN : 0.0f);
    for (const auto projection : {trace::Projection::orthographic, trace::Projection::pinhole}) {
      p.projection = projection;
      EXPECT_EQ(said(p), "camera \"c\": its pose is not finite or has no extent");
    }
    p.projection = trace::Projection::equirect;
    EXPECT_EQ(said(p) == "no error", column < 3) << "the whole sphere has no axes";
  }
  params.projection = trace::Projection::cube_strip;
  EXPECT_EQ(said(params), "render size: a cube strip is six times as wide as it is high");
  params.width = 48;
  EXPECT_EQ(said(params), "no error");
}

TEST(TraceMessages, OfTransport) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_light(scene, scene::LightType::point, 1, vec3(0, 1, 0));
  const trace::TransportScene source(scene);
  const auto options = [&](const trace::TransportOptions& o) {
    return message_of([&] { trace::TransportScene(scene, o); });
  };
  EXPECT_EQ(options({1, 1, 0}), "no error");
  EXPECT_EQ(options({0, 1, 0}), "light samples: at least one is needed");
  EXPECT_EQ(options({1, 0, 0}), "environment samples: at least one is needed");
  EXPECT_EQ(options({1, 1, 0.999f}), "no error");
  for (const float tolerance : {-1e-6f, 1.0f, static_cast<float>(NAN)})
    EXPECT_EQ(options({1, 1, tolerance}), "surface tolerance: it must lie in 0..1");
  for (const int part : {-1, 1})
    EXPECT_EQ(message_of([&] { source.part_bounds(part); }), "part: there is none of that index");
  for (const int light : {-1, 1})
    EXPECT_EQ(message_of([&] { source.light_group_of(light); }), "light: there is none of that index");
  EXPECT_EQ(message_of([&] { source.sample_part(0, -1); }),
            "points per square metre: they must not be negative");
  EXPECT_EQ(message_of([&] { source.sample_part(1, 1); }), "part: there is none of that index");
  const std::vector<rays::RayQuery> rays(2);
  std::vector<rays::RayHit> hits(1);
  std::vector<std::uint8_t> blocked(3);
  EXPECT_EQ(message_of([&] { source.intersect(0, rays, hits); }), "rays: there is not one hit for each");
  EXPECT_EQ(message_of([&] { source.occluded(0, rays, blocked); }), "rays: there is not one answer for each");
  std::vector<scene::LightState> states = source.lights(0);
  std::vector<mat4> poses(1, mat4(1));
  const auto light = source.direct_light(states, poses);
  const std::vector<rays::SurfacePoint> points(2);
  std::vector<vec3> out(1);
  EXPECT_EQ(message_of([&] { light->irradiance(0, points, out); }),
            "direct light: there is not one value for each point");
  for (const int group : {-1, 1})
    EXPECT_EQ(message_of([&] { light->flux(group); }), "light group: there is none of that index");
  poses.push_back(mat4(1));
  EXPECT_EQ(message_of([&] { source.direct_light(states, poses); }),
            "direct light: there is not one pose for each part");
  states.clear();
  EXPECT_EQ(message_of([&] { source.direct_light(states, poses); }),
            "direct light: there is not one state for each light");
}

TEST(TraceMessages, OfLightThatWasNoNumber) {
  std::vector<std::string> warnings;
  set_log_sink([&](LogLevel, const std::string& message) { warnings.push_back(message); });
  trace::report_invalid(0);
  trace::report_invalid(7);
  set_log_sink({});
  EXPECT_EQ(warnings,
            (std::vector<std::string>{"path tracer: 7 contributions were not finite and were left out"}));
}

}  // namespace
}  // namespace ssphh::test
