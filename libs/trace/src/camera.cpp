#include "camera.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/trace/primary_rays.h>

namespace ssphh::trace {

CameraRays::CameraRays(const RenderParams& params)
    : projection_(params.projection),
      width_(static_cast<float>(params.width)),
      height_(static_cast<float>(params.height)) {
  const mat4& world = params.camera.world;
  const scene::Camera& camera = params.camera.camera;
  origin_ = vec3(world[3]);
  right_ = glm::normalize(vec3(world[0]));
  up_ = glm::normalize(vec3(world[1]));
  forward_ = -glm::normalize(vec3(world[2]));
  const bool axes_used = projection_ == Projection::pinhole || projection_ == Projection::orthographic;
  if (!is_finite(origin_) || (axes_used && !(is_finite(right_) && is_finite(up_) && is_finite(forward_)))) {
    throw Error("camera \"" + camera.name + "\"", "its pose is not finite or has no extent");
  }
  if (projection_ == Projection::pinhole) {
    if (!(camera.yfov > 0 && camera.yfov < pi)) {
      throw Error("camera \"" + camera.name + "\"",
                  "the vertical field of view must lie between 0 and 180 degrees");
    }
    half_extent_.y = std::tan(0.5f * camera.yfov);
  } else if (projection_ == Projection::orthographic) {
    if (!(camera.yheight > 0) || !std::isfinite(camera.yheight)) {
      throw Error("camera \"" + camera.name + "\"", "the height of an orthographic view must be positive");
    }
    half_extent_.y = 0.5f * camera.yheight;
  } else if (projection_ == Projection::cube_strip && params.width != 6 * params.height) {
    throw Error("render size", "a cube strip is six times as wide as it is high");
  }
  half_extent_.x = half_extent_.y * width_ / height_;
}

Ray CameraRays::ray(float x, float y) const {
  const float u = x / width_, v = y / height_;
  const vec2 plane = half_extent_ * vec2(2 * u - 1, 1 - 2 * v);
  switch (projection_) {
    case Projection::pinhole:
      return {origin_, glm::normalize(plane.x * right_ + plane.y * up_ + forward_)};
    case Projection::orthographic:
      return {origin_ + plane.x * right_ + plane.y * up_, forward_};
    case Projection::equirect:
      return {origin_, image::equirect_direction(u, v)};
    case Projection::cube_strip: {
      const float face = std::min(std::floor(6 * u), 5.0f);
      return {origin_, cube_direction({static_cast<int>(face), 6 * u - face, v})};
    }
  }
  refuse("projection", "there is none of that number");
}

float CameraRays::depth(const Ray& ray, float distance) const {
  const bool has_axis = projection_ == Projection::pinhole || projection_ == Projection::orthographic;
  return has_axis ? distance * glm::dot(ray.direction, forward_) : distance;
}

std::function<rays::RayQuery(float x, float y)> primary_rays(const RenderParams& params) {
  const bool sphere =
      params.projection == Projection::equirect || params.projection == Projection::cube_strip;
  const vec2 size(params.width, params.height);
  return [rays = CameraRays(params), sphere, size](float x, float y) -> rays::RayQuery {
    if (sphere) x = std::clamp(x, 0.0f, size.x), y = std::clamp(y, 0.0f, size.y);
    const Ray ray = rays.ray(x, y);
    return {ray.origin, ray.direction};
  };
}

}  // namespace ssphh::trace
