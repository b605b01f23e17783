#include "virtual_light_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::realtime {
namespace {

using methods::vpl::Vpl;

constexpr int largest_map = 256, smallest_map = 32;
/// Of one pass over the picture: drivers stop what keeps a GPU for seconds.
constexpr int lights_per_pass = 256;

/// Whether a face can see anything in front of the light: one of its corners is.
bool in_front(const MapView& face, const vec3& normal) {
  return glm::dot(face.forward, normal) + std::abs(glm::dot(face.right, normal)) +
             std::abs(glm::dot(face.up, normal)) >
         0;
}

}  // namespace

VirtualMapPlan plan_virtual_maps(std::size_t lights, std::size_t most_bytes) {
  const auto fits = [&](int size, std::size_t n) {
    return MapAtlas::bytes_of(size, static_cast<int>(6 * n)) <= most_bytes;
  };
  // No more than could stand in `most_bytes` without any waste: counts of tiles stay small integers.
  const auto room = [&](int size) {
    const auto face = static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * sizeof(float);
    return std::min<std::size_t>(most_bytes / (6 * face), std::numeric_limits<int>::max() / 6);
  };
  for (int size = largest_map; size >= smallest_map; size /= 2) {
    if (lights <= room(size) && fits(size, lights)) return {size, static_cast<int>(lights)};
  }
  std::size_t low = 0, high = room(smallest_map) + 1;  // low fits, high does not
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (fits(smallest_map, middle) ? low : high) = middle;
  }
  return {smallest_map, static_cast<int>(low)};
}

VirtualLightMaps::VirtualLightMaps(const methods::VirtualLights& data, std::size_t most_bytes,
                                   const scene::Bounds& bounds, FrameCounters& counters)
    : most_bytes_(most_bytes), near_(cube_near(bounds)) {
  take(data, counters);
}

bool VirtualLightMaps::take(const methods::LightData& data, FrameCounters& counters) {
  const auto* given = std::get_if<methods::VirtualLights>(&data);
  if (!given) return false;
  const VirtualMapPlan plan = plan_virtual_maps(given->lights.size(), most_bytes_);
  if (plan.lights == 0 && !given->lights.empty())
    throw Error("method vpl", fmt::format("{} bytes hold no shadow map of a virtual light", most_bytes_));
  params_ = given->params;
  std::vector<Vpl> before = std::move(lights_);
  lights_ = methods::vpl::merge_lights(given->lights, static_cast<std::size_t>(plan.lights));
  if (plan.size != maps_.size() || 6 * plan.lights > maps_.count()) {
    maps_ = MapAtlas();  // first: the two would not always fit side by side
    maps_ = MapAtlas(plan.size, std::max(6 * plan.lights, 1));
    before.clear();
  }
  // Where a light stands as before, its map holds.
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const bool same = i < before.size() && before[i].position == lights_[i].position &&
                      before[i].normal == lights_[i].normal;
    if (!same) place(i);
  }
  for (int tile = 6 * plan.lights; tile < maps_.count(); ++tile) maps_.set_view(tile, {}, false);

  std::vector<GpuVirtualLight> gpu;
  for (const Vpl& light : lights_)
    gpu.push_back({vec4(light.position, light.radius), vec4(light.normal, 0), vec4(light.power / pi, 0)});
  buffer_.reserve(gpu.size() * sizeof(GpuVirtualLight));
  upload(counters, buffer_, std::span<const GpuVirtualLight>(gpu));
  return true;
}

void VirtualLightMaps::place(std::size_t light) {
  for (int face = 0; face < 6; ++face) {
    const MapView view = cube_view(lights_[light].position, face, near_);
    maps_.set_view(6 * static_cast<int>(light) + face, view, in_front(view, lights_[light].normal));
  }
}

int VirtualLightMaps::passes() const {
  return (static_cast<int>(lights_.size()) + lights_per_pass - 1) / lights_per_pass;
}

void VirtualLightMaps::bind(gl::Program& program, int pass) const {
  const int first = pass * lights_per_pass;
  const int end = std::min(first + lights_per_pass, static_cast<int>(lights_.size()));
  maps_.texture().bind(unit::virtual_light_maps);
  buffer_.bind_storage(binding::virtual_lights);
  program.set("lights_drawn", first, end);
  program.set("map_layout", maps_.size(), maps_.layout().columns_log2);
  program.set("map_near", near_);
  program.set("spheres", params_.kind == methods::vpl::VplKind::sphere ? 1 : 0);
  const float least2 = params_.least_distance * params_.least_distance;
  program.set("most_transfer", least2 > 0 ? 1 / least2 : std::numeric_limits<float>::max());
}

methods::MethodNumbers VirtualLightMaps::numbers() const {
  return {{"gl_bytes", static_cast<double>(bytes())},
          {"gl_lights", static_cast<double>(lights_.size())},
          {"gl_map_size", maps_.size()}};
}

}  // namespace ssphh::realtime
