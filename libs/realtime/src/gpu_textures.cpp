#include "covered_colors.h"
#include "gpu_scene.h"

namespace ssphh::realtime {
namespace {

gl::Address address(scene::Wrap wrap) {
  return wrap == scene::Wrap::repeat   ? gl::Address::repeat
         : wrap == scene::Wrap::mirror ? gl::Address::mirror
                                       : gl::Address::clamp;
}

}  // namespace

void GpuScene::add_textures(const scene::Scene& scene, FrameCounters& counters) {
  white_ = gl::Texture(gl::Format::rgba8, 1, 1);
  const std::array<std::byte, 4> ones{std::byte{255}, std::byte{255}, std::byte{255}, std::byte{255}};
  white_.upload(ones);
  const auto slots_of = [&](const scene::Material& m) {
    const auto slot = [&](unsigned unit, const scene::TextureUse& use, TextureKind kind) {
      if (use.texture < 0) return Slot{unit, -1, -1};
      return Slot{unit, texture_for(scene, use.texture, kind, counters), sampler_for(use)};
    };
    using enum TextureKind;
    const bool covers = m.alpha_mode != scene::AlphaMode::opaque;
    return std::array<Slot, 5>{
        slot(unit::base_texture, m.base_color_texture, covers ? color_and_coverage : color),
        slot(unit::rough_texture, m.metallic_roughness_texture, numbers),
        slot(unit::emission_texture, m.emission_texture, color),
        slot(unit::normal_texture, m.normal_texture, numbers),
        slot(unit::transmission_texture, m.transmission_texture, numbers)};
  };
  for (const scene::Material& m : scene.materials) slots_.push_back(slots_of(m));
  slots_.push_back(slots_of({}));
}

int GpuScene::texture_for(const scene::Scene& scene, int texture, TextureKind kind, FrameCounters& counters) {
  const auto [place, is_new] =
      texture_index_.try_emplace({texture, kind}, static_cast<int>(textures_.size()));
  if (!is_new) return place->second;
  const scene::Texture& source = scene.textures[texture];
  if (source.width <= 0 || source.height <= 0) {
    place->second = -1;
    return -1;
  }
  gl::Texture& t =
      textures_.emplace_back(kind == TextureKind::numbers ? gl::Format::rgba8 : gl::Format::srgb8_alpha8,
                             source.width, source.height, 0, true);
  const std::vector<std::uint8_t> covered =
      kind == TextureKind::color_and_coverage ? covered_colors(source) : std::vector<std::uint8_t>();
  t.upload(std::as_bytes(std::span(covered.empty() ? source.rgba : covered)));
  t.generate_mipmaps();
  counters.bytes_uploaded += source.rgba.size();
  bytes_ += source.rgba.size() * 4 / 3;
  return place->second;
}

int GpuScene::sampler_for(const scene::TextureUse& use) {
  const int key = static_cast<int>(use.wrap_u) + 3 * static_cast<int>(use.wrap_v) + (use.nearest ? 9 : 0);
  const auto [place, is_new] = sampler_index_.try_emplace(key, static_cast<int>(samplers_.size()));
  if (is_new) samplers_.emplace_back(address(use.wrap_u), address(use.wrap_v), use.nearest, anisotropy_);
  return place->second;
}

void GpuScene::bind_material(int material) const {
  bound_material_ = material;
  for (const Slot& slot : slots_[material]) {
    const bool none = slot.texture < 0;
    (none ? white_ : textures_[slot.texture]).bind(slot.unit);
    none ? gl::Sampler::unbind(slot.unit) : samplers_[slot.sampler].bind(slot.unit);
  }
}

}  // namespace ssphh::realtime
