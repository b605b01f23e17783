#include <fmt/format.h>

#include <ssphh/bake/bake.h>
#include <ssphh/farm/engine.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>

namespace ssphh::farm {

extern const char* const source_id;  // made by cmake/SourceId.cmake

namespace {

void add(Hasher& hasher, const std::vector<probes::GroupLight>& groups) {
  for (const probes::GroupLight& light : groups)
    hasher.array(light.emitted.values).array(light.reflected.values);
}

std::string compute_id() {
  Hasher hasher;
  hasher.text(source_id);
  const scene::Scene scene = scene::make_builtin("gallery1");
  const trace::PathTracer tracer(scene);
  probes::ProbeSet set = place::init_from_scene(scene, 4);
  set.generator.face_size = 6;
  set.generator.max_depth = 4;
  set.generator.spp = 4;
  add(hasher, bake::bake_stage(tracer, set, {}, {bake::BakeStage::gen, 0}).groups);
  for (const probes::Edge& edge : bake::bake_stage(tracer, set, {}, {bake::BakeStage::viz, 1}).edges)
    hasher.array(edge.h.values);
  return hasher.finish().hex().substr(0, 16);
}

}  // namespace

const std::string& engine_id() {
  static const std::string id = compute_id();
  return id;
}

std::string job_service(Renderer renderer) {
  const std::string ours = "ssphh.jobs." + engine_id();
  return renderer == Renderer::path ? ours : fmt::format("{}.{}", ours, name_of(renderer));
}

std::string blob_service(const Hash128& package) {
  return "ssphh.blobs." + package.hex();
}

}  // namespace ssphh::farm
