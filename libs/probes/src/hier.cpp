#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include <ssphh/core/math.h>
#include <ssphh/core/parallel.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_limits.h>

namespace ssphh::probes {
namespace {

bool stronger(const Edge& a, const Edge& b) {
  return a.transfer != b.transfer ? a.transfer > b.transfer : a.from < b.from;
}

/// Puts the chosen edges' indices into `order`, strongest first.
void select(const Probe& probe, const HierParams& params, std::vector<int>& order) {
  order.clear();
  for (std::size_t e = 0; e < probe.edges.size(); ++e) {
    if (probe.edges[e].transfer > params.threshold) order.push_back(static_cast<int>(e));
  }
  const std::size_t count = params.neighbors < 0
                                ? order.size()
                                : std::min(order.size(), static_cast<std::size_t>(params.neighbors));
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](int a, int b) { return stronger(probe.edges[a], probe.edges[b]); });
  order.resize(count);
}

/// Sum over the chosen neighbours, strongest first: these are left in `order`.
void gather(const ProbeSet& set, const HierParams& params, std::size_t i, std::vector<int>& order,
            sh::RadianceSh& neighbor, sh::RadianceSh& sum) {
  const Probe& probe = set.probes[i];
  select(probe, params, order);
  const auto k = static_cast<std::size_t>(sh::coefficient_count(set.degree));
  neighbor.values.assign(k, vec3(0));
  for (const int e : order) {
    const Edge& edge = probe.edges[e];
    const sh::RadianceSh& source = set.probes[edge.from].self;
    add_neighbor(neighbor, edge, source, params.op);
  }
  sum.values.assign(probe.self.values.begin(), probe.self.values.end());
  sum += neighbor;
}

void check(const ProbeSet& set, const HierParams& params) {
  if (params.neighbors < -1) throw Error("neighbors", "must be -1 (all) or a count");
  if (!(params.threshold >= 0 && params.threshold <= limits::coefficient))
    throw Error("threshold", "must be a number from 0 up, as P is");
  sh::require_degree(set.degree, "probe set");
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    const Probe& probe = set.probes[i];
    const auto count = static_cast<std::size_t>(sh::coefficient_count(set.degree));
    const auto needs = [i](bool good, const char* problem, const char* hint = "") {
      if (!good) throw Error(fmt::format("probe {}", i), problem, hint);
    };
    needs(probe.self.values.size() == count, "its light is not of the set's degree", "call merge_groups");
    for (const Edge& edge : probe.edges) {
      needs(edge.from >= 0 && static_cast<std::size_t>(edge.from) < set.probes.size(),
            "an edge comes from no probe");
      needs(edge.h.values.size() == count, "an edge is not of the set's degree");
      if (params.op != HierOperator::matrix) continue;
      if (edge.matrix.values.empty())
        throw Error("operator matrix", "the probes were baked without transfer matrices",
                    "bake with --viz-transfer");
      needs(edge.matrix.arriving_degree == set.degree && edge.matrix.emitted_degree == set.degree &&
                edge.matrix.values.size() == count * count,
            "an edge's matrix is not of the set's degree");
    }
  }
}

}  // namespace

std::vector<int> select_neighbors(const Probe& probe, const HierParams& params) {
  std::vector<int> order;
  select(probe, params, order);
  return order;
}

void add_neighbor(sh::RadianceSh& sum, const Edge& edge, const sh::RadianceSh& source, HierOperator op) {
  if (op == HierOperator::coefficient) sh::add_coefficient_product(sum, edge.h, source);
  if (op == HierOperator::raw) sh::add_raw_product(sum, edge.h, source);
  if (op == HierOperator::mean) sh::add_mean_product(sum, edge.h, source);
  if (op == HierOperator::matrix) sh::add_matrix_product(sum, edge.matrix, source);
}

std::size_t hier(ProbeSet& set, const HierParams& params) {
  check(set, params);
  if (!set.hierarchy) set.hierarchy.emplace();
  Hierarchy& hierarchy = *set.hierarchy;
  hierarchy.op = params.op;
  hierarchy.neighbors = params.neighbors;
  hierarchy.threshold = params.threshold;
  hierarchy.neighbor.resize(set.probes.size());
  hierarchy.sum.resize(set.probes.size());

  std::atomic<std::size_t> used = 0;
  const auto range = [&](std::size_t begin, std::size_t end) {
    std::vector<int> order;
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      gather(set, params, i, order, hierarchy.neighbor[i], hierarchy.sum[i]);
      count += order.size();
    }
    used += count;
  };
  // A few probes take microseconds: less than it takes to wake other threads.
  constexpr std::size_t grain = 32;
  if (set.probes.size() <= grain) {
    range(0, set.probes.size());
  } else {
    parallel_for(set.probes.size(), grain, range);
  }
  return used;
}

std::optional<Contraction> hier_contraction(const ProbeSet& set, const HierParams& params) {
  if (params.op != HierOperator::mean) return std::nullopt;
  check(set, params);
  struct Factor {
    std::size_t row, from;
    double factor;
  };
  std::vector<Factor> factors;
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    for (const int e : select_neighbors(set.probes[i], params)) {
      const Edge& edge = set.probes[i].edges[e];
      factors.push_back(
          {i, static_cast<std::size_t>(edge.from), double(std::max(0.0f, max_component(sh::mean(edge.h))))});
    }
  }
  return contraction(set.probes.size(), [&](std::span<const double> x, std::span<double> y) {
    std::ranges::fill(y, 0.0);
    for (const Factor& f : factors) y[f.row] += f.factor * x[f.from];
  });
}

}  // namespace ssphh::probes
