#include <optional>

#include <glm/gtc/type_ptr.hpp>

#include <ssphh/scene/query.h>

#include "gltf_export_parts.h"

namespace ssphh::scene_io {
namespace {

using scene::Instance;
using scene::Mesh;

/// What stands at one node of the scene.
struct Contents {
  std::vector<std::pair<std::string, std::vector<const Instance*>>> instances;  ///< by their light_group
  std::vector<const scene::Camera*> cameras;
  std::vector<const scene::Light*> lights;
  std::vector<const scene::Sphl*> sphls;
};

void add_instance(Contents& contents, const Instance& instance) {
  for (auto& [group, members] : contents.instances) {
    if (group == instance.light_group) return members.push_back(&instance);
  }
  contents.instances.push_back({instance.light_group, {&instance}});
}

/// Attributes and indices of a mesh, without its material.
json::Value export_primitive(GltfExport& out, const Mesh& mesh) {
  constexpr int target = 34962;
  const auto floats = [](const auto& array, int components) {
    return std::span(&array.front().x, array.size() * static_cast<std::size_t>(components));
  };
  json::Value attributes;
  attributes["POSITION"] = add_float_accessor(out, floats(mesh.positions, 3), 3, true, target);
  if (!mesh.normals.empty())
    attributes["NORMAL"] = add_float_accessor(out, floats(mesh.normals, 3), 3, false, target);
  if (!mesh.tangents.empty()) {
    attributes["TANGENT"] = add_float_accessor(out, floats(mesh.tangents, 4), 4, false, target);
  }
  const auto& [uv0, uv1] = mesh.uvs;
  if (!uv0.empty()) {
    attributes["TEXCOORD_0"] = add_float_accessor(out, floats(uv0, 2), 2, false, target);
  } else if (!uv1.empty()) {
    // Sets are numbered without gaps.
    const std::vector<vec2> zeros(mesh.positions.size(), vec2(0));
    attributes["TEXCOORD_0"] = add_float_accessor(out, floats(zeros, 2), 2, false, target);
  }
  if (!uv1.empty()) attributes["TEXCOORD_1"] = add_float_accessor(out, floats(uv1, 2), 2, false, target);
  if (!mesh.colors.empty())
    attributes["COLOR_0"] = add_float_accessor(out, floats(mesh.colors, 4), 4, false, target);
  return {{"attributes", std::move(attributes)},
          {"indices", add_index_accessor(out, mesh.triangles, mesh.positions.size())}};
}

/// Makes glTF meshes; the same list of (mesh, material) is written once, and so are the arrays of each mesh.
class MeshExport {
 public:
  explicit MeshExport(GltfExport& out) : out_(out) {}

  /// Index of the glTF mesh; empty when none of the instances has triangles.
  std::optional<int> index(const std::vector<const Instance*>& instances) {
    std::vector<std::pair<int, int>> key;
    for (const Instance* instance : instances) {
      if (out_.scene.meshes[instance->mesh].triangles.empty()) continue;
      const int material = scene::instance_material(out_.scene, *instance);
      key.emplace_back(instance->mesh, export_material_index(out_, material));
    }
    if (key.empty()) return std::nullopt;
    const auto known = meshes_.find(key);
    if (known != meshes_.end()) return known->second;
    json::Value mesh, primitives = json::Value::array();
    const std::string& name = out_.scene.meshes[key.front().first].name;
    if (!name.empty()) mesh["name"] = name;
    for (const auto& [scene_mesh, material] : key) {
      json::Value part = primitive(scene_mesh);
      part["material"] = material;
      primitives.push_back(std::move(part));
    }
    mesh["primitives"] = std::move(primitives);
    return meshes_[key] = push(out_.meshes, std::move(mesh));
  }

 private:
  json::Value primitive(int mesh) {
    const auto known = primitives_.find(mesh);
    if (known != primitives_.end()) return known->second;
    return primitives_[mesh] = export_primitive(out_, out_.scene.meshes[mesh]);
  }

  GltfExport& out_;
  std::map<std::vector<std::pair<int, int>>, int> meshes_;
  std::map<int, json::Value> primitives_;
};

void export_transform(const scene::Node& node, json::Value& json) {
  if (node.matrix) {
    if (*node.matrix != mat4(1)) json["matrix"] = numbers(std::span(glm::value_ptr(*node.matrix), 16));
    return;
  }
  const scene::Transform& t = node.local;
  if (t.translation != vec3(0)) json["translation"] = numbers(t.translation);
  if (t.rotation != quat(1, 0, 0, 0)) {
    const vec4 q(t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w);
    json["rotation"] = numbers(std::span(&q.x, 4));
  }
  if (t.scale != vec3(1)) json["scale"] = numbers(t.scale);
}

json::Value export_sphl(const scene::Sphl& sphl, const std::string& node_name) {
  json::Value out = json::Value::object();
  if (sphl.name != node_name) out["name"] = sphl.name;
  out["radius"] = number(sphl.radius);
  if (!sphl.enabled) out["enabled"] = false;
  return out;
}

/// Writes the k-th of each kind of contents into a node. Returns whether there was any.
bool export_contents(GltfExport& out, MeshExport& meshes, const Contents& contents, std::size_t k,
                     const std::string& name, json::Value& json) {
  bool any = false;
  if (k < contents.instances.size()) {
    const auto& [group, instances] = contents.instances[k];
    if (const auto mesh = meshes.index(instances)) json["mesh"] = *mesh;
    if (!group.empty()) json["extras"]["light_group"] = group;
    any = true;
  }
  if (k < contents.cameras.size()) {
    json["camera"] = push(out.cameras, export_camera(*contents.cameras[k]));
    any = true;
  }
  if (k < contents.lights.size()) {
    const scene::Light& light = *contents.lights[k];
    if (light.has_profile()) {
      add_extension(out, json, "EXT_lights_ies", export_profile_light(out, light, name));
    } else {
      add_extension(out, json, "KHR_lights_punctual", {{"light", push(out.lights, export_light(light))}});
    }
    any = true;
  }
  if (k < contents.sphls.size()) {
    json["extras"]["sphl"] = export_sphl(*contents.sphls[k], name);
    any = true;
  } else if (name.starts_with("SPHL")) {
    json["extras"]["sphl"] = false;
  }
  return any;
}

}  // namespace

json::Value export_nodes(GltfExport& out) {
  // Sort what there is by node; what stands at none comes last.
  const scene::Scene& scene = out.scene;
  const std::size_t count = scene.nodes.size();
  std::vector<Contents> contents(count + 1);
  const auto at = [&](int node) -> Contents& {
    return contents[node < 0 ? count : static_cast<std::size_t>(node)];
  };
  for (const Instance& instance : scene.instances) add_instance(at(instance.node), instance);
  for (const scene::Camera& camera : scene.cameras) at(camera.node).cameras.push_back(&camera);
  for (const scene::Light& light : scene.lights) at(light.node).lights.push_back(&light);
  for (const scene::Sphl& sphl : scene.sphls) at(sphl.node).sphls.push_back(&sphl);

  // The scene's nodes keep their indices, with the first of each kind.
  MeshExport meshes(out);
  json::Value roots = json::Value::array();
  std::vector<json::Value> children(count, json::Value::array());
  for (std::size_t i = 0; i < count; ++i) {
    const scene::Node& node = scene.nodes[i];
    json::Value json = json::Value::object();
    if (!node.name.empty()) json["name"] = node.name;
    export_transform(node, json);
    export_contents(out, meshes, contents[i], 0, node.name, json);
    push(node.parent < 0 ? roots : children[node.parent], i);
    out.nodes.push_back(std::move(json));
  }
  // Further ones stand on nodes of their own, of the same name: it is the default light group.
  for (std::size_t i = 0; i <= count; ++i) {
    const std::string name = i < count ? scene.nodes[i].name : "root";
    for (std::size_t k = i < count ? 1 : 0;; ++k) {
      json::Value json = json::Value::object();
      if (!name.empty()) json["name"] = name;
      if (!export_contents(out, meshes, contents[i], k, name, json)) break;
      push(i < count ? children[i] : roots, push(out.nodes, std::move(json)));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!children[i].empty()) out.nodes[i]["children"] = std::move(children[i]);
  }
  return roots;
}

}  // namespace ssphh::scene_io
