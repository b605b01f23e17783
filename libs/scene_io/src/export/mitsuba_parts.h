#pragma once
/// What the parts of the exporter for Mitsuba 3 share.

#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <ssphh/scene_io/renderer_export.h>

#include "differences.h"
#include "texture_files.h"
#include "xml_writer.h"

namespace ssphh::scene_io::mitsuba {

// Mitsuba 3's scene format: https://mitsuba.readthedocs.io/en/stable/src/key_topics/scene_format.html
struct Export {
  const scene::Scene& scene;
  const ExportSettings& settings;
  const std::filesystem::path& directory;
  TextureFiles textures;
  XmlWriter xml;
  Differences differences;
  std::vector<std::filesystem::path> files;
};

inline void number(XmlWriter& xml, std::string_view name, float value) {
  xml.empty("float", {{"name", name}, {"value", fmt::format("{}", value)}});
}

inline void integer(XmlWriter& xml, std::string_view name, int value) {
  xml.empty("integer", {{"name", name}, {"value", std::to_string(value)}});
}

inline void boolean(XmlWriter& xml, std::string_view name, bool value) {
  xml.empty("boolean", {{"name", name}, {"value", value ? "true" : "false"}});
}

inline void string(XmlWriter& xml, std::string_view name, std::string_view value) {
  xml.empty("string", {{"name", name}, {"value", value}});
}

inline void rgb(XmlWriter& xml, std::string_view name, const vec3& value) {
  xml.empty("rgb", {{"name", name}, {"value", fmt::format("{} {} {}", value.x, value.y, value.z)}});
}

inline void point(XmlWriter& xml, std::string_view name, const vec3& p) {
  xml.empty("point", {{"name", name},
                      {"x", fmt::format("{}", p.x)},
                      {"y", fmt::format("{}", p.y)},
                      {"z", fmt::format("{}", p.z)}});
}

inline void transform(XmlWriter& xml, std::string_view name, const mat4& m) {
  std::string rows;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) rows += fmt::format("{}{}", rows.empty() ? "" : " ", m[c][r]);
  }
  xml.open("transform", {{"name", name}});
  xml.empty("matrix", {{"value", rows}});
  xml.close();
}

/// A constant colour, or a texture times a factor.
void color(Export& e, std::string_view name, const vec3& factor, const scene::TextureUse& use);

/// A surface's material, with what Mitsuba computes differently.
void write_bsdf(Export& e, const std::string& id, const scene::Material& m, bool vertex_colors);

}  // namespace ssphh::scene_io::mitsuba
