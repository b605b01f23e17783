#include "unit_key.h"

#include <ssphh/farm/engine.h>
#include <ssphh/farm/job_codec.h>

namespace ssphh::farm {
namespace {

using bake::BakeStage;

void add(Hasher& h, const ProbeSphere& place) {
  for (int c = 0; c < 3; ++c) h.value(place.position[c]);
  h.value(place.radius);
}

}  // namespace

ProbeJob job_of_set(const probes::ProbeSet& set, const bake::VizParams& viz_params, BakeStage stage,
                    const SceneRef& scene) {
  const probes::GeneratorInfo& g = set.generator;
  ProbeJob job;
  job.scene = scene;
  job.stage = stage;
  job.degree = set.degree;
  job.face_size = g.face_size;
  job.path = bake::path_of(g, stage);
  job.viz_params = viz_params;
  for (const probes::Probe& probe : set.probes) job.places.push_back({probe.position, probe.radius});
  return job;
}

ProbeLighting lighting_of(const RenderProbes& probes, const Blob& file) {
  return {file.hash, file.bytes.size(), probes.lookup};
}

Hash128 unit_key(const ProbeJob& all, std::uint32_t probe) {
  Hasher h;
  h.text("probe").text(engine_id()).value(job_version).value(all.stage);
  if (all.renderer != Renderer::path) h.text(name_of(all.renderer));
  h.value(all.scene.light.high).value(all.scene.light.low).value(all.scene.time);
  h.value(all.degree).value(all.face_size).value(all.path.max_depth).value(all.path.passes);
  h.value(all.path.spp).value(all.path.seed).value(probe);
  if (all.stage == BakeStage::gen) {
    add(h, all.places[probe]);
  } else {
    const bake::VizParams& viz = all.viz_params;
    h.value(viz.matrix).value(viz.neighbors).value(viz.threshold).value(viz.source).value(viz.paths);
    for (const ProbeSphere& place : all.places) add(h, place);
  }
  return h.finish();
}

Hash128 unit_key(const TileJob& job, const trace::Tile& tile) {
  const Hash128 render = trace::render_key(job.scene.light, job.scene.time, job.params);
  Hasher h;
  h.text("tile").text(engine_id()).value(job_version).value(render.high).value(render.low);
  h.value(job.params.path.passes).value(tile.x).value(tile.y).value(tile.width).value(tile.height);
  for (const trace::RenderLayer layer : job.layers) h.text(name_of(layer));
  if (job.lighting) {
    const ProbeLighting& l = *job.lighting;
    h.value(l.probes.high).value(l.probes.low).text(name_of(l.lookup.method));
    h.text(l.lookup.weights ? name_of(*l.lookup.weights) : "").text(name_of(l.lookup.layer));
  }
  return h.finish();
}

Hash128 unit_key(const TransportJob& job) {
  TransportJob asked = job;
  asked.scene.package = {}, asked.scene.manifest_bytes = 1;
  Hasher h;
  h.text("transport").text(engine_id()).text(encode_job(asked, ContentType::binary));
  return h.finish();
}

}  // namespace ssphh::farm
