#include "frame_block.h"

#include <algorithm>
#include <cmath>

namespace ssphh::realtime {

FrameBlock frame_block(const Eye& eye, const FrameSettings& settings, const FrameImages& images,
                       const Lights& lights, const Probes& probes, const scene::Bounds& bounds) {
  const gl::Rect full = images.full();
  // Depth has the precision of floats at every distance: the near plane may be as near as one likes
  const float far = 1.01f * (glm::length(bounds.center() - eye.position) + bounds.radius()) + 1e-3f;
  const float near = 1e-4f * std::max(bounds.radius(), 1e-3f);

  FrameBlock b{};
  b.camera_position = vec4(eye.position, eye.orthographic ? 1 : 0);
  b.camera_right = vec4(eye.right, static_cast<float>(full.width));
  b.camera_up = vec4(eye.up, static_cast<float>(full.height));
  b.camera_forward = vec4(eye.forward, eye.orthographic ? far : near);
  const probes::CandidateGrid& grid = probes.grid();
  b.grid_size = ivec4(grid.cells, grid.length);
  b.grid_origin = vec4(grid.origin, grid.cell_size);
  b.tone = vec4(std::exp2(settings.tone.exposure), settings.tone.curve == image::ToneCurve::filmic ? 1 : 0,
                settings.tone.gamma > 0 ? 1 / settings.tone.gamma : 0,
                std::isfinite(probes.spacing()) ? probes.spacing() : 1e30f);
  const float turn = lights.environment_rotation();
  b.environment = vec4(std::cos(turn), std::sin(turn), 0, static_cast<float>(settings.view));
  b.maps = ivec4(lights.lamp_maps().size(), lights.area_maps().size(), probes.maps().size(), 0);
  b.map_tiles = ivec4(lights.lamp_maps().layout().columns_log2, lights.area_maps().layout().columns_log2,
                      probes.maps().layout().columns_log2, 0);
  b.map_near = vec4(lights.near_plane(), lights.near_plane(), probes.near_plane(), 0);
  b.shift = vec4(eye.shift, 0, 0);
  b.extra = vec4(settings.ambient_occlusion ? settings.occlusion_radius : 0,
                 static_cast<float>(images.indirect_scale), settings.indirect_tolerance, 0);
  return b;
}

mat4 clip_matrix(const FrameBlock& b) {
  const vec3 eye(b.camera_position), right(b.camera_right), up(b.camera_up), forward(b.camera_forward);
  const bool orthographic = b.camera_position.w != 0;
  const auto along = [&](const vec3& axis) { return vec4(axis, -glm::dot(axis, eye)); };
  const vec4 x = along(right / glm::dot(right, right)), y = along(up / glm::dot(up, up)), z = along(forward);
  const vec4 one(0, 0, 0, 1), plane = orthographic ? one : z;  // w of clip space
  const vec4 moved_x = x + b.shift.x * plane, moved_y = y + b.shift.y * plane;
  return glm::transpose(orthographic ? mat4(moved_x, moved_y, one - z / b.camera_forward.w, one)
                                     : mat4(moved_x, moved_y, b.camera_forward.w * one, z));
}

}  // namespace ssphh::realtime
