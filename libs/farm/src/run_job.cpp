#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/stopwatch.h>
#include <ssphh/farm/run_job.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::farm {
namespace {

/// As much of the set as the stages look at.
probes::ProbeSet set_of(const ProbeJob& job) {
  probes::ProbeSet set;
  set.degree = job.degree;
  bake::set_path(set.generator, job.stage, job.path);
  set.generator.face_size = job.face_size;
  const bool viz = job.stage == bake::BakeStage::viz;
  set.probes.resize(viz ? job.places.size() : job.probes.back() + std::size_t{1});
  for (std::size_t i = 0; i < job.places.size(); ++i) {
    probes::Probe& probe = set.probes[viz ? i : job.probes[i]];
    probe.position = job.places[i].position;
    probe.radius = job.places[i].radius;
  }
  return set;
}

ProbeJobResult run(const ProbeJob& job, const PreparedScene& scene, const OtherRenderer& other,
                   const Control& control) {
  const probes::ProbeSet set = set_of(job);
  std::unique_ptr<rays::RadianceSource> theirs;
  if (job.renderer != Renderer::path) {
    if (job.renderer != other.renderer || !other.make)
      throw Error(fmt::format("renderer {}", name_of(job.renderer)), "is not there on this worker");
    theirs = other.make(scene, job.scene.time);
  }
  const rays::RadianceSource& source = theirs ? *theirs : *scene.tracer;
  ProbeJobResult result{job.stage, job.degree, {}};
  for (const std::uint32_t probe : job.probes) {
    control.check();
    result.probes.push_back(bake::bake_stage(source, set, job.viz_params, {job.stage, probe}, control));
  }
  return result;
}

std::unique_ptr<rays::IndirectLight> lookup_of(const ProbeLighting& lighting, std::span<const std::byte> file,
                                               const PreparedScene& scene) {
  const probes::ProbeSet set = probes::probes_from_binary(file, "probes of the job");
  return probes::make_lookup(lighting.lookup, set, *scene.tracer);
}

/// The others are empty.
void keep_layers(trace::RenderState& state, const std::vector<trace::RenderLayer>& layers) {
  for (const trace::RenderLayer layer : trace::render_layers()) {
    if (std::ranges::count(layers, layer) > 0) continue;
    for (image::Image& image : trace::images_of(state, layer)) image = {};
    if (layer == trace::RenderLayer::groups) state.groups.clear();
  }
}

TileJobResult run(const TileJob& job, const PreparedScene& scene, const rays::IndirectLight* lookup,
                  const Control& control) {
  TileJobResult result;
  for (const trace::Tile& tile : job.tiles) {
    trace::RenderParams params = job.params;
    params.tile = tile;
    TileResult& done = result.tiles.emplace_back();
    done.tile = tile;
    if (lookup) {
      scene.tracer->render_with(*lookup, params, done.state, control);
    } else {
      scene.tracer->render(params, done.state, control);
    }
    keep_layers(done.state, job.layers);
  }
  return result;
}

TransportJobResult run(const TransportJob& job, const PreparedScene& scene, const Control& control) {
  const trace::TransportScene source(scene.geometry, scene.scene);
  std::vector<scene::ProbePlace> places;
  for (const ProbeSphere& place : job.places) places.push_back({"", place.position, place.radius});
  probes::ProbeSet set = probes::dark_set(places, job.degree);
  set.generator.time = job.scene.time;
  TransportJobResult result;
  result.degree = job.degree;
  result.light_groups = source.light_groups();
  bake::bake_tile(source, set, job.params, job.light_known, result.report, control);
  for (probes::Probe& probe : set.probes) {
    if (!job.light_known) result.light.push_back(std::move(probe.groups));
    result.edges.push_back(std::move(probe.edges));
  }
  result.surfel_size = set.generator.surfel_size;
  result.records = std::move(set.surface);
  return result;
}

}  // namespace

JobResult run_job(const Job& job, SceneStore& scenes, const FetchChunk& fetch, const Control& control,
                  const OtherRenderer& other) {
  validate(job);
  const SceneRef& ref = std::visit([](const auto& j) -> const SceneRef& { return j.scene; }, job);
  const std::shared_ptr<const PreparedScene> scene = scenes.get(ref, fetch, control);
  const std::uint64_t rays_before = scene->tracer->rays_traced();
  const Stopwatch watch;
  JobResult result;
  if (const auto* probes = std::get_if<ProbeJob>(&job)) {
    result.data = run(*probes, *scene, other, control);
  } else if (const auto* transport = std::get_if<TransportJob>(&job)) {
    TransportJobResult& done = result.data.emplace<TransportJobResult>(run(*transport, *scene, control));
    result.stats.rays = done.report.rays;
  } else {
    const TileJob& tiles = std::get<TileJob>(job);
    std::unique_ptr<rays::IndirectLight> lookup;
    if (tiles.lighting) {
      lookup = lookup_of(*tiles.lighting,
                         fetch_blob(scenes.cache(), ref.package, tiles.lighting->probes,
                                    tiles.lighting->bytes, fetch, control),
                         *scene);
    }
    result.data = run(tiles, *scene, lookup.get(), control);
  }
  result.stats.seconds = watch.seconds();
  result.stats.rays += scene->tracer->rays_traced() - rays_before;
  return result;
}

}  // namespace ssphh::farm
