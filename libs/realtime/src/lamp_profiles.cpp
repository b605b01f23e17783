#include "lamp_profiles.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "gpu_types.h"

namespace ssphh::realtime {
namespace {

/// Every half degree from the pole and every degree about it: where files have angles.
constexpr int polar_steps = 361, turn_steps = 361;

}  // namespace

LampProfiles::LampProfiles(const std::vector<scene::Light>& lights) {
  int height = 1;
  for (const scene::Light& light : lights) {
    if (!light.has_profile() || layer(light) >= 0) continue;
    profiles_.push_back(light.profile);
    if (light.profile.table->turn.size() > 1) height = turn_steps;
  }
  if (profiles_.empty()) return;
  texture_ = gl::Texture(gl::Format::r16f, polar_steps, height, static_cast<int>(profiles_.size()));
  texture_.set_filter(true);
  std::vector<float> shares;
  for (std::size_t i = 0; i < profiles_.size(); ++i) {
    const scene::PhotometricTable& table = *profiles_[i].table;
    const float scale = 1 / scene::greatest_candela(table);
    shares.clear();
    for (int row = 0; row < height; ++row) {
      const float turn = 2 * pi * static_cast<float>(row) / (turn_steps - 1);
      for (int column = 0; column < polar_steps; ++column) {
        const float polar = pi * static_cast<float>(column) / (polar_steps - 1);
        const vec3 direction(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                             std::cos(polar));
        shares.push_back(scale * scene::eval_candela(table, direction));
      }
    }
    texture_.upload(std::as_bytes(std::span<const float>(shares)), static_cast<int>(i));
  }
}

int LampProfiles::layer(const scene::Light& light) const {
  if (!light.has_profile()) return -1;
  const auto known = std::ranges::find(profiles_, light.profile);
  return known == profiles_.end() ? -1 : static_cast<int>(known - profiles_.begin());
}

void LampProfiles::bind() const {
  if (texture_.id()) texture_.bind(unit::lamp_profiles);
}

}  // namespace ssphh::realtime
