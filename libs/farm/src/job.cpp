#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/require_named.h>
#include <ssphh/farm/job.h>

namespace ssphh::farm {
namespace {

void require(bool condition, const std::string& where, const std::string& problem) {
  if (!condition) throw Error("job: " + where, problem);
}

std::uint64_t samples_of(const rays::PathParams& path) {
  require(path.max_depth >= 0 && path.max_depth <= 65535, "max_depth", "must lie in 0..65535");
  require(path.passes >= 1 && path.passes <= 1 << 24, "passes", "must lie in 1..2^24");
  require(path.spp >= 1 && path.spp <= 1 << 24, "spp", "must lie in 1..2^24");
  const auto samples = static_cast<std::uint64_t>(path.passes) * static_cast<std::uint64_t>(path.spp);
  require(samples <= UINT32_MAX, "passes", "more than 2^32 samples per pixel");
  return samples;
}

void check(const SceneRef& scene) {
  require(std::isfinite(scene.time), "scene/time", "must be finite");
}

void check(const std::vector<ProbeSphere>& places) {
  for (const ProbeSphere& place : places) {
    require(is_finite(place.position), "places", "a position is not finite");
    require(place.radius > 0 && std::isfinite(place.radius), "places", "a radius is not positive");
  }
}

void check(const ProbeJob& job) {
  check(job.scene);
  require_named("job: renderer", job.renderer);
  require(job.degree >= 0 && job.degree <= sh::max_degree, "degree", "must lie in 0..10");
  require(job.face_size >= 1 && job.face_size <= 4096, "face_size", "must lie in 1..4096");
  require(!job.probes.empty() && job.probes.size() <= job_limits::units, "probes", "must be 1 to 4096");
  const auto face = static_cast<std::uint64_t>(job.face_size);
  require(samples_of(job.path) <= job_limits::samples / (6 * face * face * job.probes.size()), "probes",
          "the job is too long: more than 2^40 paths");
  const bool viz = job.stage == bake::BakeStage::viz;
  require(viz || job.places.size() == job.probes.size(), "places", "must be one for each probe");
  require(job.places.size() <= job_limits::places, "places", "must be at most 65536");
  for (std::size_t i = 0; i < job.probes.size(); ++i) {
    require(i == 0 || job.probes[i] > job.probes[i - 1], "probes", "must ascend");
    require(job.probes[i] < (viz ? job.places.size() : job_limits::places), "probes",
            "an index is out of range");
  }
  check(job.places);
}

void check(const TileJob& job) {
  check(job.scene);
  const trace::RenderParams& p = job.params;
  const auto edge = [](int pixels) { return pixels >= 1 && pixels <= job_limits::picture_size; };
  require(edge(p.width) && edge(p.height), "width", "width and height must lie in 1..65536");
  require(!job.tiles.empty() && job.tiles.size() <= job_limits::units, "tiles", "must be 1 to 4096");
  std::uint64_t pixels = 0;
  for (const trace::Tile& t : job.tiles) {
    require(t.x >= 0 && t.y >= 0 && t.width >= 1 && t.height >= 1 && t.width <= job_limits::tile_size &&
                t.height <= job_limits::tile_size && t.x <= p.width - t.width && t.y <= p.height - t.height,
            "tiles", "one lies outside the picture or is over 1024 pixels wide");
    pixels += static_cast<std::uint64_t>(t.width) * static_cast<std::uint64_t>(t.height);
  }
  require(pixels <= std::uint64_t{1} << 22, "tiles", "more than 2^22 pixels");
  require(samples_of(p.path) <= job_limits::samples / pixels, "tiles",
          "the job is too long: more than 2^40 paths");
  require(!job.layers.empty(), "layers", "there are none");
  for (std::size_t i = 1; i < job.layers.size(); ++i)
    require(job.layers[i - 1] < job.layers[i], "layers",
            "doubled or out of order: " + std::string(name_of(job.layers[i])));
  require((job.layers.back() == trace::RenderLayer::groups) == p.per_group, "layers",
          "groups go with per_group");
  if (!job.lighting) return;
  require(job.lighting->lookup.layer != probes::ProbeLayer::neighbor, "lighting/layer",
          "must be sum or self");
}

void check(const TransportJob& job) {
  check(job.scene);
  const bake::TransportBakeParams& p = job.params;
  const auto within = [](auto value, auto least, auto most) { return value >= least && value <= most; };
  require(job.degree >= 0 && job.degree <= sh::max_degree, "degree", "must lie in 0..10");
  require(p.op == probes::LightOperator::surfel && !p.fit, "operator",
          "must be surfel, without fitted weights");
  require(within(job.places.size(), std::size_t{1}, job_limits::tile_places), "places", "must be 1 to 16384");
  require(within(p.own_probes, std::size_t{1}, job.places.size()), "own",
          "must be 1 to the number of places");
  check(job.places);
  const transport::TransportParams& t = p.transport;
  require(within(t.directions, 8, 1 << 16), "transport/directions", "must lie in 8..65536");
  require(within(t.link_rays, 4, 1 << 16), "transport/link_rays", "must lie in 4..65536");
  require(within(t.samples, 1, 32), "transport/samples", "must lie in 1..32");
  require(within(t.surfel_size, 0.0f, 1e9f), "transport/surfel_size", "must be 0 or more");
  require(within(t.surfels_per_radius, 1.0f, 1e6f), "transport/surfels_per_radius", "must be 1 or more");
  require(within(t.most_surfels, 1, 1 << 24), "transport/most_surfels", "must lie in 1..2^24");
  require(within(p.records.points, 0, 1 << 16), "records/points", "must lie in 0..65536");
  require(within(p.records.rays, 4, 1 << 16), "records/rays", "must lie in 4..65536");
  require(p.records.baked.size() <= 256, "records/baked", "are more than 256 light groups");
}

}  // namespace

JobKind kind_of(const Job& job) {
  if (std::holds_alternative<TransportJob>(job)) return JobKind::transport;
  const auto* probes = std::get_if<ProbeJob>(&job);
  if (!probes) return JobKind::ref;
  return probes->stage == bake::BakeStage::gen ? JobKind::gen : JobKind::viz;
}

void validate(const Job& job) {
  std::visit([](const auto& j) { check(j); }, job);
}

}  // namespace ssphh::farm
