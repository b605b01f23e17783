#pragma once
/// Scenes of given meshes, and atlases of fields in closed form.

#include <functional>

#include <ssphh/lightmap/light.h>
#include <ssphh/lightmap/plan.h>
#include <ssphh/scene/primitives.h>

#include "ray_source.h"

namespace ssphh::lightmap {

inline const test::RaySource open_space([](const vec3&, const vec3&) { return rays::RayHit{}; });

inline scene::Scene scene_of(const std::vector<scene::Mesh>& meshes, const mat4& matrix = mat4(1)) {
  scene::Scene scene;
  for (const scene::Mesh& mesh : meshes) {
    scene.instances.push_back(
        {static_cast<int>(scene.meshes.size()), static_cast<int>(scene.nodes.size()), -1, ""});
    scene.nodes.emplace_back().matrix = matrix;
    scene.meshes.push_back(mesh);
  }
  return scene;
}

struct Unwrapped {
  scene::Scene scene;
  Charts charts;
  Layout layout;
  Texels texels;

  explicit Unwrapped(scene::Scene of, const LayoutParams& params = {.size = 256}, const ChartParams& by = {})
      : scene(std::move(of)),
        charts(make_charts(scene, 0, by)),
        layout(lay_out(charts.charts, params)),
        texels(make_texels(scene, 0, charts.charts, layout)) {}
  explicit Unwrapped(Plan plan)
      : scene(std::move(plan.scene)),
        charts(std::move(plan.charts)),
        layout(std::move(plan.layout)),
        texels(make_texels(scene, 0, charts.charts, layout)) {}

  image::Image atlas(const IrradianceAt& field, const rays::TransportSource& source = open_space) const {
    return light_texels(texels, find_places(texels, rays::PosedWorld(source, 0)), field);
  }
  /// Of the atlas at a place of a face, by shares of its corners.
  vec3 looked_up(const image::Image& atlas, const Face& face, const vec3& share) const {
    const vec2 at = share.x * face.at[0] + share.y * face.at[1] + share.z * face.at[2];
    return sample(atlas, at / vec2(atlas.width, atlas.height));
  }
};

inline vec3 point(const std::array<vec3, 3>& corners, const vec3& share) {
  return share.x * corners[0] + share.y * corners[1] + share.z * corners[2];
}

inline vec3 value_of(const image::Image& atlas, std::uint32_t index) {
  const auto w = static_cast<std::uint32_t>(atlas.width);
  return atlas.rgb(static_cast<int>(index % w), static_cast<int>(index / w));
}

/// Shares of a triangle's corners: the corners, middles of edges, and places inside.
inline std::vector<vec3> shares() {
  std::vector<vec3> out;
  constexpr int steps = 4;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) out.push_back(vec3(i, j, steps - i - j) / static_cast<float>(steps));
  return out;
}

}  // namespace ssphh::lightmap
