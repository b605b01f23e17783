#pragma once

#include <algorithm>

#include <ssphh/core/random.h>
#include <ssphh/probes/probe_set.h>

namespace ssphh::test {

inline sh::RadianceSh random_sh(Pcg32& rng, int degree, float scale = 1) {
  sh::RadianceSh f(degree);
  for (vec3& v : f.values) v = scale * (2.0f * rng.uniform3() - 1.0f);
  return f;
}

/// Points with 0, 1, 2 ... of the set's probes each.
inline probes::FittedPoints random_fitted(std::uint64_t seed, int point_count, int probe_count) {
  Pcg32 rng(seed);
  probes::FittedPoints fitted;
  for (int i = 0; i < point_count; ++i) {
    fitted.points.push_back({10.0f * rng.uniform3(), glm::normalize(2.0f * rng.uniform3() - 1.0f)});
    probes::PointWeights& weights = fitted.weights.emplace_back();
    weights.count = i % (std::min(probe_count, probes::max_weights) + 1);
    for (int k = 0; k < weights.count; ++k) weights.entries[k] = {k, rng.uniform()};
  }
  return fitted;
}

inline probes::SurfaceRecords random_records(std::uint64_t seed, int point_count, int group_count) {
  Pcg32 rng(seed);
  probes::SurfaceRecords records;
  records.groups.resize(static_cast<std::size_t>(group_count));
  for (int i = 0; i < point_count; ++i) {
    const vec3 normal = glm::normalize(2.0f * rng.uniform3() - 1.0f);
    records.points.push_back({10.0f * rng.uniform3(), normal});
    for (std::vector<probes::PackedRecordLight>& group : records.groups) {
      probes::RecordLight light;
      for (glm::length_t c = 0; c < 4; ++c) light[c] = rng.uniform3();
      group.push_back(probes::pack(light, normal));
    }
  }
  return records;
}

inline probes::Baseline random_baseline(std::uint64_t seed, int item_count, int probe_count,
                                        int group_count) {
  Pcg32 rng(seed);
  const auto hash = [&] { return Hash128{rng.next(), rng.next()}; };
  probes::Baseline baseline;
  baseline.viz_neighbors = 7;
  baseline.viz_threshold = 0.25f;
  baseline.records = 100;
  baseline.most_surfels = 5000;
  for (int i = 0; i < item_count; ++i)
    baseline.items.push_back({static_cast<scene::ItemKind>(i % 3), "item \"" + std::to_string(i) + "\"",
                              hash(), hash(), hash(), hash()});
  for (int i = 0; i < probe_count; ++i) {
    probes::Trial& trial = baseline.trials.emplace_back();
    for (std::vector<sh::RadianceSh>& half : trial.halves)
      for (int g = 0; g < group_count; ++g) half.push_back(random_sh(rng, probes::trial_degree));
  }
  return baseline;
}

/// A valid set with random light; every probe is a neighbour of every other.
inline probes::ProbeSet random_set(std::uint64_t seed, int probe_count, int degree, int group_count = 2,
                                   bool matrices = false) {
  Pcg32 rng(seed);
  probes::ProbeSet set;
  set.degree = degree;
  set.generator.scene = "random \"quoted\" \u00fc";
  set.generator.scene_hash = {0x0123456789abcdefull, seed};
  set.generator.seed = ~seed;
  set.generator.time = 0.1f;
  set.generator.op = probes::LightOperator::surfel;
  set.generator.viz = probes::VizMethod::links;
  set.generator.directions = 384;
  set.generator.surfel_size = 0.3f;
  set.generator.link_rays = 128;
  for (int g = 0; g < group_count; ++g)
    set.light_groups.push_back({"lamp " + std::to_string(g), rng.uniform3()});
  for (int i = 0; i < probe_count; ++i) {
    probes::Probe probe;
    probe.name = "SPHL " + std::to_string(i);
    probe.position = 10.0f * rng.uniform3();
    probe.radius = 0.1f + rng.uniform();
    for (int g = 0; g < group_count; ++g) {
      // The first group's emitters are not seen directly.
      probe.groups.push_back({g == 0 ? sh::RadianceSh() : random_sh(rng, degree), random_sh(rng, degree)});
    }
    for (int j = 0; j < probe_count; ++j) {
      if (j == i) continue;
      probes::Edge edge;
      edge.from = j;
      edge.transfer = rng.uniform();
      edge.h = random_sh(rng, degree, 0.1f);
      if (matrices) {
        edge.matrix = sh::TransferMatrix(degree, degree);
        for (vec3& v : edge.matrix.values) v = 0.1f * rng.uniform3();
      }
      probe.edges.push_back(std::move(edge));
    }
    set.probes.push_back(std::move(probe));
  }
  probes::merge_groups(set);
  return set;
}

}  // namespace ssphh::test
