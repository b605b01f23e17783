#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "gltf_parts.h"
#include "printable.h"

namespace ssphh::scene_io {
namespace {

using scene::Node;

struct Visit {
  int node;          // of the file
  int parent;        // of the scene
  std::string from;  // place of the reference, for messages
};

Node import_transform(const json::Cursor& node) {
  Node out;
  if (const auto matrix = node.find("matrix")) {
    mat4 m;
    matrix->numbers({&m[0][0], 16});
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1) {
      matrix->fail("is no affine transform: its last row must be 0 0 0 1");
    }
    out.matrix = m;
  }
  if (const auto translation = node.find("translation")) out.local.translation = translation->vector3();
  if (const auto scale = node.find("scale")) out.local.scale = scale->vector3();
  if (const auto rotation = node.find("rotation")) {
    const vec4 q = rotation->vector4();
    const float length = glm::length(q);
    if (!(length > 1e-6f) || !std::isfinite(length)) rotation->fail("is no unit quaternion");
    // Already of length 1 as far as floats go: keep the bits, so that writing and reading change nothing
    const float divisor = std::abs(length - 1) < 1e-6f ? 1 : length;
    out.local.rotation = quat(q.w / divisor, q.x / divisor, q.y / divisor, q.z / divisor);
  }
  return out;
}

int add_node(GltfImport& import, Node node) {
  import.scene.nodes.push_back(std::move(node));
  return static_cast<int>(import.scene.nodes.size()) - 1;
}

void add_instances(GltfImport& import, const json::Cursor& file_node, int mesh, int node) {
  const auto& meshes = import_mesh(import, mesh);
  const std::string node_group = light_group_extra(file_node);
  for (const int m : meshes) {
    scene::Instance instance;
    instance.mesh = m;
    instance.node = node;
    instance.light_group = node_group;
    import.document.charge(sizeof instance + instance.light_group.size(), file_node);
    if (import.shapes.contains(m)) import.bent.push_back({import.scene.instances.size(), file_node});
    import.scene.instances.push_back(std::move(instance));
  }
}

// EXT_mesh_gpu_instancing: a child node with the mesh for each element of the attributes.
void add_gpu_instances(GltfImport& import, const json::Cursor& file_node, const json::Cursor& instancing,
                       int mesh, int node) {
  GltfDocument& document = import.document;
  const json::Cursor attributes = instancing["attributes"];
  std::optional<std::size_t> count;
  const auto read = [&](const char* name, int components) {
    const auto accessor = document.reference(attributes, name, "accessors");
    if (!accessor) return FloatArray{};
    FloatArray array = read_floats(document, *accessor, components, components);
    if (count && *count != array.count) attributes.fail("the attributes differ in length");
    count = array.count;
    return array;
  };
  const FloatArray translation = read("TRANSLATION", 3), rotation = read("ROTATION", 4),
                   scale = read("SCALE", 3);
  for (const auto& [name, unused] : attributes.value().members()) {
    if (name != "TRANSLATION" && name != "ROTATION" && name != "SCALE") {
      document.ignored.add(fmt::format("instance attribute {}", printable(name, 40)));
    }
  }
  const std::string name = import.scene.nodes[node].name;
  document.charge(count.value_or(0) * (sizeof(Node) + name.size()), instancing);
  for (std::size_t i = 0; i < count.value_or(0); ++i) {
    Node child;
    child.name = fmt::format("{}#{}", name, i);
    child.parent = node;
    if (translation.count > 0)
      child.local.translation = {translation[i][0], translation[i][1], translation[i][2]};
    if (scale.count > 0) child.local.scale = {scale[i][0], scale[i][1], scale[i][2]};
    if (rotation.count > 0) {
      const quat q(rotation[i][3], rotation[i][0], rotation[i][1], rotation[i][2]);
      if (!(glm::length(q) > 1e-6f)) attributes["ROTATION"].fail(fmt::format("element {} is no rotation", i));
      child.local.rotation = glm::normalize(q);
    }
    add_instances(import, file_node, mesh, add_node(import, std::move(child)));
  }
}

void add_profile_light(GltfImport& import, const json::Cursor& file_node, int node) {
  auto light = import_profile_light(import, file_node, import.scene.nodes[node].name);
  if (!light) return;
  light->node = node;
  import.scene.lights.push_back(*std::move(light));
}

void add_light(GltfImport& import, const json::Cursor& file_node, int node) {
  const auto reference = extension(file_node, "KHR_lights_punctual");
  if (!reference) return;
  const auto lights = extension(import.document.root(), "KHR_lights_punctual");
  const std::size_t count = lights ? lights->size_of("lights") : 0;
  const int index = (*reference)["light"].index(count, "lights");
  auto light = import_light((*lights)["lights"][index], import.document);
  light.node = node;
  if (light.name.empty()) light.name = import.scene.nodes[node].name;
  if (light.group.empty()) light.group = light_group_extra(file_node);
  import.scene.lights.push_back(std::move(light));
}

/// An SPHL that shines: a lamp of its name at its node.
void add_emission(GltfImport& import, const json::Cursor& settings, const scene::Sphl& sphl) {
  const auto emission = settings.find("emission");
  if (!emission) return;
  scene::Light light;
  light.name = sphl.name, light.node = sphl.node, light.radius = sphl.radius;
  light.group = settings.text_or("light_group");
  read_emission(light, *emission, files_beside(import.document));
  import.scene.lights.push_back(std::move(light));
}

void add_sphl(GltfImport& import, const json::Cursor& file_node, int node) {
  const auto settings = extra(file_node, "sphl");
  const std::string& name = import.scene.nodes[node].name;
  if (!settings && !name.starts_with("SPHL")) return;
  scene::Sphl sphl;
  sphl.name = name;
  sphl.node = node;
  if (settings && settings->value().is_boolean()) {
    if (!settings->boolean()) return;
  } else if (settings) {
    sphl.name = settings->text_or("name", name);
    sphl.radius = settings->number_or("radius", sphl.radius);
    if (!(sphl.radius > 0)) (*settings)["radius"].fail("must be greater than 0");
    sphl.enabled = settings->boolean_or("enabled", true);
    add_emission(import, *settings, sphl);
  }
  import.scene.sphls.push_back(std::move(sphl));
}

void add_contents(GltfImport& import, const json::Cursor& file_node, int node) {
  GltfDocument& document = import.document;
  const std::size_t bent = import.bent.size();
  if (const auto mesh = document.reference(file_node, "mesh", "meshes")) {
    const auto instancing = extension(file_node, "EXT_mesh_gpu_instancing");
    if (instancing) {
      add_gpu_instances(import, file_node, *instancing, *mesh, node);
    } else {
      add_instances(import, file_node, *mesh, node);
    }
  }
  if (import.bent.size() == bent && file_node.has("skin"))
    document.ignored.add("skin of no mesh with joints");
  if (const auto camera = document.reference(file_node, "camera", "cameras")) {
    auto out = import_camera(document.item("cameras", *camera));
    out.node = node;
    if (out.name.empty()) out.name = import.scene.nodes[node].name;
    import.scene.cameras.push_back(std::move(out));
  }
  add_light(import, file_node, node);
  add_profile_light(import, file_node, node);
  add_sphl(import, file_node, node);
}

// Roots of the scene that is shown: the default scene, else the first, else every node that is no child.
std::vector<Visit> roots(GltfImport& import) {
  GltfDocument& document = import.document;
  std::vector<Visit> out;
  const auto add = [&](const json::Cursor& list) {
    for (const json::Cursor& node : json::elements(list))
      out.push_back({node.index(document.count("nodes"), "nodes"), -1, node.path()});
  };
  if (document.count("scenes") > 0) {
    const int shown = document.reference(document.root(), "scene", "scenes").value_or(0);
    const json::Cursor gltf_scene = document.item("scenes", shown);
    import.scene.name = gltf_scene.text_or("name");
    import_environment(import, gltf_scene);
    if (document.count("scenes") > 1) {
      document.ignored.add("scene that is not the default one", document.count("scenes") - 1);
    }
    if (const auto nodes = gltf_scene.find("nodes")) add(*nodes);
    return out;
  }
  std::vector<bool> is_child(document.count("nodes"), false);
  for (const json::Cursor& node : document.items("nodes")) {
    const auto children = node.find("children");
    if (!children) continue;
    for (const json::Cursor& child : json::elements(*children))
      is_child[child.index(is_child.size(), "nodes")] = true;
  }
  for (std::size_t n = 0; n < is_child.size(); ++n) {
    if (!is_child[n]) out.push_back({static_cast<int>(n), -1, "nodes"});
  }
  return out;
}

}  // namespace

void import_nodes(GltfImport& import) {
  GltfDocument& document = import.document;
  import.meshes_of_mesh.resize(document.count("meshes"));
  import.mesh_read.resize(document.count("meshes"), false);
  import.node_of_node.assign(document.count("nodes"), -1);

  // Walk depth first, parents before children, each node once: a second visit is a cycle or a second parent
  std::vector<Visit> stack = roots(import);
  std::ranges::reverse(stack);
  while (!stack.empty()) {
    const Visit visit = std::move(stack.back());
    stack.pop_back();
    const json::Cursor file_node = document.item("nodes", visit.node);
    int& node = import.node_of_node[visit.node];
    if (node >= 0) {
      json::Cursor(file_node.value(), file_node.file(), visit.from)
          .fail(fmt::format("node {} is reached a second time: nodes must form trees", visit.node));
    }
    Node out = import_transform(file_node);
    out.name = file_node.text_or("name", fmt::format("node {}", visit.node));
    out.parent = visit.parent;
    node = add_node(import, std::move(out));
    const int parent = node;
    add_contents(import, file_node, parent);
    if (const auto children = file_node.find("children")) {
      for (std::size_t i = children->size(); i-- > 0;) {
        const json::Cursor child = (*children)[i];
        stack.push_back({child.index(document.count("nodes"), "nodes"), parent, child.path()});
      }
    }
  }

  // Decode the meshes that no node shows, only to find what is broken in them
  const std::size_t shown = import.scene.meshes.size();
  for (std::size_t m = 0; m < import.mesh_read.size(); ++m) {
    if (import.mesh_read[m]) continue;
    for (const int unseen : import_mesh(import, static_cast<int>(m))) import.shapes.erase(unseen);
    import.scene.meshes.resize(shown);
    document.ignored.add("mesh outside the scene");
  }
}

}  // namespace ssphh::scene_io
