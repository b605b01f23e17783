#include "view_depths.h"

#include <algorithm>
#include <cmath>

#include <ssphh/gl/draw.h>

namespace ssphh::realtime {
namespace {

float in_steps(float depth, float (*round)(float)) {
  return std::exp2(0.5f * round(2 * std::log2(depth)));
}

}  // namespace

ViewDepths::ViewDepths()
    : some_(gl::Format::r32f, width, height), target_(std::array<const gl::Texture*, 1>{&some_}, nullptr) {}

DepthSpread ViewDepths::measure(Shaders& shaders, const gl::VertexArray& no_vertices) {
  gl::bind_framebuffer(target_.id(), {0, 0, width, height});
  gl::apply({});
  gl::Program& program = shaders.some_depths();
  program.set("size", width, height);
  program.use();
  no_vertices.bind();
  gl::draw_triangles(3);
  some_.read(depths_, 1);
  const auto seen = std::remove(depths_.begin(), depths_.end(), 0.0f);
  const auto count = seen - depths_.begin();
  if (count == 0) return {};
  const auto share = [&](std::ptrdiff_t part, std::ptrdiff_t of) {
    const auto at = depths_.begin() + part * (count - 1) / of;
    std::nth_element(depths_.begin(), at, seen);
    return *at;
  };
  return {in_steps(share(1, 50), std::floor), in_steps(share(9, 10), std::ceil),
          in_steps(share(1, 1), std::ceil)};
}

}  // namespace ssphh::realtime
