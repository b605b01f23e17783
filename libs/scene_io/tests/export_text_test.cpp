// What the exporters write, to the last line: values, units, transforms and colours of two scenes in every
// format. One file each in expected/; meshes and images stand there as their sizes and weighted means.

#include <cstring>
#include <map>

#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/image/io.h>
#include <ssphh/scene/primitives.h>

#include "error_message.h"
#include "expected_text.h"
#include "export_fixture.h"
#include "memory_dir.h"
#include "scene_text.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

using scene::Material;

/// The picture's values; of an image on disk what its decoder sees.
std::string image_text(const std::filesystem::path& path) {
  const image::Image image = image::read_image(path);
  return fmt::format("{}×{}×{} {}", image.width, image.height, image.channels,
                     array_text(image.pixels.data(), static_cast<std::size_t>(image.width * image.height),
                                static_cast<std::size_t>(image.channels)));
}

std::string ply_text(const std::filesystem::path& path) {
  const Ply ply = read_ply(path);
  std::string text;
  std::vector<float> numbers;
  for (const std::string& property : ply.properties) text += property + " ";
  for (const std::vector<float>& vertex : ply.vertices)
    numbers.insert(numbers.end(), vertex.begin(), vertex.end());
  text += array_text(numbers.data(), ply.vertices.size(), ply.properties.size());
  return text + " triangles " + field_text(ply.triangles);
}

/// Of each kind of line its numbers, as many as it has; "1/2/3" are three and "1//3" are two.
std::string obj_text(const std::string& obj) {
  std::map<std::string, std::pair<std::size_t, std::vector<float>>> kinds;
  for (const std::string& line : lines_of(obj)) {
    const std::size_t end = line.find(' ');
    auto& [size, values] = kinds[line.substr(0, end) + (line.find("//") == std::string::npos ? "" : " //")];
    const std::size_t before = values.size();
    for (const char* at = line.c_str() + end; *at != 0;) {
      char* next = nullptr;
      const float value = std::strtof(at, &next);
      if (next != at) values.push_back(value);
      at = next != at ? next : at + 1;
    }
    size = values.size() - before;
  }
  std::string text;
  for (const auto& [kind, lines] : kinds)
    text +=
        kind + " " + array_text(lines.second.data(), lines.second.size() / lines.first, lines.first) + "\n";
  return text;
}

/// Words of four bytes, integers and floats one after the other: those of indices are tiny as floats and
/// count as integers.
std::string words_text(const std::vector<std::byte>& bytes) {
  std::vector<float> values(bytes.size() / 4);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + 4 * i, 4);
    std::memcpy(&values[i], &word, 4);
    if (word < 1'000'000) values[i] = static_cast<float>(word);
  }
  return field_text(values);
}

std::string file_text(const std::filesystem::path& path) {
  const std::string kind = path.extension().string();
  if (kind == ".ply") return ply_text(path) + "\n";
  if (kind == ".exr" || kind == ".png") return image_text(path) + "\n";
  if (kind == ".obj") return obj_text(read_text_file(path));
  if (kind == ".bin") return words_text(read_file(path)) + "\n";
  if (kind == ".py") return fmt::format("{} bytes\n", std::filesystem::file_size(path) > 0 ? "some" : "no");
  return read_text_file(path);
}

std::string export_text(const scene_io::RendererFormat& format, const scene::Scene& scene,
                        const scene_io::ExportSettings& settings) {
  const TempDir dir(memory_dir());
  const scene_io::ExportReport report = format.write(scene, settings, dir.path());
  std::string text;
  for (const std::filesystem::path& path : report.files)
    text += "=== " + std::filesystem::relative(path, dir.path()).string() + "\n" + file_text(path);
  text += "=== command\n" + report.command + "\n=== differences\n";
  for (const std::string& line : report.differences) text += line + "\n";
  for (std::size_t at; (at = text.find(dir.path().string())) != std::string::npos;)
    text.replace(at, dir.path().string().size(), "DIRECTORY");
  return text;
}

scene::TextureUse use_of(int texture, scene::Wrap wrap, bool nearest) {
  scene::TextureUse use;
  use.texture = texture, use.uv_set = 1, use.offset = {0.125f, 0.75f}, use.scale = {0.5f, 4},
  use.rotation = -0.6f;
  use.wrap_u = use.wrap_v = wrap, use.nearest = nearest;
  return use;
}

std::vector<Material> more_materials() {
  std::vector<Material> all;
  const auto add = [&](const std::string& name, const auto& change) {
    Material m;
    m.name = name;
    m.base_color = {0.6f, 0.4f, 0.3f};
    change(m);
    all.push_back(m);
  };
  const scene::TextureUse repeated = use_of(0, scene::Wrap::repeat, false),
                          clamped = use_of(1, scene::Wrap::clamp, true),
                          mirrored = use_of(1, scene::Wrap::mirror, true);
  add("half metal", [](Material& m) { m.metallic = 0.4f, m.specular_roughness = -0.35f; });
  add("mostly metal", [](Material& m) { m.metallic = 0.7f, m.specular_roughness = 0.01f; });
  add("textured metal", [&](Material& m) {
    m.metallic = 1, m.specular_roughness = 0.45f, m.metallic_roughness_texture = repeated;
  });
  add("textured varnish", [&](Material& m) {
    m.ior = 1.33f, m.specular = 0.5f, m.specular_roughness = -0.8f, m.metallic_roughness_texture = clamped;
  });
  add("diamond", [&](Material& m) {
    m.ior = 2.4f, m.base_color_texture = mirrored, m.base_color_texture.wrap_v = scene::Wrap::repeat;
  });
  add("gold leaf", [&](Material& m) {
    m.metallic = 1, m.base_color = vec3(1), m.base_color_texture = clamped, m.specular_roughness = 0.2f;
  });
  add("neon", [&](Material& m) {
    m.unlit = true, m.base_color_texture = repeated, m.alpha_mode = scene::AlphaMode::blend;
  });
  add("lattice", [&](Material& m) {
    m.alpha_mode = scene::AlphaMode::mask, m.alpha = 0.9f, m.alpha_cutoff = 0.3f,
    m.base_color_texture = clamped;
    m.emission = {2, 1, 0.5f};
  });
  add("gone",
      [](Material& m) { m.alpha_mode = scene::AlphaMode::mask, m.alpha = 0.25f, m.emission = vec3(1); });
  add("veil", [&](Material& m) {
    m.alpha_mode = scene::AlphaMode::blend, m.alpha = 0.375f, m.base_color_texture = repeated,
    m.emission = vec3(4);
    m.emission_texture = mirrored;
  });
  add("embossed", [&](Material& m) {
    m.specular = 0, m.normal_texture = clamped, m.normal_scale = 0.5f, m.base_color_texture = repeated;
    m.diffuse_roughness = 0.5f;
  });
  add("embossed metal",
      [&](Material& m) { m.metallic = 1, m.normal_texture = repeated, m.diffuse_roughness = -1; });
  return all;
}

/// What scene_of_everything() has not: nodes below nodes, one that moves, meshes used twice and without a
/// material, an open polygon, an environment of one colour.
scene::Scene second_scene() {
  scene::Scene s = scene_of_everything();
  s.name = "second & last";
  s.materials = more_materials();
  s.meshes.clear(), s.instances.clear(), s.nodes.clear();
  s.nodes.resize(3);
  s.nodes[0].matrix =
      glm::rotate(glm::translate(mat4(1), vec3(0.5f, -1, 2)), 0.8f, glm::normalize(vec3(3, 1, 2)));
  s.nodes[1].parent = 0, s.nodes[1].local.scale = {2, -0.5f, 0.25f};
  s.nodes[2].parent = 1, s.nodes[2].name = "far\tside";
  s.animations.resize(1);
  s.animations[0].channels.push_back({1,
                                      scene::AnimationPath::translation,
                                      scene::Interpolation::linear,
                                      {0, 2},
                                      {vec4(0), vec4(4, 8, 2, 0)}});
  s.meshes.push_back(scene::make_box({0, 0, 0}, {1, 0.5f, 0.25f}));
  s.meshes[0].uvs[1] = s.meshes[0].uvs[0];
  for (std::size_t i = 0; i < s.meshes[0].positions.size(); ++i)
    s.meshes[0].colors.emplace_back(0.5f + 0.02f * static_cast<float>(i), 0.25f, 1, i == 23 ? 0.5f : 1);
  s.meshes.push_back(scene::make_quad({0, 0, 0}, {1, 0.5f, 0}, {0, 1, 0.5f}));
  s.meshes[1].uvs[1] = {{0, 0}, {0.5f, 0.25f}, {0.5f, 1}, {0, 0.75f}};
  s.meshes[1].material = 4;
  s.meshes.push_back(scene::make_quad({0, 0, 0}, {1, 0.5f, 0}, {0, 1, 0.5f}));
  s.meshes[2].normals.clear(), s.meshes[2].uvs[0].clear();
  s.meshes[2].triangles.emplace_back(2, 2, 2);  // without a normal
  s.instances = {{0, 0, -1, {}}, {1, 1, -1, {}}, {2, 2, -1, {}}, {0, 2, 3, {}}};
  for (std::size_t i = 0; i < s.materials.size(); ++i)
    s.instances.push_back({1, static_cast<int>(i % 3), static_cast<int>(i), {}});
  s.lights.resize(5);
  for (std::size_t i = 0; i < 5; ++i) s.lights[i].node = static_cast<int>(i % 3), s.lights[i].range = 0;
  s.environment->equirect = {};
  s.environment->color = {0.25f, 0.5f, 0.75f};
  return s;
}

class ExportText : public testing::TestWithParam<scene_io::RendererFormat> {
 protected:
  std::string name() const { return std::string(GetParam().name); }
};
INSTANTIATE_TEST_SUITE_P(Formats, ExportText, testing::ValuesIn(scene_io::renderer_formats()),
                         [](const auto& format) { return std::string(format.param.name); });

TEST_P(ExportText, SceneOfEverythingIsWrittenAsTheListSays) {
  expect_text_of("libs/scene_io/tests/expected/" + name() + "-everything.txt",
                 export_text(GetParam(), scene_of_everything(), export_settings()));
}

TEST_P(ExportText, NodesMaterialsAndACameraOfOtherKindsToo) {
  scene_io::ExportSettings settings = export_settings();
  settings.time = 0.5f, settings.width = 30, settings.height = 50, settings.max_depth = 1, settings.spp = 7;
  settings.camera.camera.orthographic = name() != "corona";  // which knows none
  settings.camera.camera.yheight = 3;
  expect_text_of("libs/scene_io/tests/expected/" + name() + "-second.txt",
                 export_text(GetParam(), second_scene(), settings));
}

TEST(ExportSettings, TheDefaultsAreAPictureAtTheBeginning) {
  const scene_io::ExportSettings settings{};
  EXPECT_EQ(settings.time, 0);
  EXPECT_EQ(settings.width, 1280);
  EXPECT_EQ(settings.height, 720);
  EXPECT_EQ(settings.max_depth, 25);
  EXPECT_EQ(settings.spp, 64);
}

TEST_P(ExportText, SettingsMustMakeSenseAndTheFolderIsMade) {
  const TempDir dir(memory_dir());
  const auto said = [&](const std::filesystem::path& folder, const auto& change) {
    scene_io::ExportSettings settings;
    change(settings);
    return message_of([&] { GetParam().write(scene::Scene{}, settings, folder); });
  };
  using Settings = scene_io::ExportSettings;
  const std::filesystem::path folder = dir / "not/yet/there";
  EXPECT_EQ(said(folder, [](Settings& s) { s.width = s.height = s.spp = 1, s.max_depth = 0; }), "no error");
  EXPECT_FALSE(std::filesystem::is_empty(folder));
  const std::string size = "export: width and height must be positive";
  EXPECT_EQ(said(folder, [](Settings& s) { s.width = 0; }), size);
  EXPECT_EQ(said(folder, [](Settings& s) { s.height = 0; }), size);
  const std::string effort = "export: max depth must not be negative, and there must be a sample";
  EXPECT_EQ(said(folder, [](Settings& s) { s.max_depth = -1; }), effort);
  EXPECT_EQ(said(folder, [](Settings& s) { s.spp = 0; }), effort);
  EXPECT_EQ(said(folder, [](Settings& s) { s.time = INFINITY; }),
            "export: the time must be a finite number of seconds");
  write_file(dir / "file", std::string());
  EXPECT_EQ(said(dir / "file/below", [](Settings&) {}),
            (dir / "file/below").string() + ": the folder cannot be made: Not a directory");
  scene::Scene broken;
  broken.instances.push_back({7, -1, -1, {}});
  EXPECT_EQ(message_of([&] { GetParam().write(broken, {}, folder); }), "instance 0: refers to mesh 7 of 0");
}

TEST_P(ExportText, AnEmptySceneToo) {
  expect_text_of("libs/scene_io/tests/expected/" + name() + "-empty.txt",
                 export_text(GetParam(), scene::Scene{}, {}));
}

}  // namespace
}  // namespace ssphh::test
