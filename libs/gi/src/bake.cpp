#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/core/random.h>
#include <ssphh/gi/bake.h>
#include <ssphh/gi/gen.h>
#include <ssphh/gi/probe_file.h>

#include "checkpoint.h"
#include "part_progress.h"
#include "probe_bytes.h"

namespace ssphh::gi {
namespace {

/// Everything that the result depends on.
Hash128 bake_key(const scene::RadianceSource& source, const ProbeSet& set, const BakeParams& params) {
  const GeneratorInfo& g = set.generator;
  Hasher hasher;
  hasher.value(probe_file_version)
      .value(set.degree)
      .value(g.scene_hash.high)
      .value(g.scene_hash.low)
      .value(g.time);
  hasher.value(g.gen).value(g.max_depth).value(g.passes).value(g.spp).value(g.seed).value(g.face_size);
  hasher.value(params.keep_light).value(params.viz);
  const VizParams& viz = params.viz_params;
  hasher.value(viz.matrix).value(viz.neighbors).value(viz.threshold);
  for (const std::string& group : source.light_groups()) hasher.text(group);
  for (const Probe& probe : set.probes) {
    hasher.text(probe.name)
        .value(probe.position.x)
        .value(probe.position.y)
        .value(probe.position.z)
        .value(probe.radius);
  }
  return hasher.finish();
}

struct Job {
  const scene::RadianceSource& source;
  const BakeParams& params;
  ProbeSet& set;
  BakeReport& report;

  scene::CubeRequest request(std::size_t probe, BakeStage stage) const {
    scene::CubeRequest request;
    request.position = set.probes[probe].position;
    request.face_size = set.generator.face_size;
    request.path = params.path;
    request.path.max_depth = set.generator.max_depth;
    request.path.seed =
        hash_combine(set.generator.seed, 2 * std::uint64_t{probe} + (stage == BakeStage::viz));
    return request;
  }

  void trace(std::size_t i, BakeStage stage, const Control& control) const {
    Probe& probe = set.probes[i];
    const scene::CubeRequest cube = request(i, stage);
    if (stage == BakeStage::gen) {
      probe.groups = gen(source, cube, set.degree, control);
    } else {
      probe.edges = viz(source, set, i, cube, params.viz_params, control);
    }
  }

  void restore(const CheckpointRecord& record) const {
    ByteReader in(record.payload, "checkpoint");
    Probe& probe = set.probes[record.probe];
    if (record.stage == BakeStage::gen) {
      probe.groups = read_groups(in, set.degree, set.light_groups.size());
    } else {
      probe.edges = read_edges(in, set.degree, record.probe, set.probes.size());
    }
    in.expect_end();
  }

  std::vector<std::byte> encode(std::size_t i, BakeStage stage) const {
    ByteWriter out;
    if (stage == BakeStage::gen) {
      write_groups(out, set.probes[i].groups);
    } else {
      write_edges(out, set.probes[i].edges);
    }
    return out.bytes();
  }
};

void run_stage(const Job& job, BakeStage stage, Checkpoint& checkpoint, const Control& control) {
  const std::size_t probe_count = job.set.probes.size();
  double& seconds = stage == BakeStage::gen ? job.report.gen_seconds : job.report.viz_seconds;

  // Take what an earlier run finished.
  std::vector<bool> done(probe_count, false);
  for (const CheckpointRecord& record : checkpoint.records()) {
    if (record.stage != stage || record.probe >= probe_count || done[record.probe]) continue;
    job.restore(record);
    done[record.probe] = true;
    seconds += record.seconds;
    job.report.rays += record.rays;
    ++job.report.resumed;
  }

  // Trace the rest, probe by probe; each is on all threads.
  const auto face = static_cast<std::uint64_t>(job.set.generator.face_size);
  const std::uint64_t texels = 6 * face * face;
  ProgressStage progress(control, stage == BakeStage::gen ? "GEN" : "VIZ", texels * probe_count, "texels");
  for (std::size_t i = 0; i < probe_count; ++i) {
    control.check();
    PartProgress part(progress, texels);
    if (done[i]) continue;
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t rays_before = job.source.rays_traced();
    job.trace(i, stage, {&part, control.cancel});
    CheckpointRecord record{
        stage, static_cast<std::uint32_t>(i), 0, job.source.rays_traced() - rays_before, {}};
    record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    seconds += record.seconds;
    job.report.rays += record.rays;
    record.payload = job.encode(i, stage);
    checkpoint.append(record);
  }
}

void check_probes(const scene::RadianceSource& source, const ProbeSet& set, BakeReport& report) {
  for (const Probe& probe : set.probes) {
    const bool dark = std::all_of(probe.groups.begin(), probe.groups.end(), [](const GroupLight& light) {
      return light.emitted.empty() && sh::mean(light.reflected) == vec3(0);
    });
    for (const Edge& edge : probe.edges) {
      const float transfer = transfer_coefficient(edge.h);
      if (transfer <= 1.001f) continue;  // more than rounding
      report.warnings.push_back(
          fmt::format("P({} <- {}) = {:.3g} is stored as 1: the sphere of \"{}\" is that close", probe.name,
                      set.probes[static_cast<std::size_t>(edge.from)].name, transfer,
                      set.probes[static_cast<std::size_t>(edge.from)].name));
    }
    const float inside = source.backface_fraction(probe.position);
    if (inside > 0.5f) {
      report.warnings.push_back(
          fmt::format("probe \"{}\" seems to lie inside a body: {:.0f} % of what it sees are back faces",
                      probe.name, 100 * inside));
    } else if (dark) {
      report.warnings.push_back(fmt::format("probe \"{}\" receives no light at all", probe.name));
    }
  }
}

}  // namespace

ProbeSet bake(const scene::RadianceSource& source, ProbeSet set, const BakeParams& params,
              const std::filesystem::path& checkpoint_path, BakeReport& report, const Control& control) {
  if (set.probes.empty())
    throw Error("bake", "there are no probes to bake", "run INIT on a scene with SPHLs");
  report = {};

  // Say how the set is made.
  GeneratorInfo& g = set.generator;
  g.gen = params.gen;
  g.max_depth = params.gen == GenMode::local ? 1 : params.path.max_depth;
  g.passes = params.path.passes;
  g.spp = params.path.spp;
  g.seed = params.path.seed;
  g.face_size = params.face_size;
  if (params.viz) g.viz = VizMethod::path;
  if (params.keep_light) {
    if (!std::ranges::equal(set.light_groups, source.light_groups(), {}, &LightGroup::name))
      throw Error("bake", "the light to keep is of other light groups than the scene's");
  } else {
    g.op = LightOperator::path;
    set.light_groups.clear();
    for (const std::string& group : source.light_groups()) set.light_groups.push_back({group, vec3(1)});
    for (Probe& probe : set.probes)
      probe.groups.assign(set.light_groups.size(), {{}, sh::RadianceSh(set.degree)});
  }
  set.hierarchy.reset();
  validate(set, "bake");

  Checkpoint checkpoint(checkpoint_path, bake_key(source, set, params));
  const Job job{source, params, set, report};
  if (!params.keep_light) run_stage(job, BakeStage::gen, checkpoint, control);
  if (params.viz) run_stage(job, BakeStage::viz, checkpoint, control);
  merge_groups(set);

  check_probes(source, set, report);
  validate(set, "bake");
  constexpr std::size_t most_lines = 10;
  for (std::size_t i = 0; i < std::min(report.warnings.size(), most_lines); ++i) {
    log_warning("{}", report.warnings[i]);
  }
  if (report.warnings.size() > most_lines) {
    log_warning("and {} more like these; `ssphh probe lint` lists what is wrong with a set",
                report.warnings.size() - most_lines);
  }
  return set;
}

}  // namespace ssphh::gi
