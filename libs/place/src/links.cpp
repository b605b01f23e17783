#include <algorithm>
#include <numeric>

#include <ssphh/core/parallel.h>

#include "draft.h"

namespace ssphh::place {
namespace {

/// Root of i's set; halves paths on the way.
std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

std::vector<PlacedEdge> link(const PlaceContext& context, const std::vector<Draft>& drafts) {
  float widest = 0;
  for (const Draft& draft : drafts) widest = std::max(widest, draft.spacing);
  geometry::NearGrid grid(link_distance * widest);
  for (const Draft& draft : drafts) grid.add(draft.position);

  std::vector<std::vector<PlacedEdge>> by_probe(drafts.size());
  parallel_for(
      drafts.size(), 16,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          for (const std::uint32_t j : grid.near(drafts[i].position, link_distance * widest)) {
            if (j <= i) continue;
            const float limit = link_distance * 0.5f * (drafts[i].spacing + drafts[j].spacing);
            if (glm::distance(drafts[i].position, drafts[j].position) > limit) continue;
            if (sees(context.source, drafts[i].position, drafts[j].position)) {
              by_probe[i].push_back({static_cast<std::uint32_t>(i), j, false});
            }
          }
        }
      },
      context.control);
  std::vector<PlacedEdge> edges;
  for (const auto& list : by_probe) edges.insert(edges.end(), list.begin(), list.end());
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
