#include <algorithm>

#include <fmt/format.h>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/gen.h>
#include <ssphh/core/log.h>
#include <ssphh/core/random.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/probes/byte_parts.h>
#include <ssphh/probes/probe_file.h>

#include "checkpoint.h"
#include "part_progress.h"

namespace ssphh::bake {
namespace {

/// Everything that the result depends on.
Hash128 bake_key(const rays::RadianceSource& source, const probes::ProbeSet& set, const BakeParams& params) {
  const probes::GeneratorInfo& g = set.generator;
  Hasher hasher;
  hasher.value(probes::probe_file_version)
      .value(set.degree)
      .value(g.scene_hash.high)
      .value(g.scene_hash.low)
      .value(g.time);
  hasher.value(g.gen).value(g.max_depth).value(g.passes).value(g.spp).value(g.seed).value(g.face_size);
  hasher.value(g.viz_max_depth).value(g.viz_passes).value(g.viz_spp);
  hasher.value(params.keep_light).value(params.viz);
  const VizParams& viz = params.viz_params;
  hasher.value(viz.matrix).value(viz.neighbors).value(viz.threshold).value(viz.source).value(viz.paths);
  for (const std::string& group : source.light_groups()) hasher.text(group);
  for (const probes::Probe& probe : set.probes) {
    hasher.text(probe.name)
        .value(probe.position.x)
        .value(probe.position.y)
        .value(probe.position.z)
        .value(probe.radius);
  }
  return hasher.finish();
}

rays::CubeRequest request_of(const probes::ProbeSet& set, const ProbeStage& stage) {
  const probes::GeneratorInfo& g = set.generator;
  rays::CubeRequest request;
  request.position = set.probes[stage.probe].position;
  request.face_size = g.face_size;
  request.path = path_of(g, stage.stage);
  request.path.seed = hash_combine(g.seed, 2 * std::uint64_t{stage.probe} + (stage.stage == BakeStage::viz));
  return request;
}

ProbeStageResult decode(const CheckpointRecord& record, const probes::ProbeSet& set) {
  ByteReader in(record.payload, "checkpoint");
  ProbeStageResult result{{record.stage, record.probe}, record.seconds, record.rays, {}, {}};
  if (record.stage == BakeStage::gen) {
    result.groups = probes::read_groups(in, set.degree, set.light_groups.size());
  } else {
    result.edges =
        probes::read_edges(probes::ByteReaderParts(in), set.degree, record.probe, set.probes.size());
  }
  in.expect_end();
  return result;
}

CheckpointRecord encode(const ProbeStageResult& result) {
  ByteWriter out;
  if (result.done.stage == BakeStage::gen) {
    probes::write_groups(out, result.groups);
  } else {
    probes::write_edges(out, result.edges);
  }
  return {result.done.stage, result.done.probe, result.seconds, result.rays, out.take()};
}

void store(ProbeStageResult result, probes::ProbeSet& set, const BakeParams& params, BakeReport& report) {
  const bool gen = result.done.stage == BakeStage::gen;
  (gen ? report.gen_seconds : report.viz_seconds) += result.seconds;
  report.rays += result.rays;
  probes::Probe& probe = set.probes[result.done.probe];
  if (gen && params.only_groups) {
    for (const std::uint32_t g : *params.only_groups) probe.groups[g] = std::move(result.groups[g]);
  } else if (gen) {
    probe.groups = std::move(result.groups);
  } else {
    probe.edges = std::move(result.edges);
  }
}

struct Work {
  const rays::RadianceSource& source;
  const BakeParams& params;
  Checkpoint& checkpoint;
  probes::ProbeSet& set;
  BakeReport& report;
  const ProbeDone& on_probe;

  /// What an earlier run finished goes into the set; returns, stage by stage, what is left to do.
  std::vector<ProbeStage> resume(const std::vector<BakeStage>& stages) const {
    std::vector<ProbeStage> left;
    for (const BakeStage stage : stages) {
      std::vector<bool> done(set.probes.size(), params.only.has_value());
      if (params.only) {
        for (const std::uint32_t probe : *params.only) done[probe] = false;
      }
      for (const CheckpointRecord& record : checkpoint.records()) {
        if (record.stage != stage || record.probe >= done.size() || done[record.probe]) continue;
        keep(decode(record, set));
        done[record.probe] = true;
        ++report.resumed;
      }
      for (std::size_t i = 0; i < done.size(); ++i)
        if (!done[i]) left.push_back({stage, static_cast<std::uint32_t>(i)});
    }
    return left;
  }

  void finish(ProbeStageResult result) const {
    checkpoint.append(encode(result));
    keep(std::move(result));
  }

  void keep(ProbeStageResult result) const {
    const std::size_t i = result.done.probe;
    store(std::move(result), set, params, report);
    if (on_probe) on_probe(i, set.probes[i]);
  }

  /// Probe by probe; each is on all threads.
  void trace(BakeStage stage, const std::vector<ProbeStage>& left, const Control& control) const {
    const auto face = static_cast<std::uint64_t>(set.generator.face_size);
    const std::uint64_t texels = 6 * face * face, probes = set.probes.size();
    ProgressStage progress(control, stage == BakeStage::gen ? "GEN" : "VIZ", texels * probes, "texels");
    const auto count = static_cast<std::uint64_t>(std::ranges::count(left, stage, &ProbeStage::stage));
    progress.advance(texels * (probes - count));
    for (const ProbeStage& unit : left) {
      if (unit.stage != stage) continue;
      control.check();
      PartProgress part(progress, texels);
      finish(bake_stage(source, set, params.viz_params, unit, {&part, control.cancel}));
    }
  }
};

/// Looks at what a crew hands in before it is kept.
class CrewCheck {
 public:
  CrewCheck(const probes::ProbeSet& set, const std::vector<ProbeStage>& left) : set_(set), left_(left) {}

  void take(const ProbeStageResult& result) {
    const auto asked = std::ranges::find(left_, result.done);
    require(asked != left_.end(), "bake crew", "it did a probe that it was not asked for");
    const auto count = static_cast<std::size_t>(sh::coefficient_count(set_.degree));
    const auto fits = [count](const sh::RadianceSh& f) { return f.values.size() == count; };
    const bool gen = result.done.stage == BakeStage::gen;
    require(!gen || result.groups.size() == set_.light_groups.size(), "bake crew",
            "its light is of other light groups");
    for (const probes::GroupLight& light : result.groups)
      require((light.emitted.empty() || fits(light.emitted)) && fits(light.reflected), "bake crew",
              "its light is not of the set's degree");
    for (const probes::Edge& edge : result.edges)
      require(edge.from >= 0 && static_cast<std::size_t>(edge.from) < set_.probes.size() && fits(edge.h),
              "bake crew", "an edge comes from no probe or is not of the set's degree");
    left_.erase(asked);
  }
  void expect_end() const { require(left_.empty(), "bake crew", "it left probes out"); }

 private:
  const probes::ProbeSet& set_;
  std::vector<ProbeStage> left_;
};

void check_probes(const rays::RadianceSource& source, const probes::ProbeSet& set, BakeReport& report) {
  for (const probes::Probe& probe : set.probes) {
    const bool dark = std::ranges::all_of(probe.groups, [](const probes::GroupLight& light) {
      return light.emitted.empty() && sh::mean(light.reflected) == vec3(0);
    });
    for (const probes::Edge& edge : probe.edges) {
      const probes::Probe& from = set.probes[edge.from];
      if (glm::distance(probe.position, from.position) > from.radius) continue;
      report.warnings.push_back(
          fmt::format("probe \"{}\" stands within the sphere of \"{}\", whose light it gets from all sides: "
                      "the radius of {:.3g} m is too large",
                      probe.name, from.name, from.radius));
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

rays::PathParams path_of(const probes::GeneratorInfo& g, BakeStage stage) {
  if (stage == BakeStage::gen) return {g.max_depth, g.passes, g.spp, g.seed};
  return {g.viz_max_depth, g.viz_passes, g.viz_spp, g.seed};
}

void set_path(probes::GeneratorInfo& g, BakeStage stage, const rays::PathParams& path) {
  const bool gen = stage == BakeStage::gen;
  (gen ? g.max_depth : g.viz_max_depth) = path.max_depth;
  (gen ? g.passes : g.viz_passes) = path.passes;
  (gen ? g.spp : g.viz_spp) = path.spp;
  g.seed = path.seed;
}

ProbeStageResult bake_stage(const rays::RadianceSource& source, const probes::ProbeSet& set,
                            const VizParams& viz_params, const ProbeStage& stage, const Control& control) {
  require(stage.probe < set.probes.size(), "bake", "there is no probe of that index");
  const Stopwatch watch;
  const std::uint64_t rays_before = source.rays_traced();
  const rays::CubeRequest request = request_of(set, stage);
  ProbeStageResult result{stage, 0, 0, {}, {}};
  if (stage.stage == BakeStage::gen) {
    result.groups = gen(source, request, set.degree, control);
  } else {
    result.edges = viz(source, set, stage.probe, request, viz_params, control);
  }
  result.rays = source.rays_traced() - rays_before;
  result.seconds = watch.seconds();
  return result;
}

probes::ProbeSet bake(const rays::RadianceSource& source, probes::ProbeSet set, const BakeParams& params,
                      const std::filesystem::path& checkpoint_path, BakeReport& report,
                      const Control& control, BakeCrew* crew, const ProbeDone& on_probe) {
  if (set.probes.empty())
    throw Error("bake", "there are no probes to bake", "run INIT on a scene with SPHLs");
  if (params.only)
    require(std::ranges::all_of(*params.only, [&](std::uint32_t i) { return i < set.probes.size(); }), "bake",
            "there is no probe of that index");
  report = {};

  // Say how the set is made.
  probes::GeneratorInfo& g = set.generator;
  g.gen = params.gen;
  set_path(g, BakeStage::viz, params.viz_path.value_or(params.path));
  set_path(g, BakeStage::gen, params.path);
  if (params.gen == probes::GenMode::local) g.max_depth = 1;
  g.face_size = params.face_size;
  if (params.viz) {
    g.viz = probes::VizMethod::path;
    g.viz_source = params.viz_params.source;
    g.viz_paths = params.viz_params.paths;
  }
  if (params.keep_light || params.only) {
    if (!std::ranges::equal(set.light_groups, source.light_groups(), {}, &probes::LightGroup::name))
      throw Error("bake", "the light to keep is of other light groups than the scene's");
  } else {
    g.op = probes::LightOperator::path;
    set.light_groups.clear();
    for (const std::string& group : source.light_groups()) set.light_groups.push_back({group, vec3(1)});
    for (probes::Probe& probe : set.probes)
      probe.groups.assign(set.light_groups.size(), {{}, sh::RadianceSh(set.degree)});
  }
  if (params.only_groups)
    require(std::ranges::all_of(*params.only_groups,
                                [&](std::uint32_t group) { return group < set.light_groups.size(); }),
            "bake", "there is no light group of that index");
  set.hierarchy.reset();
  probes::validate(set, "bake");

  Checkpoint checkpoint(checkpoint_path, bake_key(source, set, params));
  std::vector<BakeStage> stages;
  if (!params.keep_light) stages.push_back(BakeStage::gen);
  if (params.viz) stages.push_back(BakeStage::viz);
  const Work work{source, params, checkpoint, set, report, on_probe};
  const std::vector<ProbeStage> left = work.resume(stages);
  if (crew) {
    CrewCheck check(set, left);
    const auto done = [&](ProbeStageResult result) {
      check.take(result);
      work.finish(std::move(result));
    };
    crew->run(set, params, left, done, control);
    check.expect_end();
  } else {
    for (const BakeStage stage : stages) work.trace(stage, left, control);
  }
  probes::merge_groups(set);

  check_probes(source, set, report);
  probes::validate(set, "bake");
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

}  // namespace ssphh::bake
