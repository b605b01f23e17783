#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/error.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/scene/light_mode.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {

std::optional<LightMode> asked_light_mode(const Scene& scene, const std::string& group) {
  const auto found = std::ranges::find(scene.light_modes, group, &GroupMode::group);
  if (found == scene.light_modes.end()) return std::nullopt;
  return found->mode;
}

bool casts_sharp_shadows(const Environment& environment) {
  constexpr double small = 0.02, share = 0.1;
  const image::Image& image = environment.equirect;
  struct Texel {
    double radiance, solid_angle;
  };
  std::vector<Texel> texels;
  double all = 0;
  for (int y = 0; y < image.height; ++y) {
    const double solid_angle = image::equirect_solid_angle(y, image.width, image.height);
    for (int x = 0; x < image.width; ++x) {
      texels.push_back({static_cast<double>(luminance(environment.color * image.rgb(x, y))), solid_angle});
      all += texels.back().radiance * solid_angle;
    }
  }
  std::ranges::sort(texels, std::greater(), &Texel::radiance);
  double brightest = 0, left = small;
  for (const Texel& texel : texels) {
    brightest += texel.radiance * std::min(texel.solid_angle, left);
    left -= texel.solid_angle;
    if (left <= 0) break;
  }
  return brightest >= share * all && all > 0;
}

LightMode usual_light_mode(const Scene& scene, const std::string& group) {
  if (!scene.environment || light_group(*scene.environment) != group) return LightMode::realtime;
  const bool lamps =
      std::ranges::any_of(scene.lights, [&](const Light& light) { return light_group(light) == group; });
  const bool surfaces = std::ranges::any_of(scene.instances, [&](const Instance& instance) {
    return is_emitter(scene, instance) && light_group(scene, instance) == group;
  });
  const bool alone = !lamps && !surfaces;
  return alone && !casts_sharp_shadows(*scene.environment) ? LightMode::diffuse : LightMode::realtime;
}

std::vector<LightMode> light_modes(const Scene& scene) {
  std::vector<LightMode> modes;
  for (const std::string& group : light_groups(scene)) {
    const std::optional<LightMode> asked = asked_light_mode(scene, group);
    modes.push_back(asked ? *asked : usual_light_mode(scene, group));
  }
  return modes;
}

void set_light_mode(Scene& scene, const std::string& group, LightMode mode) {
  const std::vector<std::string> groups = light_groups(scene);
  if (std::ranges::find(groups, group) == groups.end())
    throw Error(fmt::format("light mode of \"{}\"", group), "the scene has no light group of that name",
                groups.empty() ? "it has no lights" : fmt::format("its groups: {}", fmt::join(groups, ", ")));
  const auto found = std::ranges::find(scene.light_modes, group, &GroupMode::group);
  if (found == scene.light_modes.end()) {
    scene.light_modes.push_back({group, mode});
  } else {
    found->mode = mode;
  }
}

std::vector<std::string> drop_unused_light_modes(Scene& scene) {
  const std::vector<std::string> groups = light_groups(scene);
  std::vector<std::string> dropped;
  std::erase_if(scene.light_modes, [&](const GroupMode& asked) {
    const bool unused = std::ranges::find(groups, asked.group) == groups.end();
    if (unused) dropped.push_back(asked.group);
    return unused;
  });
  return dropped;
}

}  // namespace ssphh::scene
