// The same scene in other words: as OBJ and as glTF, as one matrix and as a chain of nodes, and there and
// back.

#include <map>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/core/hash.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/obj.h>

#include "export_fixture.h"
#include "glb_builder.h"
#include "scene_fields.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using test::GlbBuilder;

/// Hash of a field's bytes.
template <class T>
std::string digest(const T& field) {
  Hasher h;
  if constexpr (std::is_same_v<T, std::string>) {
    return field;
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    h.value(field);
  } else if constexpr (requires { h.array(field); } && !std::is_same_v<T, std::vector<std::string>>) {
    h.array(field);
  } else if constexpr (requires { field.has_value(); }) {
    return field ? digest(*field) : "none";
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    for (const std::string& text : field) h.text(text);
  } else {
    h.bytes(std::as_bytes(std::span(&field, 1)));
  }
  return h.finish().hex();
}

std::map<std::string, std::string> fields_of(scene::Scene scene) {
  std::map<std::string, std::string> fields;
  const auto note = [&](const std::string& path, const auto& field) { fields[path] = digest(field); };
  test::SceneFields(scene, note);
  return fields;
}

/// Every field but what glTF has no place for.
TEST(SameScene, ExportedToGltfAndReadAgainHasTheSameFields) {
  scene::Scene scene = test::scene_of_everything();
  scene.cameras.resize(2);
  for (scene::Camera& camera : scene.cameras) camera.name = "c", camera.node = 1;
  scene.cameras[0].yfov = 0.7f, scene.cameras[0].aspect = 1.5f;
  scene.cameras[1].node = 2, scene.cameras[1].orthographic = true, scene.cameras[1].yheight = 3;
  scene.cameras[1].aspect = 2.5f;
  scene.meshes.back().material = 0;  // glTF's own default is another material than ours, so that one is added
  scene.sphls = {{"west", 0, 0.07f, true}, {"east", 1, 0.3f, false}};
  scene::validate(scene);
  const scene::Scene again = load_gltf(export_glb(scene), "memory.glb");
  const auto before = fields_of(scene), after = fields_of(again);
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [path, value] : before) {
    const bool named_by_file = path.ends_with(".name") && value.empty();  // files have no empty names
    const bool other_projection = path == "cameras[0].yheight" || path == "cameras[1].yfov";
    if (named_by_file || other_projection) continue;
    EXPECT_EQ(after.at(path), value) << path;
  }
  EXPECT_EQ(export_glb(again), export_glb(load_gltf(export_glb(again), "memory.glb")))
      << "what was read is written as it was read";
}

// A roof of two triangles with a texture coordinate and a normal of its own at each corner.
const std::string roof_obj =
    "mtllib roof.mtl\no roof\nv 0 0 0\nv 2 0 0.5\nv 0.25 3 1\nv 1 1 4\n"
    "vt 0.125 0.25\nvt 0.5 0.75\nvt 0.375 0.625\nvt 1 0\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\nvn 0 0 -1\n"
    "usemtl tiles\nf 1/1/1 2/2/2 3/3/3\nf 3/3/3 2/2/2 4/4/4\n";
const std::string roof_mtl = "newmtl tiles\nKd 0.5 0.25 0.125\nKe 3 2 1\nPr 0.3\nPm 0.6\nd 0.75\n";

scene::Scene roof_as_obj() {
  const test::TempDir folder;
  write_file(folder / "roof.mtl", roof_mtl);
  return load_obj(roof_obj, folder / "roof.obj");
}

/// `nodes`: the file's nodes; mesh 0 is the roof.
scene::Scene roof_as_gltf(const std::string& nodes) {
  GlbBuilder b;
  b.add<float>({0, 0, 0, 2, 0, 0.5f, 0.25f, 3, 1, 1, 1, 4}, 5126, "VEC3", 4);
  b.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1}, 5126, "VEC3", 4);
  b.add<float>({0.125f, 0.75f, 0.5f, 0.25f, 0.375f, 0.375f, 1, 1}, 5126, "VEC2", 4);  // v down
  b.add<std::uint16_t>({0, 1, 2, 2, 1, 3}, 5123, "SCALAR", 6);
  return load_gltf(
      b.glb("\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":" + nodes +
            ",\"meshes\":[{\"name\":\"roof\",\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,"
            "\"TEXCOORD_0\":2},\"indices\":3,\"material\":0}]}],"
            "\"materials\":[{\"name\":\"tiles\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,0."
            "125,0.75],"
            "\"metallicFactor\":0.6,\"roughnessFactor\":0.3},\"emissiveFactor\":[1,0.66666667,0.33333334],"
            "\"alphaMode\":\"BLEND\",\"extensions\":{\"KHR_materials_emissive_strength\":{"
            "\"emissiveStrength\":3}}}]"),
      "roof.glb");
}

TEST(SameScene, ObjAndGltfGiveTheSameScene) {
  const scene::Scene obj = roof_as_obj();
  const scene::Scene gltf =
      roof_as_gltf("[{\"name\":\"roof\",\"mesh\":0,\"extras\":{\"light_group\":\"tiles\"}}]");
  const auto before = fields_of(obj), after = fields_of(gltf);
  for (const auto& [path, value] : before) {
    if (path != "name") {
      EXPECT_EQ(after.at(path), value) << path;
    }
  }
  EXPECT_EQ(before.size(), after.size());
  EXPECT_EQ(scene::scene_hash(obj), scene::scene_hash(gltf));
}

// Moved by (1, 2, 3), turned by a third of a circle about (1, 1, 1), x → y → z, and scaled to (2, 3, 5).
TEST(SameScene, OneMatrixAndAChainOfNodesPutItInTheSamePlace) {
  const std::string r = "\"rotation\":[0.5,0.5,0.5,0.5]", t = "\"translation\":[1,2,3]",
                    s = "\"scale\":[2,3,5]";
  const std::string of_mesh = "\"mesh\":0}";
  const std::string ways[] = {
      "[{\"matrix\":[0,2,0,0, 0,0,3,0, 5,0,0,0, 1,2,3,1]," + of_mesh + "]",
      "[{" + t + "," + r + "," + s + "," + of_mesh + "]",
      "[{" + t + ",\"children\":[1]},{" + r + ",\"children\":[2]},{" + s + "," + of_mesh + "]",
      "[{" + t + ",\"children\":[2]},{" + s + "," + of_mesh + ",{" + r + ",\"children\":[1]}]",
      "[{\"matrix\":[1,0,0,0, 0,1,0,0, 0,0,1,0, 1,2,3,1],\"children\":[1]},{" + r + "," + s + "," + of_mesh +
          "]"};
  for (const std::string& nodes : ways) {
    const scene::Scene scene = roof_as_gltf(nodes);
    const auto world = scene::world_matrices(scene);
    const mat4& m = world[scene.instances.at(0).node];
    for (const vec3& p : scene.meshes.at(0).positions) {
      const vec3 expected(1 + 5 * p.z, 2 + 2 * p.x, 3 + 3 * p.y);
      EXPECT_LT(glm::distance(vec3(m * vec4(p, 1)), expected), 1e-5f) << nodes;  // float rounding
    }
  }
}

}  // namespace
}  // namespace ssphh::scene_io
