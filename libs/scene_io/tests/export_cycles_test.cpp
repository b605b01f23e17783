// What Blender's scripts read: scene.json and scene.bin, against the scene they were made from.

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include <ssphh/image/io.h>
#include <ssphh/scene/query.h>

#include "export_fixture.h"
#include "json_text.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

class ExportCycles : public testing::Test {
 protected:
  /// What the last export wrote.
  const json::Value written_json() const { return parse_json(read_text_file(dir_ / "scene.json")); }

  template <class T>
  std::vector<T> array(const json::Value& offset, const json::Value& count) const {
    std::vector<T> result(count_of(count));
    const auto begin = count_of(offset);
    EXPECT_LE(begin + result.size() * sizeof(T), binary_.size());
    std::memcpy(result.data(), binary_.data() + begin, result.size() * sizeof(T));
    return result;
  }

  TempDir dir_;
  scene::Scene scene_ = scene_of_everything();
  scene_io::ExportSettings settings_ = export_settings();
  const scene_io::ExportReport report_ = scene_io::export_cycles(scene_, settings_, dir_.path());
  const json::Value json_ = written_json();
  const std::vector<std::byte> binary_ = read_file(dir_ / "scene.bin");
};

json::Value numbers(const vec3& v) {
  return {v.x, v.y, v.z};
}

mat4 matrix(const json::Value& rows) {
  mat4 m;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) m[c][r] = float_of(rows[r][c]);
  }
  return m;
}

TEST_F(ExportCycles, PictureAndCameraAreTheSettings) {
  EXPECT_EQ(json_["width"], 64);
  EXPECT_EQ(json_["height"], 36);
  EXPECT_EQ(json_["max_depth"], 3);
  EXPECT_EQ(json_["spp"], 16);
  const json::Value& camera = json_["camera"];
  EXPECT_EQ(matrix(camera["world"]), settings_.camera.world);
  EXPECT_EQ(camera["orthographic"], false);
  EXPECT_EQ(float_of(camera["yfov"]), 0.9f);
  EXPECT_EQ(float_of(camera["yheight"]), settings_.camera.camera.yheight);
}

TEST_F(ExportCycles, ACubeMapIsAListOfCameras) {
  const scene_io::ExportReport report = scene_io::export_cycles(scene_, cube_settings(), dir_.path());
  const json::Value cameras = parse_json(read_text_file(dir_ / "cube.json"));
  ASSERT_EQ(cameras.size(), 6u);
  for (std::size_t face = 0; face < 6; ++face) {
    const mat4 world = matrix(cameras[face]);
    expect_camera_of_face(face, vec3(world[3]), -vec3(world[2]), vec3(world[0]), vec3(world[1]));
  }
  EXPECT_EQ(std::ranges::count(report.files, dir_ / "cube.json"), 1);
  EXPECT_NE(report.command.find("--cube " + (dir_ / "cube.json").string()), std::string::npos);
  EXPECT_TRUE(differences_with(report, "lamps and sky").empty()) << "its pictures are apart";
}

TEST_F(ExportCycles, LightsAreInWorldSpace) {
  const std::vector<mat4> world = scene::world_matrices(scene_);
  const char* types[] = {"point", "spot", "directional", "directional", "sphere"};
  ASSERT_EQ(json_["lights"].size(), scene_.lights.size());
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const scene::Light& light = scene_.lights[i];
    const json::Value& written = json_["lights"][i];
    const mat4& place = world[light.node];
    EXPECT_EQ(written["type"], types[i]);
    EXPECT_EQ(matrix(written["world"]), place);
    EXPECT_EQ(written["position"], numbers(vec3(place[3])));
    EXPECT_EQ(written["direction"], numbers(-glm::normalize(vec3(place[2]))));
    EXPECT_EQ(written["color"], numbers(light.color));
    EXPECT_EQ(float_of(written["intensity"]), light.intensity);
    EXPECT_EQ(float_of(written["radius"]), light.radius);
    EXPECT_EQ(float_of(written["angular_radius"]), light.angular_radius);
    EXPECT_EQ(float_of(written["cos_inner"]), std::cos(light.inner_cone));
    EXPECT_EQ(float_of(written["cos_outer"]), std::cos(light.outer_cone));
  }
  EXPECT_EQ(differences_with(report_, "range").size(), 1u);
}

void expect_use(const json::Value& written, const scene::TextureUse& use) {
  if (use.texture < 0) {
    EXPECT_TRUE(written.is_null());
    return;
  }
  const std::map<scene::Wrap, const char*> wraps = {
      {scene::Wrap::repeat, "repeat"}, {scene::Wrap::mirror, "mirror"}, {scene::Wrap::clamp, "clamp"}};
  EXPECT_EQ(written["texture"], use.texture);
  EXPECT_EQ(written["uv_set"], use.uv_set);
  EXPECT_EQ(written["offset"], json::Value({use.offset.x, use.offset.y}));
  EXPECT_EQ(written["scale"], json::Value({use.scale.x, use.scale.y}));
  EXPECT_EQ(float_of(written["rotation"]), use.rotation);
  EXPECT_EQ(written["wrap"], json::Value({wraps.at(use.wrap_u), wraps.at(use.wrap_v)}));
  EXPECT_EQ(written["nearest"], use.nearest);
}

TEST_F(ExportCycles, MaterialsKeepEveryValueAndTexture) {
  ASSERT_EQ(json_["materials"].size(), scene_.materials.size());
  const char* modes[] = {"opaque", "mask", "blend"};
  for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
    const scene::Material& m = scene_.materials[i];
    const json::Value& written = json_["materials"][i];
    SCOPED_TRACE(m.name);
    EXPECT_EQ(written["base_color"], numbers(m.base_color));
    EXPECT_EQ(written["emission"], numbers(m.emission));
    EXPECT_EQ(float_of(written["alpha"]), m.alpha);
    EXPECT_EQ(float_of(written["alpha_cutoff"]), m.alpha_cutoff);
    EXPECT_EQ(written["alpha_mode"], modes[static_cast<int>(m.alpha_mode)]);
    EXPECT_EQ(float_of(written["metallic"]), m.metallic);
    EXPECT_EQ(float_of(written["diffuse_roughness"]), m.diffuse_roughness);
    EXPECT_EQ(float_of(written["specular_roughness"]), m.specular_roughness);
    EXPECT_FLOAT_EQ(float_of(written["f0"]), 0.04f * m.specular) << "(0.5/2.5)²";
    EXPECT_EQ(written["unlit"], m.unlit);
    EXPECT_EQ(written["double_sided"], m.double_sided);
    EXPECT_EQ(float_of(written["normal_scale"]), m.normal_scale);
    expect_use(written["base_color_texture"], m.base_color_texture);
    expect_use(written["metallic_roughness_texture"], m.metallic_roughness_texture);
    expect_use(written["emission_texture"], m.emission_texture);
    expect_use(written["normal_texture"], m.normal_texture);
  }
  for (std::size_t t = 0; t < scene_.textures.size(); ++t) {
    const json::Value& written = json_["textures"][t];
    EXPECT_EQ(written["width"], scene_.textures[t].width);
    const auto bytes = read_file(dir_ / written["file"].string());
    EXPECT_EQ(image::decode_rgba8(bytes, "texture").rgba, scene_.textures[t].rgba);
  }
}

TEST_F(ExportCycles, MeshesAreThoseOfTheInstancesInWorldSpace) {
  const std::vector<mat4> world = scene::world_matrices(scene_);
  ASSERT_EQ(json_["meshes"].size(), scene_.instances.size());
  for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
    SCOPED_TRACE(i);
    const scene::Mesh& mesh = scene_.meshes[scene_.instances[i].mesh];
    const mat4& m = world[scene_.instances[i].node];
    const json::Value& written = json_["meshes"][i];
    EXPECT_EQ(written["material"], mesh.material);
    const auto positions = array<vec3>(written["positions"], written["vertices"]);
    ASSERT_EQ(positions.size(), mesh.positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v)
      EXPECT_LT(glm::distance(positions[v], vec3(m * vec4(mesh.positions[v], 1))), 1e-5f);  // float rounding
    auto triangles = array<uvec3>(written["indices"], written["triangles"]);
    if (glm::determinant(mat3(m)) < 0) {
      for (uvec3& t : triangles) std::swap(t.y, t.z);
    }
    EXPECT_EQ(triangles, mesh.triangles);
    for (const int set : {0, 1}) {
      const std::string name = "uv" + std::to_string(set);
      const std::vector<vec2>& uv = mesh.uvs[set];
      EXPECT_EQ(written.contains(name), !uv.empty());
      if (!uv.empty()) {
        EXPECT_EQ(array<vec2>(written[name.c_str()], written["vertices"]), uv);
      }
    }
    EXPECT_EQ(written.contains("colors"), !mesh.colors.empty());
    if (!mesh.colors.empty()) {
      EXPECT_EQ(array<vec4>(written["colors"], written["vertices"]), mesh.colors);
    }
    EXPECT_EQ(written.contains("normals"), !mesh.normals.empty());
  }
}

TEST_F(ExportCycles, TextureFilesHaveNamesThatFileSystemsTake) {
  scene_.textures[0].name = std::string(300, 'x');
  scene_.textures[1].name = "../a b";
  scene_io::export_cycles(scene_, settings_, dir_.path());
  const json::Value json = written_json();
  EXPECT_EQ(json["textures"][0]["file"], "texture0" + std::string(52, 'x') + ".png");
  EXPECT_EQ(json["textures"][1]["file"], "texture1ab.png");
}

TEST_F(ExportCycles, TheEnvironmentKeepsColourRotationAndImage) {
  const json::Value& written = json_["environment"];
  EXPECT_EQ(written["color"], numbers({1, 2, 0.5f}));
  EXPECT_EQ(float_of(written["rotation"]), 0.7f);
  const image::Image image = image::read_image(dir_ / written["file"].string());
  EXPECT_EQ(image.pixels, scene_.environment->equirect.pixels);
}

}  // namespace
}  // namespace ssphh::test
