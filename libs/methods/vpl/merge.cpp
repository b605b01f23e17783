#include <algorithm>
#include <queue>

#include "light_tree.h"

namespace ssphh::methods::vpl {
namespace {

struct Part {
  float cost;
  int node;
  friend bool operator<(const Part& a, const Part& b) {
    return a.cost < b.cost || (a.cost == b.cost && a.node < b.node);
  }
};

}  // namespace

std::vector<Vpl> merge_lights(std::span<const Vpl> lights, std::size_t most) {
  if (lights.size() <= most) return {lights.begin(), lights.end()};
  if (most == 0) return {};
  const std::vector<LightNode> tree = build_light_tree(lights);
  const auto node_at = [&](int i) -> const LightNode& { return tree[i]; };
  const float radius = tree.back().cluster.bounds.radius();
  // A quarter of the scene's size counts as much as a turn by one radian, as in the tree itself.
  const auto part = [&](int i) {
    const LightNode& n = node_at(i);
    const float extent = n.cluster.bounds.radius() + 0.25f * radius * n.cluster.spread;
    return Part{n.left < 0 ? -1 : luminance(n.cluster.power) * extent, i};
  };
  std::priority_queue<Part> cut;
  cut.push(part(static_cast<int>(tree.size()) - 1));
  // Fewer than there are lights: the top always can be split.
  while (cut.size() < most) {
    const LightNode& split = node_at(cut.top().node);
    cut.pop();
    cut.push(part(split.left)), cut.push(part(split.right));
  }
  std::vector<int> nodes;
  for (; !cut.empty(); cut.pop()) nodes.push_back(cut.top().node);
  std::ranges::sort(nodes, {}, [&](int i) { return node_at(i).light; });
  std::vector<Vpl> merged;
  for (const int i : nodes) {
    merged.push_back(lights[node_at(i).light]);
    merged.back().power = node_at(i).cluster.power;
  }
  return merged;
}

}  // namespace ssphh::methods::vpl
