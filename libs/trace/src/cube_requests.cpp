/// Cube maps of the light that arrives at a point: GEN and VIZ.

#include <ssphh/core/parallel.h>
#include <ssphh/core/sphere.h>

#include "ghost_emitters.h"
#include "texel_sampler.h"
#include "tracer_data.h"

namespace ssphh::trace {
namespace {

void check_request(const rays::CubeRequest& request, std::size_t maps) {
  if (request.face_size < 1 || request.face_size > 8192) throw Error("face size", "it must lie in 1..8192");
  if (!is_finite(request.position)) throw Error("probe position", "it must be finite");
  check_path_params(request.path);
  const auto n = static_cast<std::uint64_t>(request.face_size);
  check_image_memory("cube maps", 6 * n * n, 3 * std::max<std::uint64_t>(1, maps));
}

/// Sums per group (light group or ghost ball) of one texel in one pass. With `split`, the light of depth 0 is
/// kept apart: group g's is sum g, and what surfaces reflect of it sum groups + g.
class TexelSums {
 public:
  TexelSums(std::size_t groups, bool split, RayTask& task)
      : sums_(split ? 2 * groups : groups), reflected_offset_(split ? groups : 0), task_(task) {}

  void clear() { std::ranges::fill(sums_, vec3(0)); }
  void add(int depth, int group, const vec3& value, const vec3& emission) {
    if (!is_finite(value)) {
      ++task_.invalid;
      return;
    }
    if (group < 0) return;
    sums_[static_cast<std::size_t>(group) + (depth > 0 ? reflected_offset_ : 0)] += value;
    if (sink) (*sink)(chunk, {group, direction, emission, value * sink_scale});
  }
  void first_hit(const shading::Surface&, const vec3&, const Ray&, const Hit&) {}
  const vec3& sum(std::size_t index) const { return sums_[index]; }

  // For a sink: the texel's solid angle per sample, and the direction of the sample under way.
  const rays::RadianceSource::GhostSink* sink = nullptr;
  int chunk = 0;
  float sink_scale = 0;
  vec3 direction{0};

 private:
  std::vector<vec3> sums_;
  std::size_t reflected_offset_;
  RayTask& task_;
};

/// Traces all samples of all texels in rows [begin, end) of the six faces, counted through, and adds their
/// means to `maps`.
template <class Emitters>
void trace_texel_rows(const TracerData& data, const Emitters& emitters, const rays::CubeRequest& request,
                      std::size_t begin, std::size_t end, TexelSums& sums, RayTask& task,
                      std::vector<image::CubeMap>& maps, ProgressStage& stage, const Control& control) {
  const auto size = static_cast<std::size_t>(request.face_size);
  const rays::PathParams& path = request.path;
  PathOptions options{.max_depth = path.max_depth, .paths = request.paths};
  if constexpr (std::is_same_v<Emitters, SceneEmitters>) options.panes = data.panes();
  const float mean_scale = 1 / (static_cast<float>(path.spp) * static_cast<float>(path.passes));
  for (std::size_t row = begin; row < end; ++row) {
    control.check();
    const int face = static_cast<int>(row / size), y = static_cast<int>(row % size);
    for (int x = 0; x < request.face_size; ++x) {
      const TexelSampler texel(face, x, y, request.face_size);
      sums.sink_scale = static_cast<float>(texel.solid_angle()) * mean_scale;
      PathSampler sampler{pixel_seed(path.seed, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                     static_cast<std::uint32_t>(face)),
                          0};
      for (int pass = 0; pass < path.passes; ++pass) {
        sums.clear();
        for (int s = 0; s < path.spp; ++s) {
          const Ray ray{request.position, texel.direction(sampler.camera().next2())};
          sums.direction = ray.direction;
          trace_path(data.geometry, emitters, ray, sampler, options, task, sums);
          ++sampler.index;
        }
        for (std::size_t g = 0; g < maps.size(); ++g) {
          image::Image& image = maps[g].faces[face];
          image.set_rgb(x, y, image.rgb(x, y) + sums.sum(g) * mean_scale);
        }
      }
    }
    stage.advance(size * static_cast<std::size_t>(path.spp) * static_cast<std::size_t>(path.passes));
  }
}

std::uint64_t path_count(const rays::CubeRequest& request) {
  const auto n = static_cast<std::uint64_t>(request.face_size);
  return 6 * n * n * static_cast<std::uint64_t>(request.path.spp) *
         static_cast<std::uint64_t>(request.path.passes);
}

/// Which balls shine at the probe, and how their direct view is sampled: a ball that covers few texels has
/// its own samples, where rays through texels would rarely find it.
GhostEmitters::Ball ball_of(const rays::GhostSphere& ghost, const rays::CubeRequest& request) {
  if (!is_finite(ghost.center) || !(ghost.radius >= 0) || !std::isfinite(ghost.radius)) {
    throw Error("ghost sphere", "its centre must be finite and its radius a length");
  }
  const float distance = glm::distance(ghost.center, request.position);
  GhostEmitters::Ball ball{ghost.center, ghost.radius, true};
  if (distance > 1.001f * ghost.radius) {
    constexpr float few_texels = 64;
    const auto texels = 6 * static_cast<float>(request.face_size) * static_cast<float>(request.face_size);
    ball.directly_by_rays =
        GhostEmitters::cone_solid_angle(ball, request.position) > few_texels * (4 * pi / texels);
  }
  return ball;
}

/// Adds the direct view of a small ball: unoccluded directions of its cone, each to the texel it falls into.
void splat_ball(const TracerData& data, const GhostEmitters::Ball& ball, int index,
                const rays::CubeRequest& request, const rays::RadianceSource::GhostSink& sink, int chunk,
                RayTask& task, image::CubeMap& map) {
  constexpr std::uint64_t samples_per_texel_sample = 128;
  const std::uint64_t count =
      std::min<std::uint64_t>(samples_per_texel_sample * static_cast<std::uint64_t>(request.path.spp) *
                                  static_cast<std::uint64_t>(request.path.passes),
                              1 << 20);
  const float solid_angle = GhostEmitters::cone_solid_angle(ball, request.position);
  const float share = solid_angle / static_cast<float>(count);
  const std::uint64_t seed =
      hash_combine(pixel_seed(request.path.seed, 0, static_cast<std::uint32_t>(index), 6), 0);
  for (std::uint64_t s = 0; s < count; ++s) {
    const PathSampler sampler{seed, static_cast<std::uint32_t>(s)};
    float distance;
    const vec3 direction =
        GhostEmitters::sample_cone(ball, request.position, sampler.camera().next2(), distance);
    const vec3 through =
        data.geometry.transmittance({request.position, direction, distance},
                                    sampler.passage(data.geometry, 0, true, false, request.paths), task);
    if (!(max_component(through) > 0)) continue;
    const CubePoint point = cube_point(direction);
    const auto texel = [&](float c) {
      return std::clamp(static_cast<int>(c * static_cast<float>(request.face_size)), 0,
                        request.face_size - 1);
    };
    const int x = texel(point.s), y = texel(point.t);
    const auto value =
        static_cast<float>(static_cast<double>(share) / texel_solid_angle(x, y, request.face_size));
    image::Image& image = map.faces[point.face];
    image.set_rgb(x, y, image.rgb(x, y) + value * through);
    if (sink) sink(chunk, {index, direction, -direction, share * through});
  }
}

}  // namespace

std::vector<rays::GroupRadiance> PathTracer::incident_radiance(const rays::CubeRequest& request,
                                                               const Control& control) const {
  const std::size_t groups = data_->group_count();
  check_request(request, 2 * groups);
  std::vector<image::CubeMap> maps(2 * groups, image::CubeMap(request.face_size));
  std::atomic<std::uint64_t> invalid{0};
  ProgressStage stage(control, "probe", path_count(request), "paths");
  parallel_for(
      6 * static_cast<std::size_t>(request.face_size), 1,
      [&](std::size_t begin, std::size_t end) {
        TaskScope scope(*data_, invalid, begin);
        TexelSums sums(groups, true, scope.task);
        trace_texel_rows(*data_, data_->emitters(), request, begin, end, sums, scope.task, maps, stage,
                         control);
      },
      control);
  report_invalid(invalid);

  std::vector<rays::GroupRadiance> result(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    result[g].emitted = std::move(maps[g]);
    result[g].reflected = std::move(maps[groups + g]);
  }
  return result;
}

std::vector<image::CubeMap> PathTracer::ghost_radiance(const rays::CubeRequest& request,
                                                       std::span<const rays::GhostSphere> ghosts,
                                                       const GhostSink& sink, const Control& control) const {
  check_request(request, ghosts.size());
  std::vector<GhostEmitters::Ball> balls;
  for (const rays::GhostSphere& ghost : ghosts) balls.push_back(ball_of(ghost, request));
  const GhostEmitters emitters(balls);
  std::vector<image::CubeMap> maps(ghosts.size(), image::CubeMap(request.face_size));
  std::atomic<std::uint64_t> invalid{0};
  ProgressStage stage(control, "probe", path_count(request), "paths");

  // Trace the texels; a chunk is done by one task in a fixed order, for the sink.
  const std::size_t rows = 6 * static_cast<std::size_t>(request.face_size);
  constexpr std::size_t chunks = ghost_chunk_count;
  parallel_for(
      chunks, 1,
      [&](std::size_t chunk, std::size_t) {
        TaskScope scope(*data_, invalid, chunk);
        TexelSums sums(ghosts.size(), false, scope.task);
        if (sink) sums.sink = &sink;
        sums.chunk = static_cast<int>(chunk);
        trace_texel_rows(*data_, emitters, request, chunk * rows / chunks, (chunk + 1) * rows / chunks, sums,
                         scope.task, maps, stage, control);
      },
      control);

  // Add the direct view of small balls, each to its own map.
  parallel_for(
      chunks, 1,
      [&](std::size_t chunk, std::size_t) {
        TaskScope scope(*data_, invalid, chunks + chunk);
        for (std::size_t j = chunk; j < balls.size(); j += chunks) {
          if (balls[j].radius > 0 && !balls[j].directly_by_rays && request.path.passes > 0) {
            splat_ball(*data_, balls[j], static_cast<int>(j), request, sink, static_cast<int>(chunk),
                       scope.task, maps[j]);
          }
        }
      },
      control);
  report_invalid(invalid);
  return maps;
}

}  // namespace ssphh::trace
