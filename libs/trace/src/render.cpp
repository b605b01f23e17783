/// Camera images: progressive passes of rows.

#include <ssphh/core/parallel.h>

#include "camera.h"
#include "indirect_lookup.h"
#include "mirror_lobe.h"
#include "tracer_data.h"

namespace ssphh::trace {
namespace {

/// What a picture's paths ask.
struct Asked {
  const TracerData& data;
  const SceneEmitters& emitters;
  const CameraRays& camera;
  const rays::IndirectLight* indirect;  ///< null: paths find all light themselves
  int max_depth;
};

/// Sums over the samples of one pixel in one pass.
class PixelSums {
 public:
  PixelSums(const Asked& asked, RayTask& task)
      : asked_(asked), groups_(asked.data.group_count()), task_(task) {}

  void clear() {
    std::ranges::fill(groups_, vec3(0));
    direct_ = indirect_ = looked_up_ = albedo_ = normal_ = vec3(0);
    depth_ = hits_ = 0;
  }

  void add(int depth, int group, const vec3& value, const vec3& /*emission*/) {
    if (!is_finite(value)) {
      ++task_.invalid;
      return;
    }
    if (group < 0) return;
    groups_[group] += value;
    (depth <= 1 ? direct_ : indirect_) += value;
  }

  void first_hit(const shading::Surface& surface, const vec3& /*ray_origin*/, const Ray& ray,
                 const Hit& hit) {
    const float cos_wo = -glm::dot(surface.normal, ray.direction);
    albedo_ += surface.unlit ? glm::min(surface.emission, vec3(1)) : shading::surface_albedo(surface, cos_wo);
    normal_ += surface.normal;
    depth_ += asked_.camera.depth(ray, hit.distance);
    hits_ += 1;
  }

  /// `mirrors`: what the path has followed to this surface. What its own specular lobe reflects is followed
  /// where it is narrow.
  float look_up(const vec3& throughput, const shading::Surface& surface, const vec3& ray_origin,
                const Ray& ray, const Hit& hit, const PathSampler& sampler, int mirrors = 0) {
    constexpr int most_mirrors = 4;
    if (!asked_.indirect || asked_.max_depth < mirrors + 2 || surface.unlit) return 0;
    const bool follows = mirrors < most_mirrors && asked_.indirect->follows_mirrors();
    const float followed = follows ? followed_share(surface) : 0;
    const vec3 value = throughput * reflected_indirect(*asked_.indirect, surface, ray_origin, -ray.direction,
                                                       moves(hit), followed);
    if (is_finite(value)) {
      looked_up_ += value;
      indirect_ += value;
    } else {
      ++task_.invalid;
    }
    if (followed > 0)
      follow_mirror(followed * throughput, surface, ray_origin, -ray.direction, sampler, mirrors + 1);
    return followed;
  }

  /// Writes the means over `spp` samples into pixel (x, y) of a pass.
  void store(RenderState& pass, int x, int y, int spp) const {
    const float scale = 1 / static_cast<float>(spp);
    vec3 color(0);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const vec3 mean = groups_[g] * scale;
      color += mean;
      if (!pass.groups.empty()) pass.groups[g].set_rgb(x, y, mean);
    }
    pass.color.set_rgb(x, y, color + looked_up_ * scale);
    pass.direct.set_rgb(x, y, direct_ * scale);
    pass.indirect.set_rgb(x, y, indirect_ * scale);
    pass.albedo.set_rgb(x, y, albedo_ * scale);
    pass.normal.set_rgb(x, y, normal_ * scale);
    *pass.depth.at(x, y) = depth_ * scale;
    *pass.coverage.at(x, y) = hits_ * scale;
  }

 private:
  /// Takes the light of a path that a mirror sends on.
  struct Mirrored {
    PixelSums& sums;
    vec3 scale;
    int mirrors;

    void first_hit(const shading::Surface&, const vec3&, const Ray&, const Hit&) const {}
    void add(int depth, int group, const vec3& value, const vec3& emission) const {
      sums.add(depth, group, scale * value, emission);
    }
    float look_up(const vec3& throughput, const shading::Surface& surface, const vec3& ray_origin,
                  const Ray& ray, const Hit& hit, const PathSampler& sampler) const {
      return sums.look_up(scale * throughput, surface, ray_origin, ray, hit, sampler, mirrors);
    }
  };

  void follow_mirror(const vec3& throughput, const shading::Surface& surface, const vec3& ray_origin,
                     const vec3& wo, const PathSampler& before, int mirrors) {
    const MirrorLobe lobe(surface, wo);
    // Grain comes of the first mirror: later ones are few, and seen through it.
    const float wanted = std::min(lobe.rays(), mirrors > 1 ? 1.0f : static_cast<float>(lobe.most_rays));
    const int rays = static_cast<int>(std::ceil(wanted));
    for (int r = 0; r < rays; ++r) {
      PathSampler sampler = before.mirrored();
      sampler.index = sampler.index * static_cast<std::uint32_t>(rays) + static_cast<std::uint32_t>(r);
      if (sampler.vertex(0).roulette * static_cast<float>(rays) >= wanted) continue;
      follow_ray(throughput / wanted, surface, lobe, ray_origin, sampler, mirrors);
    }
  }

  void follow_ray(const vec3& throughput, const shading::Surface& surface, const MirrorLobe& lobe,
                  const vec3& ray_origin, const PathSampler& sampler, int mirrors) {
    const PathSampler::Vertex random = sampler.vertex(0);
    PathVertex vertex{.position = surface.position,
                      .normal = surface.geometric_normal,
                      .looked_up = true,
                      .followed = true};
    const int light_samples = asked_.emitters.held() ? asked_.emitters.sample_count(vertex) : 0;
    for (int i = 0; i < light_samples; ++i) {
      const PathSampler::Vertex u = i == 0 ? random : sampler.light(i).vertex(0);
      const auto toward = asked_.emitters.sample(i, vertex, u.light, u.point);
      if (!toward || !(toward->pdf > 0)) continue;
      const shading::BsdfValue f = lobe.eval(toward->wi);
      add(1, toward->group,
          next_event(asked_.data.geometry, *toward, throughput * f.value * toward->radiance, f.pdf,
                     ray_origin, vertex.position, sampler.passage(asked_.data.geometry, 0, true, true),
                     task_),
          -toward->wi);
    }
    const auto sent = lobe.sample(random.lobe, random.direction);
    if (!sent) return;
    vertex.bsdf_pdf = sent->pdf;
    Mirrored visitor{*this, throughput * sent->weight, mirrors};
    trace_path(asked_.data.geometry, asked_.emitters, {ray_origin, sent->wi}, sampler,
               PathOptions{.max_depth = 2, .looks_up = true}, task_, visitor, &vertex);
  }

  bool moves(const Hit& hit) const {
    const int node = asked_.data.scene.instances[hit.instance].node;
    return node >= 0 && asked_.data.scene.nodes[node].movable;
  }

  const Asked& asked_;
  std::vector<vec3> groups_;
  vec3 direct_{0}, indirect_{0}, looked_up_{0}, albedo_{0}, normal_{0};
  float depth_ = 0, hits_ = 0;
  RayTask& task_;
};

void check_params(const RenderParams& params, std::size_t groups) {
  if (params.width < 1 || params.height < 1) throw Error("render size", "width and height must be positive");
  const Tile tile = tile_of(params);
  if (tile.x < 0 || tile.y < 0 || tile.width < 1 || tile.height < 1 || tile.width > params.width - tile.x ||
      tile.height > params.height - tile.y) {
    throw Error("render tile", "it must lie inside the picture");
  }
  check_path_params(params.path);
  // Sums and one pass, each six images and depth, coverage.
  check_image_memory("render size",
                     static_cast<std::uint64_t>(tile.width) * static_cast<std::uint64_t>(tile.height),
                     2 * (17 + 3 * (params.per_group ? groups : 0)));
}

void check_state(const RenderState& state, const RenderParams& params, std::size_t groups) {
  const Tile tile = tile_of(params);
  const auto fits = [&](const image::Image& i, int channels) {
    return i.width == tile.width && i.height == tile.height && i.channels == channels;
  };
  bool ok = fits(state.color, 3) && fits(state.direct, 3) && fits(state.indirect, 3) &&
            fits(state.albedo, 3) && fits(state.normal, 3) && fits(state.depth, 1) &&
            fits(state.coverage, 1) && state.groups.size() == (params.per_group ? groups : 0);
  for (const image::Image& i : state.groups) ok = ok && fits(i, 3);
  if (!ok) throw Error("render state", "it belongs to a render of another size or other light groups");
}

void add_image(image::Image& sum, const image::Image& pass) {
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += pass.pixels[i];
}

/// Sum of the groups in their order, so that it is exact.
void sum_groups(image::Image& color, const std::vector<image::Image>& groups) {
  std::ranges::fill(color.pixels, 0.0f);
  for (const image::Image& group : groups) add_image(color, group);
}

void add_pass(RenderState& state, const RenderState& pass, bool groups_are_all) {
  for (std::size_t g = 0; g < state.groups.size(); ++g) add_image(state.groups[g], pass.groups[g]);
  if (groups_are_all && !state.groups.empty()) {
    sum_groups(state.color, state.groups);
  } else {
    add_image(state.color, pass.color);
  }
  add_image(state.direct, pass.direct);
  add_image(state.indirect, pass.indirect);
  add_image(state.albedo, pass.albedo);
  add_image(state.normal, pass.normal);
  // Depth is a mean over the samples that hit: `depth` holds mean × passes, a pass holds mean × coverage.
  const auto passes = static_cast<float>(state.passes_done);
  for (std::size_t i = 0; i < state.depth.pixels.size(); ++i) {
    float &depth = state.depth.pixels[i], &coverage = state.coverage.pixels[i];
    const float before = passes > 0 ? depth / passes * coverage : 0;
    coverage += pass.coverage.pixels[i];
    depth = coverage > 0 ? (before + pass.depth.pixels[i]) / coverage * (passes + 1) : 0;
  }
  ++state.passes_done;
}

/// The lights of these groups alone; none: there are no groups.
std::optional<shading::LightSet> lights_of(const shading::LightSet& lights,
                                           const std::vector<std::string>& groups) {
  if (groups.empty()) return std::nullopt;
  std::vector<int> others;
  for (std::size_t g = 0; g < lights.groups().size(); ++g)
    if (std::ranges::find(groups, lights.groups()[g]) == groups.end()) others.push_back(static_cast<int>(g));
  return lights.without(others);
}

void run_passes(const TracerData& data, const rays::IndirectLight* indirect, const RenderParams& params,
                RenderState& state, const Control& control, const SeePass& see) {
  const std::size_t groups = data.group_count();
  check_params(params, groups);
  const CameraRays camera(params);
  if (state.color.empty()) {
    const Hash128 key = state.key;
    state = empty_state(params, groups);
    state.key = key == Hash128{} ? render_key(data.scene_hash(), data.time, params) : key;
  }
  check_state(state, params, groups);
  if (state.passes_done >= params.path.passes) return;

  // With probes, paths carry direct light only.
  PathOptions options{.max_depth = params.path.max_depth, .panes = data.panes()};
  if (indirect) options.max_depth = std::min(options.max_depth, 1), options.looks_up = true;
  // Whose direct light is looked up is sampled nowhere else.
  std::vector<int> looked_up;
  if (indirect && params.path.max_depth >= 2)
    looked_up = group_indices(data.lights.groups(), indirect->direct_groups());
  std::optional<shading::LightSet> sampled, mirrored, held;
  if (!looked_up.empty()) {
    sampled = data.lights.without(looked_up);
    mirrored = lights_of(data.lights, indirect->mirrored_groups());
    held = lights_of(data.lights, indirect->direct_groups());
  }
  const SceneEmitters emitters(data.lights, sampled ? *sampled : data.lights, mirrored ? &*mirrored : nullptr,
                               held ? &*held : nullptr);
  const Asked asked{data, emitters, camera, indirect, params.path.max_depth};
  const Tile tile = tile_of(params);
  const auto width = static_cast<std::uint64_t>(tile.width), height = static_cast<std::uint64_t>(tile.height);
  const std::uint64_t row_paths = width * static_cast<std::uint64_t>(params.path.spp);
  ProgressStage stage(control, "render",
                      row_paths * height * static_cast<std::uint64_t>(params.path.passes - state.passes_done),
                      "paths");
  RenderState pass = empty_state(params, groups);
  std::atomic<std::uint64_t> invalid{0};

  while (state.passes_done < params.path.passes) {
    const std::uint64_t rays_before = data.rays.total();
    const auto first_sample =
        static_cast<std::uint32_t>(state.passes_done) * static_cast<std::uint32_t>(params.path.spp);
    const auto render_row = [&](int row) {
      const int y = tile.y + row;
      TaskScope scope(
          data, invalid,
          static_cast<std::uint64_t>(state.passes_done) * height + static_cast<std::uint64_t>(row));
      PixelSums sums(asked, scope.task);
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        sums.clear();
        PathSampler sampler{
            pixel_seed(params.path.seed, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), 0};
        for (int s = 0; s < params.path.spp; ++s) {
          sampler.index = first_sample + static_cast<std::uint32_t>(s);
          const vec2 jitter = sampler.camera().next2();
          const Ray ray = camera.ray(static_cast<float>(x) + jitter.x, static_cast<float>(y) + jitter.y);
          trace_path(data.geometry, emitters, ray, sampler, options, scope.task, sums);
        }
        sums.store(pass, x - tile.x, row, params.path.spp);
      }
      stage.advance(row_paths);
    };
    parallel_for(
        static_cast<std::size_t>(height), 1, [&](std::size_t row) { render_row(static_cast<int>(row)); },
        control);
    add_pass(state, pass, indirect == nullptr);
    state.paths += row_paths * height;
    state.rays += data.rays.total() - rays_before;
    if (see) see(state);
  }
  report_invalid(invalid);
}

}  // namespace

void PathTracer::render(const RenderParams& params, RenderState& state, const Control& control,
                        const SeePass& see) const {
  run_passes(*data_, nullptr, params, state, control, see);
}

void PathTracer::render_with(const rays::IndirectLight& indirect, const RenderParams& params,
                             RenderState& state, const Control& control, const SeePass& see) const {
  run_passes(*data_, &indirect, params, state, control, see);
}

}  // namespace ssphh::trace
