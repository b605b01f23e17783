#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/random.h>
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/thing_alone.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/quadrature.h>
#include <ssphh/shading/lights.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/thing_emission.h>

namespace ssphh::trace {
namespace {

using glm::dmat3;
using glm::dvec3;

/// Directions for lamps without extent, whose light may end at a sharp cone: many cost little.
constexpr int directions_of_lamps = 64;

/// What surfaces send out has kinks at their horizons: directions for more than twice the degree.
constexpr int directions_beyond = 14;

/// Coefficients, and where the light comes from: the point nearest to all lines of sight, weighted by light.
struct Sum {
  explicit Sum(int degree) : values(static_cast<std::size_t>(sh::coefficient_count(degree)), dvec3(0)) {}

  void add(int degree, const vec3& direction, double weight, const vec3& intensity) {
    std::vector<double> basis(values.size());
    sh::eval_basis(degree, dvec3(direction), basis);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += weight * basis[k] * dvec3(intensity);
  }
  /// Light that leaves along the line through `place`.
  void add_line(const vec3& direction, const vec3& place, double weight) {
    const dvec3 d(direction), p(place);
    matrix += weight * (dmat3(1) - glm::outerProduct(d, d));
    moment += weight * (p - glm::dot(p, d) * d);
  }

  std::vector<dvec3> values;
  dmat3 matrix{0};
  dvec3 moment{0};
};

struct Ball {
  vec3 center{0};
  float radius = 0;
};

/// Around the vertices and lamps; a lamp alone gets the radius of an SPHL.
Ball ball_around(const scene::Scene& thing, const std::vector<mat4>& world,
                 const std::optional<vec3>& center) {
  scene::Bounds bounds = scene::world_bounds(thing, world);
  std::vector<vec3> lamps;
  for (const scene::Light& light : thing.lights) {
    lamps.emplace_back(world[light.node][3]);
    const float reach = scene::lamp_reach(light);
    bounds.add(lamps.back() - reach), bounds.add(lamps.back() + reach);
  }
  if (bounds.empty()) return {};
  Ball ball{center.value_or(bounds.center()), 0};
  const auto reach = [&](const vec3& p, float r) {
    ball.radius = std::max(ball.radius, glm::distance(p, ball.center) + r);
  };
  for (const scene::Instance& instance : thing.instances) {
    const mat4& matrix = world[instance.node];
    for (const vec3& p : thing.meshes[instance.mesh].positions) reach(vec3(matrix * vec4(p, 1)), 0);
  }
  for (std::size_t i = 0; i < lamps.size(); ++i) reach(lamps[i], scene::lamp_reach(thing.lights[i]));
  return ball;
}

/// Surfaces and lamps with an extent: parallel views.
void add_views(const PathTracer& tracer, const Ball& ball, const mat3& axes, const ThingEmissionParams& p,
               std::uint64_t& paths, Sum& sum, const Control& control) {
  const sh::SphereQuadrature rule = sh::sphere_quadrature(2 * p.degree + directions_beyond);
  RenderParams view;
  view.width = view.height = p.image_size;
  view.projection = Projection::orthographic;
  view.camera.camera.orthographic = true;
  view.camera.camera.yheight = 2.02f * ball.radius;
  view.path = p.path;
  const float side = view.camera.camera.yheight, area = side * side;
  ProgressStage stage(control, "views of the thing", rule.directions.size(), "views");
  for (std::size_t q = 0; q < rule.directions.size(); ++q) {
    control.check();
    const vec3 local(rule.directions[q]), out = glm::normalize(axes * local);
    const Frame frame = Frame::around(out);
    view.camera.world = mat4(vec4(frame.x, 0), vec4(frame.y, 0), vec4(frame.z, 0),
                             vec4(ball.center + 2 * ball.radius * out, 1));
    view.path.seed = hash_combine(p.path.seed, q);
    RenderState state;
    tracer.render(view, state, {nullptr, control.cancel});
    const image::Image picture = resolve(state.color, state.passes_done);
    paths += state.paths;
    vec3 mean(0);
    const float pixel = 1 / static_cast<float>(p.image_size * p.image_size);
    for (int y = 0; y < p.image_size; ++y) {
      for (int x = 0; x < p.image_size; ++x) {
        const vec3 radiance = picture.rgb(x, y) * pixel;
        if (radiance == vec3(0)) continue;
        mean += radiance;
        const float right = ((static_cast<float>(x) + 0.5f) / static_cast<float>(p.image_size) - 0.5f) * side,
                    up = (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(p.image_size)) * side;
        sum.add_line(out, ball.center + right * frame.x + up * frame.y,
                     rule.weights[q] * static_cast<double>(area * luminance(radiance)));
      }
    }
    sum.add(p.degree, local, rule.weights[q], area * mean);
    stage.advance(1);
  }
}

/// Lamps without extent, where they are seen from outside of the ball.
void add_lamps(const PathTracer& tracer, const shading::LightSet& lights, const Ball& ball, const mat3& axes,
               int degree, Sum& sum) {
  const sh::SphereQuadrature rule = sh::sphere_quadrature(directions_of_lamps);
  for (int i = 0; i < lights.emitter_count(); ++i) {
    const shading::Emitter emitter = lights.emitter(i);
    if (!emitter.delta() || emitter.distant()) continue;
    const vec3 place = emitter.extent.center();
    const float own = 0.5f * max_component(emitter.extent.max - emitter.extent.min);
    for (std::size_t q = 0; q < rule.directions.size(); ++q) {
      const vec3 local(rule.directions[q]), out = glm::normalize(axes * local);
      const float distance = std::max(4 * ball.radius + 2 * own, 1.0f);
      const auto sample = lights.sample_emitter(i, place + distance * out, vec2(0.5f));
      if (!sample || !tracer.visible(place + own * out, place + distance * out)) continue;
      const vec3 intensity = sample->radiance * (distance * distance);
      sum.add(degree, local, rule.weights[q], intensity);
      sum.add_line(out, place, rule.weights[q] * static_cast<double>(luminance(intensity)));
    }
  }
}

}  // namespace

ThingEmission thing_emission(const scene::Scene& scene, int node, float time,
                             const ThingEmissionParams& params, const Control& control) {
  constexpr const char* where = "emission of a thing";
  sh::require_degree(params.degree, where);
  require(params.image_size >= 1 && params.image_size <= 4096, where, "views have 1 to 4096 pixels a side");
  require(node >= 0 && static_cast<std::size_t>(node) < scene.nodes.size(), where, "there is no such node");
  scene::Scene thing = scene::thing_alone(scene, node);
  for (scene::Light& light : thing.lights) light.range = 0;  // seen from far away
  const std::vector<mat4> world = scene::world_matrices(thing, time);
  const mat4& placed = world[node];
  const mat3 axes = scene::emission_axes(placed);
  const Ball ball = ball_around(thing, world, std::nullopt);
  const std::string name = fmt::format("node \"{}\"", scene.nodes[node].name);
  if (!(ball.radius > 0) && thing.lights.empty())
    throw Error(name, "nothing stands there that could send out light");

  const PathTracer tracer(thing, time);
  const shading::LightSet lights(thing, world, time);
  Sum sum(params.degree);
  ThingEmission result;
  if (ball.radius > 0) add_views(tracer, ball, axes, params, result.paths, sum, control);
  add_lamps(tracer, lights, ball, axes, params.degree, sum);
  result.intensity = sh::IntensitySh(params.degree);
  for (std::size_t k = 0; k < sum.values.size(); ++k) result.intensity.values[k] = vec3(sum.values[k]);
  if (!(max_component(result.intensity.values[0]) > 0))
    throw Error(name, "it sends out no light of its own",
                "lamps and glowing meshes at the node or below it do");
  const vec3 center(glm::inverse(sum.matrix) * sum.moment);
  constexpr float of_a_lamp_alone = 0.1f;
  result.radius = std::max(ball_around(thing, world, center).radius, ball.radius > 0 ? 0 : of_a_lamp_alone);
  result.center = vec3(glm::inverse(placed) * vec4(center, 1));
  return result;
}

std::vector<std::string> buried_lamps(const scene::Scene& scene, const rays::RadianceSource& source,
                                      float time) {
  std::vector<std::string> names;
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  for (const scene::Light& light : scene.lights) {
    if (light.type != scene::LightType::sphl) continue;
    if (source.backface_fraction(vec3(world[light.node][3])) > 0.5f) names.push_back(light.name);
  }
  return names;
}

}  // namespace ssphh::trace
