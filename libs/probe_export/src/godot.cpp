#include <algorithm>
#include <bit>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/math.h>
#include <ssphh/geometry/tetrahedra.h>

#include "bsp.h"
#include "writers.h"

namespace ssphh::probe_export {
namespace {

/// Beyond the surfaces, in shares of their box: what is drawn lies within the corners that are added.
constexpr float margin = 0.01f;

std::size_t nearest_probe(const probes::ProbeSet& set, const vec3& place) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < set.probes.size(); ++i) {
    if (glm::distance(set.probes[i].position, place) < glm::distance(set.probes[best].position, place))
      best = i;
  }
  return best;
}

template <class Numbers>
std::string packed(const char* type, const Numbers& numbers) {
  return fmt::format("{}({})", type, fmt::join(numbers, ", "));
}

}  // namespace

Exported write_godot(const ExportSource& source, const std::string&, const Control& control) {
  const probes::ProbeSet& set = source.set;
  probes::LookupParams params;
  params.light = source.light;
  std::vector<sh::RadianceSh> light = probes::surface_light(set, params);
  std::vector<vec3> points;
  scene::Bounds box = rays::PosedWorld(source.scene, set.generator.time).bounds();
  for (const probes::Probe& probe : set.probes) points.push_back(probe.position), box.add(points.back());
  const vec3 more = vec3(margin * std::max(max_component(box.max - box.min), 1.0f));
  box.min -= more, box.max += more;
  // Outside of all tetrahedra Godot finds no light.
  for (int k = 0; k < 8; ++k) {
    const vec3 corner = glm::mix(box.min, box.max, glm::bvec3(k & 1, k >> 1 & 1, k >> 2));
    light.push_back(light[nearest_probe(set, corner)]);
    points.push_back(corner);
  }
  control.check();
  const geometry::Tetrahedra cells(points);
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  for (const geometry::Tetrahedron& cell : cells.cells()) tetrahedra.push_back(cells.corners(cell));
  const std::vector<BspNode> nodes = make_bsp(points, tetrahedra);

  std::vector<float> places, colors;
  std::vector<std::int32_t> corners, bsp;
  for (std::size_t i = 0; i < points.size(); ++i) {
    places.insert(places.end(), {points[i].x, points[i].y, points[i].z});
    light[i].values.resize(static_cast<std::size_t>(sh::coefficient_count(2)), vec3(0));
    // Godot's materials multiply with the albedo alone, so that the π is within.
    for (const vec3& v : light[i].values) colors.insert(colors.end(), {v.x / pi, v.y / pi, v.z / pi, 1.0f});
  }
  for (const auto& t : tetrahedra) corners.insert(corners.end(), t.begin(), t.end());
  for (const BspNode& node : nodes) {
    for (const float f : {node.normal.x, node.normal.y, node.normal.z, node.offset})
      bsp.push_back(std::bit_cast<std::int32_t>(f));
    bsp.insert(bsp.end(), {node.over, node.under});
  }
  const vec3 size = box.max - box.min;
  const std::string text = fmt::format(
      "[gd_resource type=\"LightmapGIData\" format=3]\n\n[resource]\nprobe_data = {{\n"
      "\"baked_exposure\": 1.0,\n\"bounds\": AABB({}, {}, {}, {}, {}, {}),\n\"bsp\": {},\n\"interior\": "
      "false,\n"
      "\"points\": {},\n\"sh\": {},\n\"tetrahedra\": {}\n}}\n",
      box.min.x, box.min.y, box.min.z, size.x, size.y, size.z, packed("PackedInt32Array", bsp),
      packed("PackedVector3Array", places), packed("PackedColorArray", colors),
      packed("PackedInt32Array", corners));
  return {{{"", bytes_of(text)}},
          points.size(),
          8,
          {fmt::format("{} tetrahedra, {} planes; the last 8 points are corners of the scene's box with the "
                       "light of the nearest probe",
                       tetrahedra.size(), nodes.size()),
           "lights dynamic objects alone: Godot takes lightmaps for static ones"}};
}

}  // namespace ssphh::probe_export
