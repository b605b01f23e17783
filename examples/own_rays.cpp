// An engine's own ray tracer in place of Embree's: probes that follow lamps, lit by whatever meets rays.
// Links ssphh::transport alone.

#include <cmath>
#include <cstdio>

#include <ssphh/core/math.h>
#include <ssphh/rays/transport_source.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/transport/relight_session.h>

using namespace ssphh;

namespace {

// What comes straight from emitters: here from the walls, which all glow with radiance 1.
struct Glow final : rays::DirectLight {
  void irradiance(int, std::span<const rays::SurfacePoint>, std::span<vec3> out) const override {
    for (vec3& e : out) e = vec3(pi);
  }
};

// A round room of radius 2 whose walls reflect half of the light. What moves and lamps that turn would be
// more of these functions.
class RoundRoom final : public rays::TransportSource {
 public:
  scene::Bounds part_bounds(int) const override { return {vec3(-radius), vec3(radius)}; }
  void intersect(int, std::span<const rays::RayQuery> rays, std::span<rays::RayHit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto& [origin, direction, t_max] = rays[i];
      const float a = glm::dot(direction, direction), b = glm::dot(origin, direction);
      const float c = glm::dot(origin, origin) - radius * radius;
      const float t = (-b + std::sqrt(std::max(b * b - a * c, 0.0f))) / a;
      hits[i] = {};
      if (!(t > 0) || t >= t_max) continue;
      hits[i].distance = t;
      hits[i].normal = -glm::normalize(origin + t * direction);
      hits[i].albedo = vec3(0.5f);
      hits[i].emission = vec3(1);
      hits[i].group = 0;
    }
  }
  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::unique_ptr<rays::DirectLight> direct_light(std::span<const scene::LightState>, std::span<const mat4>,
                                                  const scene::EnvironmentState&) const override {
    return std::make_unique<Glow>();
  }

 private:
  static constexpr float radius = 2;
  std::vector<std::string> groups_ = {"walls"};
};

}  // namespace

int main() {
  const RoundRoom room;
  transport::RelightSession session(room, {{"middle", vec3(0)}, {"aside", vec3(1, 0.5f, 0)}});
  scene::LightingState state = session.lighting();
  for (const float strength : {1.0f, 0.25f}) {
    state.group_scales[0] = vec3(strength);
    session.update(state);
    // Half of a half of a half ... comes back: pi times the strength
    const sh::RadianceSh& light = session.reflected()[1];
    std::printf("walls at %.2f: indirect irradiance %.2f W/m2\n", static_cast<double>(strength),
                static_cast<double>(sh::irradiance(light, vec3(0, 1, 0)).x));
  }
}
