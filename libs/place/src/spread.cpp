#include <algorithm>
#include <functional>
#include <limits>
#include <queue>

#include "draft.h"

namespace ssphh::place {
namespace {

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
  const auto room = [&](std::size_t i) { return drafts[i].site.nearest; };
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

}  // namespace ssphh::place
