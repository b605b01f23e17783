#include "relocate.h"

namespace ssphh::place {
namespace {

constexpr int relocation_steps = 5;

}  // namespace

std::optional<Relocated> relocate(const rays::TransportSource& source, const vec3& position,
                                  const Site& first, const SiteRules& rules, float limit) {
  Relocated now{position, first};
  for (int step = 0; step < relocation_steps && !valid(now.site, rules); ++step) {
    if (inside_body(now.site, rules)) {
      if (!(now.site.nearest_back > 0)) return std::nullopt;
      const vec3 out = now.site.nearest_back_hit / now.site.nearest_back;
      now.position += now.site.nearest_back_hit + 2 * rules.clearance * out;
    } else {
      // The ray that met the surface first may be slanted: what is missing is missing along the normal.
      now.position += (1.5f * rules.clearance - now.site.nearest) * now.site.nearest_normal +
                      0.5f * rules.clearance * now.site.nearest_normal;
    }
    if (!is_finite(now.position) || glm::distance(now.position, position) > limit) return std::nullopt;
    now.site = look_around(source, now.position);
  }
  if (!valid(now.site, rules)) return std::nullopt;
  return now;
}

std::optional<Relocated> sidestep(const rays::TransportSource& source, const vec3& position,
                                  const SiteRules& rules, float limit,
                                  const std::function<bool(const vec3&)>& free) {
  for (const float share : {0.25f, 0.5f, 0.75f, 1.0f}) {
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          if (x == 0 && y == 0 && z == 0) continue;
          const vec3 to = position + share * limit * glm::normalize(vec3(x, y, z));
          if (!free(to)) continue;
          const Site site = look_around(source, to);
          if (!valid(site, rules)) continue;
          // Around a corner, and not to the wall's other side.
          const rays::RayQuery way{position, to - position, 1};
          std::uint8_t blocked = 0;
          source.occluded(0, {&way, 1}, {&blocked, 1});
          if (blocked == 0) return Relocated{to, site};
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace ssphh::place
