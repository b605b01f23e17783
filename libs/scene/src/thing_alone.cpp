#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/error.h>
#include <ssphh/core/require.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/thing_alone.h>

namespace ssphh::scene {
namespace {

constexpr std::size_t most_names = 40;

/// Of each node, whether it is `node` or below it.
std::vector<bool> below(const Scene& scene, int node) {
  std::vector<bool> is(scene.nodes.size(), false);
  for (std::size_t i = 0; i < is.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    is[i] = static_cast<int>(i) == node || (parent >= 0 && is[parent]);
  }
  return is;
}

/// Names of nodes that carry something.
std::vector<std::string> names_of_things(const Scene& scene) {
  std::vector<bool> carries(scene.nodes.size(), false);
  const auto mark = [&](int node) {
    for (; node >= 0; node = scene.nodes[node].parent) carries[node] = true;
  };
  for (const Instance& instance : scene.instances) mark(instance.node);
  for (const Light& light : scene.lights) mark(light.node);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const std::string& name = scene.nodes[i].name;
    if (carries[i] && !name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  if (names.size() > most_names) names.resize(most_names), names.emplace_back("...");
  return names;
}

}  // namespace

int find_node(const Scene& scene, const std::string& name) {
  int found = -1, count = 0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].name == name) found = static_cast<int>(i), ++count;
  }
  if (count == 1) return found;
  throw Error(fmt::format("node \"{}\"", name),
              count == 0 ? std::string("the scene has none of that name")
                         : fmt::format("{} nodes have that name", count),
              fmt::format("there are: {}", fmt::join(names_of_things(scene), ", ")));
}

Scene thing_alone(Scene scene, int node) {
  check_indices(scene);
  require(node >= 0 && node < static_cast<int>(scene.nodes.size()), "thing", "the scene has no such node");
  const std::vector<bool> belongs = below(scene, node);
  const auto is_other = [&](int at) { return at < 0 || !belongs[at]; };
  std::erase_if(scene.instances, [&](const Instance& instance) { return is_other(instance.node); });
  std::erase_if(scene.lights, [&](const Light& light) {
    return is_other(light.node) || light.type == LightType::directional;
  });
  scene.environment.reset();
  scene.light_modes.clear();
  scene.dark_groups.clear();
  scene.cameras.clear();
  scene.sphls.clear();
  return scene;
}

}  // namespace ssphh::scene
