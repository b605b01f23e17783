#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>

#include <ssphh/core/parallel.h>

#include "draft.h"
#include "relocate.h"
#include "sweep.h"

namespace ssphh::gi {
namespace {

/// Root of i's set; halves paths on the way.
std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

using Neighbours = std::vector<std::vector<std::pair<std::uint32_t, float>>>;

Neighbours neighbours(const std::vector<Draft>& drafts, const std::vector<PlacedEdge>& edges) {
  Neighbours result(drafts.size());
  for (const PlacedEdge& edge : edges) {
    const float length = glm::distance(drafts[edge.a].position, drafts[edge.b].position);
    result[edge.a].emplace_back(edge.b, length);
    result[edge.b].emplace_back(edge.a, length);
  }
  return result;
}

}  // namespace

std::vector<PlacedEdge> link(const PlaceContext& context, const std::vector<Draft>& drafts) {
  float widest = 0;
  for (const Draft& draft : drafts) widest = std::max(widest, draft.spacing);
  NearGrid grid(link_distance * widest);
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
    std::sort(by_distance.begin(), by_distance.end());
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
    const std::size_t largest = *std::max_element(size.begin(), size.end());
    for (std::size_t i = 0; i < drafts.size(); ++i) seen[i] = 10 * size[i] >= largest;
  }
  std::vector<bool> keep(drafts.size());
  for (std::size_t i = 0; i < drafts.size(); ++i) keep[i] = seen[root(parent, i)];
  return keep;
}

void clear_sweeps(const PlaceContext& context, std::vector<Draft>& drafts, PlaceCounts& counts) {
  const Sweep sweep(context.source, context.rules.clearance);
  if (!sweep.any()) return;
  const float clearance = context.rules.clearance;
  std::vector<std::optional<Relocated>> moved(drafts.size());
  std::vector<std::uint8_t> swept(drafts.size(), 0);
  parallel_for(
      drafts.size(), 8,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (drafts[i].kind == PlaceKind::manual || !sweep.passes(drafts[i].position, clearance)) continue;
          swept[i] = 1;
          moved[i] = sidestep(context.source, drafts[i].position, context.rules, 0.5f * drafts[i].spacing,
                              [&](const vec3& p) { return !sweep.passes(p, clearance); });
        }
      },
      context.control);

  std::vector<Draft> kept;
  NearGrid grid(context.spacing);
  const auto keep = [&](const Draft& draft) { grid.add(draft.position), kept.push_back(draft); };
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (swept[i] == 0) keep(drafts[i]);
  }
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (swept[i] == 0) continue;
    const bool useful = moved[i] && grid.near(moved[i]->position, 0.5f * drafts[i].spacing).empty();
    if (!useful) {
      ++counts.swept;
      continue;
    }
    ++counts.relocated;
    drafts[i].position = moved[i]->position;
    drafts[i].site = moved[i]->site;
    keep(drafts[i]);
  }
  drafts = std::move(kept);
}

std::vector<bool> most_spread(const std::vector<Draft>& drafts, const std::vector<PlacedEdge>& edges,
                              std::size_t count) {
  const Neighbours links = neighbours(drafts, edges);
  std::vector<float> distance(drafts.size(), std::numeric_limits<float>::infinity());
  std::vector<bool> chosen(drafts.size(), false);
  std::size_t number = 0;

  // Dijkstra from one more source; stops where another source is nearer already.
  const auto choose = [&](std::size_t source) {
    chosen[source] = true;
    ++number;
    using Entry = std::pair<float, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance[source] = 0;
    queue.emplace(0.0f, source);
    while (!queue.empty()) {
      const auto [d, i] = queue.top();
      queue.pop();
      if (d > distance[i]) continue;
      for (const auto& [j, length] : links[i]) {
        if (d + length >= distance[j]) continue;
        distance[j] = d + length;
        queue.emplace(distance[j], j);
      }
    }
  };
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (drafts[i].kind == PlaceKind::manual) choose(i);
  }
  const auto room = [&](std::size_t i) { return std::min(drafts[i].site.nearest, 1e30f); };
  while (number < std::min(count, drafts.size())) {
    std::size_t best = drafts.size();
    for (std::size_t i = 0; i < drafts.size(); ++i) {
      if (chosen[i]) continue;
      if (best == drafts.size() || distance[i] > distance[best] ||
          (distance[i] == distance[best] && room(i) > room(best))) {
        best = i;
      }
    }
    choose(best);
  }
  return chosen;
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

}  // namespace ssphh::gi
