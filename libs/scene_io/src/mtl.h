#pragma once
/// Wavefront MTL material libraries.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include <ssphh/scene/scene.h>

#include "ignored.h"

namespace ssphh::scene_io {

/// A texture statement: file name and options.
struct MtlTexture {
  std::string file;  ///< empty: none
  vec2 offset{0}, scale{1};
  bool clamp = false;
  float bump = 1;  ///< -bm
};

/// A material as the file states it; nothing is looked up yet.
struct MtlMaterial {
  std::string name;
  vec3 kd{0.8f}, ks{0}, ke{0};
  float ns = 0, ni = 1.5f;
  std::optional<float> dissolve, transparency;  ///< d; Tr, which counts when d is absent
  std::optional<vec3> filter;                   ///< Tf: of white light, what comes out of a body or a sheet
  std::optional<float> roughness, metallic;     ///< Pr, Pm of the physically based extension
  int illum = 2;
  MtlTexture map_kd, map_ke, map_d, normal;
};

/// Throws Error naming file and line for values that are no finite numbers.
std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& file, Ignored& ignored);

/// Reads textures relative to the MTL file and adds them and the materials to a scene.
class MtlImport {
 public:
  MtlImport(scene::Scene& scene, Ignored& ignored) : scene_(scene), ignored_(ignored) {}

  /// Adds the library's materials; a missing file is a warning. The first material of a name counts.
  void add_library(const std::filesystem::path& path);
  /// Scene material of a name; for an unknown name warns once and adds one of default colour.
  int material(const std::string& name);

 private:
  scene::Material convert(const MtlMaterial& mtl, const std::filesystem::path& folder);
  int texture(const std::filesystem::path& path);
  scene::TextureUse use(const MtlTexture& mtl, const std::filesystem::path& folder);
  int coverage_texture(int color, int coverage);

  scene::Scene& scene_;
  Ignored& ignored_;
  std::map<std::string, int> materials_;
  std::map<std::filesystem::path, int> textures_;
};

}  // namespace ssphh::scene_io
