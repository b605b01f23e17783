#include "seen_places.h"

#include <algorithm>
#include <cmath>

#include <ssphh/gl/draw.h>

namespace ssphh::realtime {
namespace {

float in_steps(float depth, float (*round)(float)) {
  return std::exp2(0.5f * round(2 * std::log2(depth)));
}

}  // namespace

SeenPlaces::SeenPlaces()
    : some_(gl::Format::rgba32f, width, height),
      target_(std::array<const gl::Texture*, 1>{&some_}, nullptr) {}

Seen SeenPlaces::measure(Shaders& shaders, const gl::VertexArray& no_vertices) {
  gl::bind_framebuffer(target_.id(), {0, 0, width, height});
  gl::apply({});
  gl::Program& program = shaders.some_places();
  program.set("size", width, height);
  program.use();
  no_vertices.bind();
  gl::draw_triangles(3);
  some_.read(std::span<float>(&places_[0].x, 4 * count), 4);
  const auto end = std::remove_if(places_.begin(), places_.end(), [](const vec4& p) { return !(p.w > 0); });
  const auto seen = end - places_.begin();
  if (seen == 0) return {};
  std::transform(places_.begin(), end, depths_.begin(), [](const vec4& p) { return p.w; });
  const auto share = [&](std::ptrdiff_t part, std::ptrdiff_t of) {
    const auto at = depths_.begin() + part * (seen - 1) / of;
    std::nth_element(depths_.begin(), at, depths_.begin() + seen);
    return *at;
  };
  return {in_steps(share(1, 50), std::floor), in_steps(share(9, 10), std::ceil),
          in_steps(share(1, 1), std::ceil), std::span<const vec4>(places_.begin(), end)};
}

}  // namespace ssphh::realtime
