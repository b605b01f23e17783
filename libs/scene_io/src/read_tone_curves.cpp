#include "read_tone_curves.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/image/transfer.h>

namespace ssphh::scene_io {
namespace {

bool is_color(const scene::Scene& scene, int texture) {
  for (const scene::Material& m : scene.materials) {
    for (const scene::TextureUse* use :
         {&m.metallic_roughness_texture, &m.normal_texture, &m.transmission_texture})
      if (use->texture == texture) return false;
  }
  return true;
}

}  // namespace

void read_tone_curve(scene::Scene& scene, const json::Cursor& entry) {
  entry.only({"name", "gamma", "gain", "offset"});
  const std::string& name = entry["name"].text();
  const auto number = [&](const char* key, double least, double most, float fallback) {
    const auto member = entry.find(key);
    return member ? member->number(least, most) : fallback;
  };
  const float gamma = number("gamma", 0.01, 100, 1), gain = number("gain", 0, 1000, 1);
  const float offset = number("offset", -1, 1, 0);
  std::array<std::uint8_t, 256> curve{};
  for (std::size_t code = 0; code < curve.size(); ++code) {
    const float linear = image::srgb8_to_linear(static_cast<std::uint8_t>(code));
    curve[code] = image::linear_to_srgb8(gain * std::pow(linear, gamma) + offset);
  }
  bool found = false;
  for (std::size_t t = 0; t < scene.textures.size(); ++t) {
    scene::Texture& texture = scene.textures[t];
    if (texture.name != name) continue;
    found = true;
    if (!is_color(scene, static_cast<int>(t)))
      entry["name"].fail(fmt::format("texture \"{}\" holds no colours", name),
                         "tone curves are of base colours and emission");
    for (std::size_t i = 0; i < texture.rgba.size(); ++i)
      if (i % 4 != 3) texture.rgba[i] = curve[texture.rgba[i]];
  }
  if (found) return;
  std::vector<std::string> names;
  for (const scene::Texture& texture : scene.textures) names.push_back(texture.name);
  if (names.size() > 20) names.resize(20);
  entry["name"].fail(fmt::format("the scene has no texture \"{}\"", name),
                     names.empty() ? "it has none" : fmt::format("it has: {}", fmt::join(names, ", ")));
}

}  // namespace ssphh::scene_io
