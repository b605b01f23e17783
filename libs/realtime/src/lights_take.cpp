/// Lights in place of those of before: maps that are drawn, and a sky that is looked through, are kept.

#include <utility>

#include "lights.h"

namespace ssphh::realtime {

void Lights::place_all(const std::vector<mat4>& world) {
  for (Source& source : sources_) {
    place(source, source.light >= 0 ? states_[source.light].world : node_matrix(world, source.node));
  }
  place_environment(bounds_of_scene_);
}

void Lights::take_from(Lights& before, const std::vector<mat4>& world) {
  const auto take = [](MapAtlas& to, MapAtlas& from, bool as_many) {
    if (!as_many) return to.keep(std::move(from));
    to = std::move(from);
    to.want(0, to.count(), true);
  };
  take(lamps_, before.lamps_, same_lamp_maps(before));
  take(areas_, before.areas_, same_area_maps(before));
  const bool suns = same_sun_maps(before);
  take(suns_, before.suns_, suns);
  if (suns) bounds_ = std::move(before.bounds_);
  take(skies_, before.skies_, same_sky_maps(before));
  if (same_sky_ && before.environment_) {
    environment_ = std::move(before.environment_);
    own_environment_ = std::move(before.own_environment_);
    other_image_ = before.other_image_;
    directions_ = before.directions_, sky_irradiance_ = before.sky_irradiance_, turn_ = before.turn_;
    show_directions();
  }
  place_all(world);
}

}  // namespace ssphh::realtime
