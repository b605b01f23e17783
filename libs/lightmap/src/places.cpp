#include <algorithm>
#include <array>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/lightmap/light.h>

#include "flat.h"

namespace ssphh::lightmap {
namespace {

constexpr std::size_t sight_rays = 24;
/// More backs than that, and a place lies within a body: one before a crack between bodies sees fewer.
constexpr float most_backs = 0.3f;
/// More surfaces nearer than a texel than that, and a place lies under another body: where three walls meet
/// there are three quarters.
constexpr float most_near = 0.8f;
/// Rays start so far above their surface, of the world's size.
constexpr float lift = 1e-5f;

/// Other places of a texel than its own, in texels.
constexpr std::array<vec2, 8> nearby = {vec2(0.35f, 0),      vec2(-0.35f, 0),     vec2(0, 0.35f),
                                        vec2(0, -0.35f),     vec2(0.35f, 0.35f),  vec2(-0.35f, 0.35f),
                                        vec2(0.35f, -0.35f), vec2(-0.35f, -0.35f)};

float texel_edge(const Face& face) {
  const float flat = std::abs(cross(face.at[1] - face.at[0], face.at[2] - face.at[0]));
  const float surface =
      glm::length(glm::cross(face.position[1] - face.position[0], face.position[2] - face.position[0]));
  return flat > 0 ? std::sqrt(surface / flat) : 0;
}

/// Whether anybody could see a place from before its surface.
bool is_open(const rays::PosedWorld& world, const vec3& place, const vec3& front, float edge, float gap) {
  const Frame frame = Frame::around(front);
  std::array<rays::RayQuery, sight_rays> rays;
  std::array<rays::RayHit, sight_rays> hits;
  for (std::size_t i = 0; i < sight_rays; ++i) {
    const vec3 direction = spherical_fibonacci(static_cast<int>(i), 2 * sight_rays);
    rays[i] = {place + gap * front, frame.to_world(vec3(direction.x, direction.y, std::abs(direction.z)))};
  }
  world.intersect(rays, hits);
  const auto share = [&](const auto& is) {
    return static_cast<float>(std::ranges::count_if(hits, is)) / static_cast<float>(sight_rays);
  };
  return share([](const rays::RayHit& hit) { return !hit.escaped() && hit.back; }) <= most_backs &&
         share([&](const rays::RayHit& hit) { return hit.distance < edge; }) <= most_near;
}

std::uint8_t reached_places(const Texels& texels, const Texel& texel, const vec3& from,
                            const rays::PosedWorld& world, float gap) {
  const vec3 up = gap * texels.faces[texel.face].front;
  std::uint8_t reached = 0;
  for (int k = 0; k < places_within; ++k)
    if (world.visible(from + up, place_within(texels, texel, k).position + up))
      reached = static_cast<std::uint8_t>(reached | 1 << k);
  return reached;
}

}  // namespace

rays::SurfacePoint place_within(const Texels& texels, const Texel& texel, int k) {
  require(k >= 0 && k < places_within, "lightmap", "a texel has no such place");
  constexpr std::array<vec2, places_within> at = {vec2(-0.1875f, -0.0625f), vec2(0.0625f, -0.1875f),
                                                  vec2(0.1875f, 0.0625f), vec2(-0.0625f, 0.1875f)};
  return place_of(texels, texel, at[static_cast<std::size_t>(k)]);
}

Places find_places(const Texels& texels, const rays::PosedWorld& world, const Control& control) {
  const std::size_t count = texels.texels.size();
  for (const Texel& texel : texels.texels)
    require(texel.face < texels.faces.size(), "lightmap texels", "a texel is of no face");
  Places out{std::vector<rays::SurfacePoint>(count), std::vector<std::uint8_t>(count, 0),
             std::vector<std::uint8_t>(count, 0), 0};
  const scene::Bounds& bounds = world.bounds();
  const float gap = lift * (bounds.empty() ? 0 : bounds.radius() + max_component(glm::abs(bounds.center())));
  ProgressStage stage(control, "places of texels", count, "texels");
  parallel_for(
      count, 256,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Texel& texel = texels.texels[i];
          const Face& face = texels.faces[texel.face];
          const float edge = texel_edge(face);
          const auto open = [&](const rays::SurfacePoint& place) {
            return is_open(world, place.position, face.front, edge, gap);
          };
          out.points[i] = place_of(texels, texel);
          if (open(out.points[i])) {
            out.reached[i] = reached_places(texels, texel, out.points[i].position, world, gap);
            continue;
          }
          const auto other = std::ranges::find_if(
              nearby, [&](const vec2& step) { return open(place_of(texels, texel, step)); });
          if (other != nearby.end()) {
            out.points[i] = place_of(texels, texel, *other);
            out.reached[i] = reached_places(texels, texel, out.points[i].position, world, gap);
          } else {
            out.hidden[i] = 1;
          }
        }
        stage.advance(end - begin);
      },
      control);
  for (const std::uint8_t hidden : out.hidden) out.hidden_count += hidden;
  return out;
}

}  // namespace ssphh::lightmap
