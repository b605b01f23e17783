/// Meshes of skins and morph targets in the shape that a time gives them.

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/scene/query.h>

#include "gltf_parts.h"

namespace ssphh::scene_io {
namespace {

using scene::AnimationChannel;

struct Posed {
  GltfImport& import;
  float time;
  std::vector<mat4> world;                         // of the scene's nodes
  std::vector<std::size_t> users;                  // instances of each mesh
  std::map<std::pair<int, int>, int> places = {};  // of node and parent, so that primitives share one
  std::size_t moving = 0;
};

json::Cursor file_mesh(const GltfImport& import, const json::Cursor& file_node) {
  return import.document.item("meshes", *import.document.reference(file_node, "mesh", "meshes"));
}

// Weights of the node, else of its mesh, else 0; keys go before all of them. A primitive may have fewer
// targets than the first one, which the file's weights are for.
std::vector<float> weights_at(const Posed& posed, const BentInstance& bent, int node, std::size_t count) {
  std::vector<float> weights(count, 0);
  auto list = bent.file_node.find("weights");
  if (!list) list = file_mesh(posed.import, bent.file_node).find("weights");
  if (list) {
    if (list->size() < count)
      list->fail(fmt::format("has {} weights, the mesh has {} targets", list->size(), count));
    for (std::size_t k = 0; k < count; ++k) weights[k] = (*list)[k].number();
  }
  const auto keys = posed.import.weight_keys.find(node);
  if (keys == posed.import.weight_keys.end()) return weights;
  // Each weight is the x of a node of its own
  scene::Scene curves;
  curves.nodes.resize(std::max(count, keys->second.size()));
  curves.animations.push_back({"", keys->second});
  const auto at = scene::world_matrices(curves, posed.time);
  for (std::size_t k = 0; k < std::min(count, keys->second.size()); ++k) weights[k] = at[k][3].x;
  return weights;
}

struct Skin {
  std::vector<mat4> joints;  // from the mesh to the world
  bool moves = false;
};

// nullopt for what is ignored and listed.
std::optional<Skin> skin_of(Posed& posed, const BentInstance& bent) {
  GltfDocument& document = posed.import.document;
  const auto index = document.reference(bent.file_node, "skin", "skins");
  if (!index) return std::nullopt;
  if (extension(bent.file_node, "EXT_mesh_gpu_instancing")) {
    document.ignored.add("skin of instances");
    return std::nullopt;
  }
  const json::Cursor skin = document.item("skins", *index), list = skin["joints"];
  const std::size_t count = list.size(1);
  document.charge(count * sizeof(mat4), skin);
  Skin out;
  out.joints.assign(count, mat4(1));
  if (const auto inverse = document.reference(skin, "inverseBindMatrices", "accessors")) {
    const FloatArray matrices = read_floats(document, *inverse, 16, 16);
    if (matrices.count < count)
      skin["inverseBindMatrices"].fail(
          fmt::format("has {} matrices, the skin {} joints", matrices.count, count));
    for (std::size_t j = 0; j < count; ++j) {
      for (int c = 0; c < 16; ++c) out.joints[j][c / 4][c % 4] = matrices[j][c];
    }
  }
  for (std::size_t j = 0; j < count; ++j) {
    const int joint = posed.import.node_of_node[list[j].index(document.count("nodes"), "nodes")];
    if (joint < 0) {
      document.ignored.add("skin with joints outside the scene");
      return std::nullopt;
    }
    out.joints[j] = posed.world[joint] * out.joints[j];
    out.moves |= posed.import.scene.nodes[joint].movable;
  }
  return out;
}

// A node of the instance's own, without a transform.
int add_place(Posed& posed, int node, int parent) {
  const auto [place, is_new] = posed.places.try_emplace({node, parent}, -1);
  if (is_new) {
    auto& nodes = posed.import.scene.nodes;
    place->second = static_cast<int>(nodes.size());
    scene::Node own;
    own.name = nodes[node].name;
    own.parent = parent;
    nodes.push_back(std::move(own));
  }
  return place->second;
}

// What changes its shape over time counts as moving: a channel says so that keeps the node where it is.
void mark_moving(Posed& posed, int node, float end) {
  auto& scene = posed.import.scene;
  if (scene.nodes[node].movable) return;
  AnimationChannel channel;
  channel.node = node;
  channel.interpolation = scene::Interpolation::step;
  channel.times = end > 0 ? std::vector<float>{0, end} : std::vector<float>{0};
  channel.values.assign(channel.times.size(), vec4(0));
  scene.animations.push_back({"shape of " + scene.nodes[node].name, {channel}});
  scene.nodes[node].movable = true;
}

void pose(Posed& posed, const BentInstance& bent) {
  GltfImport& import = posed.import;
  scene::Scene& scene = import.scene;
  const int node = scene.instances[bent.instance].node;
  const auto original = static_cast<std::size_t>(scene.instances[bent.instance].mesh);
  const MeshShape& shape = import.shapes.at(static_cast<int>(original));
  const auto keys = import.weight_keys.find(node);
  const bool morphs = !shape.targets.empty() && keys != import.weight_keys.end();
  const auto skin = shape.influences.empty() ? std::nullopt : skin_of(posed, bent);
  if (shape.targets.empty() && !skin) return;

  // The last that uses a mesh may change it
  std::size_t mesh = original;
  if (posed.users[original]-- > 1) {
    import.document.charge(scene.meshes[original].positions.size() * 2 * sizeof(vec4), bent.file_node);
    mesh = scene.meshes.size();
    scene.meshes.push_back(scene::Mesh(scene.meshes[original]));
    scene.instances[bent.instance].mesh = static_cast<int>(mesh);
  }
  if (!shape.targets.empty())
    blend(scene.meshes[mesh], shape.targets, weights_at(posed, bent, node, shape.targets.size()));
  if (skin) {
    if (const auto wrong = bend(scene.meshes[mesh], shape.influences, skin->joints))
      bent.file_node.fail(fmt::format("vertex {} names a joint that its skin of {} joints lacks", *wrong,
                                      skin->joints.size()));
  }
  if (!skin && !morphs) return;
  // Joints are in the world: the mesh's own node no longer counts
  const int place = add_place(posed, node, skin ? -1 : node);
  scene.instances[bent.instance].node = place;
  if (!morphs && !(skin && skin->moves)) return;
  mark_moving(posed, place, morphs ? keys->second.front().times.back() : 0);
  ++posed.moving;
}

}  // namespace

void pose_meshes(GltfImport& import, float time) {
  if (import.bent.empty()) return;
  Posed posed{import, time, scene::world_matrices(import.scene, time),
              std::vector<std::size_t>(import.scene.meshes.size(), 0)};
  for (const auto& instance : import.scene.instances) ++posed.users[instance.mesh];
  for (const BentInstance& bent : import.bent) pose(posed, bent);
  if (posed.moving > 0) {
    log_warning(
        "{}: {} of its meshes change shape over time (skins, morph targets): they have that of {:g} s "
        "(--time) and "
        "keep it while time goes on",
        import.document.path().string(), posed.moving, time);
  }
}

}  // namespace ssphh::scene_io
