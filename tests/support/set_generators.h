#pragma once
/// Random probe sets for the properties of this module: their sizes shrink, what is in them is drawn anew.

#include <numeric>

#include <ssphh/probes/hier.h>

#include "generators.h"
#include "random_set.h"

namespace ssphh::test {

inline std::string describe(const probes::HierParams& p) {
  return std::string(name_of(p.op)) + ", N' " + std::to_string(p.neighbors) + ", P > " +
         test::describe(p.threshold);
}

}  // namespace ssphh::test

namespace ssphh::test {

struct SetShape {
  int probes, degree, groups, matrices;
  std::uint64_t seed;

  probes::ProbeSet make() const { return random_set(seed, probes, degree, groups, matrices > 0); }
};

inline Generator<SetShape> set_shapes(int fewest_probes, int most_probes, int most_degree = 4) {
  const Generator<int> probes = integers(fewest_probes, most_probes), degree = integers(0, most_degree),
                       groups = integers(1, 3), matrices = integers(0, 1);
  return {[=](Pcg32& random) {
            SetShape s{};
            s.probes = probes.draw(random), s.degree = degree.draw(random);
            s.groups = groups.draw(random), s.matrices = matrices.draw(random);
            s.seed = random.next();
            return s;
          },
          [=](const SetShape& s) {
            std::vector<SetShape> result;
            const auto add = [&](const Generator<int>& part, int SetShape::*field) {
              for (const int n : part.simpler(s.*field)) result.emplace_back(s).*field = n;
            };
            add(probes, &SetShape::probes), add(degree, &SetShape::degree);
            add(groups, &SetShape::groups), add(matrices, &SetShape::matrices);
            return result;
          }};
}

inline std::string describe(const SetShape& s) {
  return "{" + std::to_string(s.probes) + " probes of degree " + std::to_string(s.degree) + ", " +
         std::to_string(s.groups) + " groups" + (s.matrices > 0 ? ", matrices" : "") + ", seed " +
         std::to_string(s.seed) + "}";
}

/// order[new place] = old place.
inline std::vector<std::size_t> random_order(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Pcg32 random(seed);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.next() % i]);
  return order;
}

/// The same probes in another order.
inline probes::ProbeSet permuted(const probes::ProbeSet& set, const std::vector<std::size_t>& order) {
  probes::ProbeSet result = set;
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < order.size(); ++i) {
    probes::Probe& probe = result.probes[i] = set.probes[order[i]];
    for (probes::Edge& edge : probe.edges) edge.from = place[edge.from];
    std::sort(probe.edges.begin(), probe.edges.end(),
              [](const probes::Edge& a, const probes::Edge& b) { return a.from < b.from; });
  }
  return result;
}

inline Generator<probes::HierParams> hier_params() {
  using probes::HierOperator;
  const auto op = one_of<probes::HierOperator>(
      {probes::HierOperator::coefficient, probes::HierOperator::mean, probes::HierOperator::matrix});
  const Generator<int> neighbors = integers(-1, 6);
  const Generator<float> threshold = floats(0, 1);
  return {[=](Pcg32& random) {
            const probes::HierOperator chosen = op.draw(random);
            const int count = neighbors.draw(random);
            return probes::HierParams{chosen, count, threshold.draw(random)};
          },
          [=](const probes::HierParams& p) {
            std::vector<probes::HierParams> result;
            for (const probes::HierOperator o : op.simpler(p.op)) result.emplace_back(p).op = o;
            for (const int n : neighbors.simpler(p.neighbors)) result.emplace_back(p).neighbors = n;
            for (const float t : threshold.simpler(p.threshold)) result.emplace_back(p).threshold = t;
            return result;
          }};
}
/// Matrices only where the set has them.
inline probes::HierParams fitting(probes::HierParams params, const SetShape& shape) {
  if (params.op == probes::HierOperator::matrix && shape.matrices == 0)
    params.op = probes::HierOperator::mean;
  return params;
}

}  // namespace ssphh::test
