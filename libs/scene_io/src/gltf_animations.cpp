#include <fmt/format.h>

#include "gltf_names.h"
#include "gltf_parts.h"
#include "printable.h"

namespace ssphh::scene_io {
namespace {

using scene::AnimationChannel;
using scene::AnimationPath;
using scene::Interpolation;

Interpolation import_interpolation(const json::Cursor& sampler) {
  const auto mode = sampler.find("interpolation");
  return mode ? read_word(gltf_interpolations, *mode) : Interpolation::linear;
}

void import_times(GltfDocument& document, const json::Cursor& sampler, AnimationChannel& out) {
  const json::Cursor input = sampler["input"];
  const std::size_t accessors = document.count("accessors");
  out.interpolation = import_interpolation(sampler);
  out.times = read_floats(document, input.index(accessors, "accessors"), 1, 1).values;
  if (out.times.empty()) input.fail("has no keyframes");
  for (std::size_t i = 0; i < out.times.size(); ++i) {
    if (out.times[i] < 0) input.fail(fmt::format("time {} is {} s, before 0", i, out.times[i]));
    if (i > 0 && !(out.times[i] > out.times[i - 1])) input.fail(fmt::format("time {} does not increase", i));
  }
}

void import_keys(GltfDocument& document, const json::Cursor& sampler, AnimationChannel& out) {
  import_times(document, sampler, out);
  const json::Cursor output = sampler["output"];
  const int components = out.path == AnimationPath::rotation ? 4 : 3;
  const FloatArray values =
      read_floats(document, output.index(document.count("accessors"), "accessors"), components, components);
  const std::size_t per_key = out.interpolation == Interpolation::cubic_spline ? 3 : 1;
  if (values.count != out.times.size() * per_key) {
    output.fail(fmt::format("has {} values, {} keyframes need {}", values.count, out.times.size(),
                            out.times.size() * per_key));
  }
  document.charge(values.count * sizeof(vec4), sampler);
  out.values.resize(values.count, vec4(0));
  for (std::size_t i = 0; i < values.count; ++i) {
    for (int c = 0; c < components; ++c) out.values[i][c] = values[i][c];
  }
}

// Weights of morph targets: those of one key stand together, for a cubic spline tangents apart from values.
void import_weights(GltfImport& import, const json::Cursor& sampler, int node, std::size_t targets) {
  GltfDocument& document = import.document;
  AnimationChannel keys;
  import_times(document, sampler, keys);
  const json::Cursor output = sampler["output"];
  const FloatArray values =
      read_floats(document, output.index(document.count("accessors"), "accessors"), 1, 1);
  const std::size_t per_key = keys.interpolation == Interpolation::cubic_spline ? 3 : 1;
  const std::size_t rows = keys.times.size() * per_key;
  if (values.count != rows * targets) {
    output.fail(fmt::format("has {} values, {} keyframes of {} targets need {}", values.count,
                            keys.times.size(), targets, rows * targets));
  }
  document.charge(targets * (sizeof keys + keys.times.size() * sizeof(float) + rows * sizeof(vec4)), sampler);
  auto& channels = import.weight_keys[node];
  channels.assign(targets, keys);
  for (std::size_t k = 0; k < targets; ++k) {
    channels[k].node = static_cast<int>(k);
    for (std::size_t row = 0; row < rows; ++row)
      channels[k].values.emplace_back(values.values[row * targets + k], 0, 0, 0);
  }
}

// Of the mesh at a node; 0 where there is none.
std::size_t target_count(const GltfDocument& document, int file_node) {
  const auto mesh = document.reference(document.item("nodes", file_node), "mesh", "meshes");
  if (!mesh) return 0;
  const json::Cursor primitives = document.item("meshes", *mesh)["primitives"];
  return primitives.size() == 0 ? 0 : primitives[std::size_t{0}].size_of("targets");
}

// nullopt for what is ignored and listed, and for weights, which go to `import`.
std::optional<AnimationChannel> import_channel(GltfImport& import, const json::Cursor& animation,
                                               const json::Cursor& channel) {
  GltfDocument& document = import.document;
  const json::Cursor target = channel["target"];
  const json::Cursor samplers = animation["samplers"];
  const int sampler = channel["sampler"].index(samplers.size(), "samplers");
  const std::string& path = target["path"].text();
  const auto file_node = document.reference(target, "node", "nodes");
  const std::size_t targets = path == "weights" && file_node ? target_count(document, *file_node) : 0;
  AnimationChannel out;
  if (const auto known = value_in(gltf_animation_paths, path)) {
    out.path = *known;
  } else if (targets == 0) {
    document.ignored.add(fmt::format("animation of {}", printable(path, 40)));
    return std::nullopt;
  }
  if (!file_node) {
    document.ignored.add("animation without a node");
    return std::nullopt;
  }
  out.node = import.node_of_node[*file_node];
  if (out.node < 0) {
    document.ignored.add("animation of a node outside the scene");
    return std::nullopt;
  }
  if (targets > 0) {
    import_weights(import, samplers[sampler], out.node, targets);
    return std::nullopt;
  }
  if (import.scene.nodes[out.node].matrix) {
    document.ignored.add("animation of a node that has a matrix");
    return std::nullopt;
  }
  import_keys(document, samplers[sampler], out);
  return out;
}

}  // namespace

void import_animations(GltfImport& import) {
  std::size_t count = 0;
  for (const json::Cursor& animation : import.document.items("animations")) {
    scene::Animation out;
    out.name = animation.text_or("name", fmt::format("animation {}", count++));
    for (const json::Cursor& place : json::elements(animation["channels"])) {
      auto channel = import_channel(import, animation, place);
      if (!channel) continue;
      import.scene.nodes[channel->node].movable = true;
      out.channels.push_back(*std::move(channel));
    }
    if (!out.channels.empty()) import.scene.animations.push_back(std::move(out));
  }
  for (auto& node : import.scene.nodes) {  // parents stand before children
    if (node.parent >= 0 && import.scene.nodes[node.parent].movable) node.movable = true;
  }
}

}  // namespace ssphh::scene_io
