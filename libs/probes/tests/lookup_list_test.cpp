/// Which weights lookups give among many probes, some of them hidden, and what light by them: number by
/// number, as they were. Closed forms elsewhere tell what they should be where there are some.

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>
#include <ssphh/probes/candidate_grid.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>

#include "fake_source.h"
#include "number_list.h"
#include "random_set.h"
#include "varied_light.h"

namespace ssphh::probes {
namespace {

using test::NumberList;

/// Two rooms with a wall at x = 2.1 between them, and a door in it below y = 1.3 between z = 1 and 2.2.
bool free_way(const vec3& a, const vec3& b) {
  if ((a.x < 2.1f) == (b.x < 2.1f)) return true;
  const vec3 at = glm::mix(a, b, (2.1f - a.x) / (b.x - a.x));
  return at.y < 1.3f && at.z > 1 && at.z < 2.2f;
}

std::vector<vec3> scattered(int count, float size, std::uint64_t seed) {
  Pcg32 random(seed);
  std::vector<vec3> places;
  for (int i = 0; i < count; ++i) places.push_back(size * random.uniform3());
  return places;
}

/// In both rooms, beside the wall, outside of all, and one that moves.
std::vector<rays::SurfacePoint> listed_points() {
  Pcg32 random(17);
  std::vector<rays::SurfacePoint> at;
  for (int i = 0; i < 12; ++i)
    at.push_back({4.0f * random.uniform3(), sample_uniform_sphere(random.uniform2()), i == 3});
  at.push_back({{2.08f, 2.9f, 3.7f}, {-1, 0, 0}});
  at.push_back({{2.13f, 0.4f, 0.3f}, {1, 0, 0}});
  at.push_back({{-3, 7, 11}, glm::normalize(vec3(1, -2, 1))});
  return at;
}

/// Shares are listed beside the whole, whose rounding is theirs.
void add(NumberList& list, const std::string& name, const ProbeWeights& weights) {
  std::vector<float> numbers;
  for (const ProbeWeight& w : weights.used())
    numbers.push_back(static_cast<float>(w.probe)), numbers.push_back(1 + w.weight);
  list.add(name, numbers);
}

TEST(LookupList, OfWeightsIsWhatItWas) {
  NumberList list;
  std::vector<vec3> grid;
  for (int i = 0; i < 80; ++i) grid.push_back(vec3(0.1f, 0.2f, 0.3f) + 0.9f * vec3(i % 5, i / 5 % 4, i / 20));
  const std::vector<std::vector<vec3>> sets{scattered(60, 4, 5), grid, scattered(5, 4, 6)};
  for (const std::vector<vec3>& probes : sets) {
    list.add(fmt::format("{} probes", probes.size()), median_spacing(probes));
    for (const WeightMethod method : {WeightMethod::distance, WeightMethod::trilinear, WeightMethod::mls}) {
      for (const bool other : {false, true}) {
        WeightParams params;
        params.method = method;
        if (other) params.nearest = 5, params.spacing = 1.1f, params.normal_offset = 0.07f;
        const auto weights = make_weights(probes, free_way, params);
        list.add(std::string(name_of(method)), other, weights->bytes());
        for (const rays::SurfacePoint& p : listed_points()) add(list, " at", weights->at(p));
        if (&probes != &sets[1]) add(list, " on a probe", weights->at({probes[2], {0, 1, 0}}));  // no ties
      }
    }
  }
  list.expect("libs/probes/tests/expected/weights.txt");
}

/// Places on the floor and on the wall's two sides, each with a few of the probes around it.
FittedPoints some_points(const std::vector<vec3>& probes) {
  WeightParams params;
  params.method = WeightMethod::distance, params.nearest = 9;
  const auto weights = make_weights(probes, free_way, params);
  FittedPoints fitted;
  for (const vec3& p : scattered(160, 4, 9)) {
    const rays::SurfacePoint at = p.y < 2   ? rays::SurfacePoint{{p.x, 0, p.z}, {0, 1, 0}}
                                  : p.x < 2 ? rays::SurfacePoint{{2.1f, p.y - 1, p.z}, {-1, 0, 0}}
                                            : rays::SurfacePoint{{2.11f, p.y - 1, p.z}, {1, 0, 0}};
    fitted.points.push_back(at);
    PointWeights& own = fitted.weights.emplace_back();
    const ProbeWeights found = weights->at(at);
    for (const ProbeWeight& w : found.used()) own.add(w.probe, 0.9f * w.weight);
  }
  return fitted;
}

TEST(LookupList, OfFittedWeightsIsWhatItWas) {
  const std::vector<vec3> probes = scattered(70, 4, 5);
  const FittedPoints fitted = some_points(probes);
  const auto weights = make_weights(probes, free_way, {}, &fitted);
  NumberList list;
  list.add("bytes", weights->bytes());
  for (const vec3& p : scattered(14, 3.8f, 21)) {
    add(list, "floor", weights->at({{p.x, 0.02f * p.y, p.z}, glm::normalize(vec3(0.1f, 1, -0.2f))}));
    add(list, "wall", weights->at({{2.1f - 0.01f * p.x, p.y, p.z}, {-1, 0, 0}}));
    add(list, "behind", weights->at({{2.11f, p.y, p.z}, glm::normalize(vec3(1, 0.3f, 0))}));
  }
  add(list, "moves", weights->at({{1, 0, 1}, {0, 1, 0}, true}));
  add(list, "on a point", weights->at(fitted.points[5]));
  list.expect("libs/probes/tests/expected/fitted-weights.txt");
}

TEST(LookupList, OfLightIsWhatItWas) {
  ProbeSet set = test::random_set(3, 9, 5, 2, true);
  for (Probe& probe : set.probes) {
    probe.position *= 0.4f;
    for (sh::RadianceSh* f : {&probe.reflected, &probe.self}) (*f)[0] = glm::abs((*f)[0]) + 2.0f;
  }
  test::FakeSource source;
  source.free = free_way;
  NumberList list;
  for (const HierOperator op : {HierOperator::coefficient, HierOperator::mean, HierOperator::matrix}) {
    for (const auto& [neighbors, threshold] : {std::pair(-1, 0.0f), {3, 0.2f}, {0, 0.0f}}) {
      const HierParams params{op, neighbors, threshold};
      list.add(std::string(name_of(op)), neighbors, threshold, hier(set, params));
      for (const std::size_t i : {0u, 8u})
        for (const std::size_t k : {0u, 7u, 35u})
          list.add(" sum", set.hierarchy->neighbor[i].values[k], set.hierarchy->sum[i].values[k]);
      if (const auto contraction = hier_contraction(set, params))
        list.add(" contraction", contraction->lower, contraction->upper);
    }
  }
  hier(set, {HierOperator::mean, 4, 0.1f});
  for (const LookupMethod method : {LookupMethod::light, LookupMethod::irradiance}) {
    for (const ProbeLayer layer : {ProbeLayer::self, ProbeLayer::neighbor, ProbeLayer::sum}) {
      for (const bool other : {false, true}) {
        LookupParams params;
        params.layer = layer;
        if (other) {
          params.light = ProbeLight::all, params.irradiance_degree = 2, params.dering = false;
          params.weights.method = WeightMethod::distance;
        }
        const auto lookup = make_lookup(method, set, source, params);
        list.add(fmt::format("{} {} {}", name_of(method), name_of(layer), other));
        for (const rays::SurfacePoint& p : listed_points())
          list.add(" at", lookup->irradiance(p),
                   lookup->glossy(p, glm::normalize(p.normal + vec3(0.4f, -0.2f, 0.1f)), 0.35f));
      }
    }
  }
  list.expect("libs/probes/tests/expected/light.txt");
}

TEST(LookupList, OfCandidatesIsWhatItWas) {
  const std::vector<vec3> probes = scattered(45, 4, 12);
  NumberList list;
  for (const auto& [spacing, most] : {std::pair(1.7f, 1 << 17), {3.1f, 30}}) {
    const CandidateGrid grid = make_candidate_grid(probes, {{0.4f, 0.1f, -0.3f}, {3.1f, 2.2f, 3.9f}}, spacing,
                                                   static_cast<std::size_t>(most));
    list.add("grid", grid.cells, grid.origin, grid.cell_size, grid.length);
    list.add("reach", probe_reach(grid, probes));
    for (std::size_t cell = 0; cell < grid.lists.size(); cell += 7 * static_cast<std::size_t>(grid.length))
      list.add("cell", std::span(grid.lists).subspan(cell, static_cast<std::size_t>(grid.length)));
  }
  list.expect("libs/probes/tests/expected/candidates.txt");
}

}  // namespace
}  // namespace ssphh::probes
