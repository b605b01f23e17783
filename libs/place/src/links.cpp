#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <ssphh/core/parallel.h>

#include "draft.h"

namespace ssphh::place {
namespace {

/// Root of i's set; halves paths on the way.
std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Drafts whose spacing is alike: those of a plain reach so far that no grid of cells suits them and those
/// of its houses.
struct Scale {
  float widest = 0;                   ///< spacing
  std::vector<std::uint32_t> drafts;  ///< ascending
};

std::vector<Scale> by_scale(const std::vector<Draft>& drafts) {
  std::map<int, Scale> scales;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    Scale& scale = scales[std::ilogb(drafts[i].spacing)];
    scale.widest = std::max(scale.widest, drafts[i].spacing);
    scale.drafts.push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<Scale> result;
  for (auto& [exponent, scale] : scales) result.push_back(std::move(scale));
  return result;
}

}  // namespace

std::vector<PlacedEdge> link(const PlaceContext& context, const std::vector<Draft>& drafts) {
  const std::vector<Scale> scales = by_scale(drafts);
  std::vector<std::vector<PlacedEdge>> by_probe(drafts.size());
  for (const Scale& wide : scales) {
    for (const Scale& narrow : scales) {
      if (narrow.widest > wide.widest) continue;
      const float most = link_distance * 0.5f * (wide.widest + narrow.widest);
      geometry::NearGrid grid(most);
      for (const std::uint32_t j : narrow.drafts) grid.add(drafts[j].position);
      parallel_for(
          wide.drafts.size(), 16,
          [&](std::size_t k) {
            const std::uint32_t i = wide.drafts[k];
            for (const std::uint32_t found : grid.near(drafts[i].position, most)) {
              const std::uint32_t j = narrow.drafts[found];
              if (&wide == &narrow && j <= i) continue;
              const float limit = link_distance * 0.5f * (drafts[i].spacing + drafts[j].spacing);
              if (glm::distance(drafts[i].position, drafts[j].position) > limit) continue;
              const auto [a, b] = std::minmax(i, j);
              if (sees(context.source, drafts[a].position, drafts[b].position))
                by_probe[i].push_back({a, b, false});
            }
          },
          context.control);
    }
  }
  std::vector<PlacedEdge> edges;
  for (const auto& list : by_probe) edges.insert(edges.end(), list.begin(), list.end());
  std::ranges::sort(edges, {}, [](const PlacedEdge& edge) { return std::pair(edge.a, edge.b); });
  return edges;
}

std::vector<bool> reachable(const PlaceContext& context, const std::vector<Draft>& drafts,
                            const std::vector<PlacedEdge>& edges) {
  // Components of the graph.
  std::vector<std::size_t> parent(drafts.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (const PlacedEdge& edge : edges) {
    const std::size_t a = root(parent, edge.a), b = root(parent, edge.b);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::size_t> size(drafts.size(), 0);
  for (std::size_t i = 0; i < drafts.size(); ++i) ++size[root(parent, i)];

  // Those that somebody sees: the probes around a place of interest, or else the nearest that sees it.
  std::vector<bool> seen(drafts.size(), false);
  bool any = false;
  const auto mark = [&](std::size_t i) { seen[root(parent, i)] = any = true; };
  for (const vec3& place : context.params.interest) {
    std::vector<std::pair<float, std::size_t>> by_distance;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
      by_distance.emplace_back(glm::distance(drafts[i].position, place), i);
    }
    std::ranges::sort(by_distance);
    bool found = false;
    for (const auto& [distance, i] : by_distance) {
      if (found && distance > link_distance * context.spacing) break;
      // A manual probe stands for itself, and leads nowhere if it is far from all others.
      if (drafts[i].kind == PlaceKind::manual || !sees(context.source, place, drafts[i].position)) continue;
      mark(i);
      found = true;
    }
  }
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (drafts[i].site.emitter || drafts[i].kind == PlaceKind::manual) mark(i);
  }
  if (!any) {
    const std::size_t largest = *std::ranges::max_element(size);
    for (std::size_t i = 0; i < drafts.size(); ++i) seen[i] = 10 * size[i] >= largest;
  }
  std::vector<bool> keep(drafts.size());
  for (std::size_t i = 0; i < drafts.size(); ++i) keep[i] = seen[root(parent, i)];
  return keep;
}

void filter(std::vector<Draft>& drafts, std::vector<PlacedEdge>& edges, const std::vector<bool>& keep) {
  std::vector<std::uint32_t> index(drafts.size(), 0);
  std::vector<Draft> kept;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    index[i] = static_cast<std::uint32_t>(kept.size());
    if (keep[i]) kept.push_back(std::move(drafts[i]));
  }
  std::vector<PlacedEdge> kept_edges;
  for (const PlacedEdge& edge : edges) {
    if (keep[edge.a] && keep[edge.b]) kept_edges.push_back({index[edge.a], index[edge.b], edge.moving});
  }
  drafts = std::move(kept);
  edges = std::move(kept_edges);
}

}  // namespace ssphh::place
