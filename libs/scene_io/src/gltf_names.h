#pragma once
/// Words of glTF for choices that a scene makes, read and written alike.

#include <ssphh/core/enum_names.h>
#include <ssphh/core/json_cursor.h>
#include <ssphh/scene/scene.h>

#include "printable.h"

namespace ssphh::scene_io {

inline constexpr auto gltf_alpha_modes =
    std::to_array<EnumName<scene::AlphaMode>>({{scene::AlphaMode::opaque, "OPAQUE"},
                                               {scene::AlphaMode::mask, "MASK"},
                                               {scene::AlphaMode::blend, "BLEND"}});

inline constexpr auto gltf_animation_paths =
    std::to_array<EnumName<scene::AnimationPath>>({{scene::AnimationPath::translation, "translation"},
                                                   {scene::AnimationPath::rotation, "rotation"},
                                                   {scene::AnimationPath::scale, "scale"}});

inline constexpr auto gltf_interpolations =
    std::to_array<EnumName<scene::Interpolation>>({{scene::Interpolation::linear, "LINEAR"},
                                                   {scene::Interpolation::step, "STEP"},
                                                   {scene::Interpolation::cubic_spline, "CUBICSPLINE"}});

/// Of KHR_lights_punctual; the others are extras of a point light.
inline constexpr auto gltf_light_types =
    std::to_array<EnumName<scene::LightType>>({{scene::LightType::point, "point"},
                                               {scene::LightType::spot, "spot"},
                                               {scene::LightType::directional, "directional"}});

inline constexpr std::pair<scene::Wrap, unsigned> gltf_wraps[] = {
    {scene::Wrap::repeat, 10497}, {scene::Wrap::mirror, 33648}, {scene::Wrap::clamp, 33071}};

/// The value of the word that stands there; fails with the words there are.
template <class E, std::size_t N>
E read_word(const std::array<EnumName<E>, N>& words, const json::Cursor& at) {
  const std::optional<E> value = value_in(words, at.text());
  if (!value) at.fail(none_of(printable(at.text(), 40), names_in(words)));
  return *value;
}

}  // namespace ssphh::scene_io
