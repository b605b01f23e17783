#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/error.h>
#include <ssphh/core/math.h>
#include <ssphh/core/require.h>
#include <ssphh/lightmap/chart.h>

#include "flat.h"
#include "joined.h"
#include "least_rectangle.h"
#include "overlap.h"

namespace ssphh::lightmap {
namespace {

FlatCorners uv_corners(const scene::Mesh& mesh, const uvec3& t) {
  const std::vector<vec2>& uvs = mesh.uvs[1];
  return {uvs[t.x], uvs[t.y], uvs[t.z]};
}

float area(const FlatCorners& t) {
  return 0.5f * std::abs(cross(t[1] - t[0], t[2] - t[0]));
}

/// Triangles by area, the largest first; those without area left out.
std::vector<std::uint32_t> by_area(const WorldMesh& mesh) {
  std::vector<std::pair<float, std::uint32_t>> areas;
  for (std::size_t i = 0; i < mesh.mesh.triangles.size(); ++i) {
    const float a = glm::length(mesh.front(mesh.mesh.triangles[i]));
    if (a > 0 && std::isfinite(a)) areas.emplace_back(-a, static_cast<std::uint32_t>(i));
  }
  std::ranges::sort(areas);
  std::vector<std::uint32_t> order;
  for (const auto& [negative, triangle] : areas) order.push_back(triangle);
  return order;
}

/// Grows pieces from the largest triangle that is left, over edges that join. `begin(seed)` readies
/// `lay(triangle, at)`, which lays a triangle beside the seed or refuses it.
template <class Begin, class Lay>
void grow(const WorldMesh& mesh, const Neighbours& neighbours, std::uint32_t instance,
          std::span<const std::uint8_t> halvings, std::vector<Chart>& charts, const Begin& begin,
          const Lay& lay) {
  const auto halvings_of = [&](std::uint32_t t) { return halvings.empty() ? 0 : int{halvings[t]}; };
  constexpr std::int32_t nowhere = -1;
  std::vector<std::int32_t> chart_of(neighbours.size(), nowhere);
  for (const std::uint32_t seed : by_area(mesh)) {
    if (chart_of[seed] != nowhere) continue;
    const auto id = static_cast<std::int32_t>(charts.size());
    Chart chart{instance, {}, {}, halvings_of(seed)};
    FlatTriangles there;
    begin(seed);
    std::deque<std::uint32_t> waiting = {seed};
    while (!waiting.empty()) {
      const std::uint32_t triangle = waiting.front();
      waiting.pop_front();
      FlatCorners at;
      if (chart_of[triangle] != nowhere || halvings_of(triangle) != chart.halvings) continue;
      if (!lay(triangle, at) || !(area(at) > 0) || !there.add(at)) continue;
      chart_of[triangle] = id;
      chart.triangles.push_back({triangle, at, 0});
      for (const std::int32_t next : neighbours[triangle]) {
        if (next >= 0 && chart_of[next] == nowhere) waiting.push_back(static_cast<std::uint32_t>(next));
      }
    }
    if (chart.triangles.empty()) continue;
    for (FlatTriangle& t : chart.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t next = neighbours[t.triangle][k];
        if (next < 0 || chart_of[next] != id) t.open = static_cast<std::uint8_t>(t.open | 1 << k);
      }
    }
    lay_along_axes(chart);
    charts.push_back(std::move(chart));
  }
}

void own_charts(const WorldMesh& mesh, std::uint32_t instance, const ChartParams& params,
                std::span<const std::uint8_t> halvings, std::vector<Chart>& charts) {
  const Neighbours neighbours = joined_smoothly(mesh, params.crease);
  const float least = std::cos(params.cone);
  Frame frame = Frame::around(vec3(0, 0, 1));
  vec3 origin(0);
  const auto unit_front = [&](const uvec3& t) { return glm::normalize(mesh.front(t)); };
  grow(
      mesh, neighbours, instance, halvings, charts,
      [&](std::uint32_t seed) {
        const uvec3& t = mesh.mesh.triangles[seed];
        frame = Frame::around(unit_front(t));
        origin = mesh.positions[t.x];
      },
      [&](std::uint32_t triangle, FlatCorners& at) {
        const uvec3& t = mesh.mesh.triangles[triangle];
        if (!(glm::dot(unit_front(t), frame.z) >= least)) return false;
        for (int k = 0; k < 3; ++k) at[k] = vec2(frame.to_local(mesh.positions[t[k]] - origin));
        return true;
      });
}

/// Islands of the second coordinates, each as large as its surface.
void uv_charts(const WorldMesh& mesh, std::uint32_t instance, std::vector<Chart>& charts) {
  const std::size_t first = charts.size();
  grow(
      mesh, joined_in_uvs(mesh), instance, {}, charts, [](std::uint32_t) {},
      [&](std::uint32_t triangle, FlatCorners& at) {
        at = uv_corners(mesh.mesh, mesh.mesh.triangles[triangle]);
        return true;
      });
  for (std::size_t i = first; i < charts.size(); ++i) {
    double flat = 0, surface = 0;
    for (const FlatTriangle& t : charts[i].triangles) {
      flat += static_cast<double>(area(t.at));
      surface += 0.5 * static_cast<double>(glm::length(mesh.front(mesh.mesh.triangles[t.triangle])));
    }
    const auto scale = static_cast<float>(std::sqrt(surface / flat));
    for (FlatTriangle& t : charts[i].triangles)
      for (vec2& at : t.at) at *= scale;
    charts[i].size *= scale;
  }
}

/// Why an instance gets no lightmap; empty: it gets one.
std::string reason_against(const scene::Scene& scene, const scene::Instance& instance, bool moving) {
  if (!moving && instance.node >= 0 && scene.nodes[instance.node].movable) return "it moves";
  const int index = scene::instance_material(scene, instance);
  if (index < 0) return "";
  const scene::Material& material = scene.materials[index];
  if (material.unlit) return "it is unlit";
  if (material.is_glass() && material.transmission >= 1 && material.transmission_texture.texture < 0)
    return "it is clear glass";
  const auto [first, second] = uv_sets_used(material);
  if (first && second) return "its textures take both sets of coordinates, which leaves none for a lightmap";
  return "";
}

}  // namespace

std::array<bool, 2> uv_sets_used(const scene::Material& material) {
  std::array<bool, 2> used{};
  for (const scene::TextureUse* use : material.texture_uses())
    if (use->texture >= 0) used[use->uv_set == 0 ? 0 : 1] = true;
  return used;
}

std::string second_uvs_problem(const scene::Mesh& mesh) {
  if (mesh.uvs[1].empty()) return "has no second texture coordinates";
  FlatTriangles there;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const FlatCorners at = uv_corners(mesh, mesh.triangles[i]);
    for (const vec2& corner : at) {
      if (!(corner.x >= 0 && corner.x <= 1 && corner.y >= 0 && corner.y <= 1))
        return fmt::format("has second texture coordinates outside of 0 to 1 ({:g}, {:g}), triangle {}",
                           corner.x, corner.y, i);
    }
    const uvec3& t = mesh.triangles[i];
    const vec3 p = mesh.positions[t.x];
    if (!(glm::length(glm::cross(mesh.positions[t.y] - p, mesh.positions[t.z] - p)) > 0)) continue;
    if (!(area(at) > 0)) return fmt::format("has second texture coordinates without area, triangle {}", i);
    if (!there.add(at)) return fmt::format("has second texture coordinates that overlap, triangle {}", i);
  }
  return "";
}

Charts make_charts(const scene::Scene& scene, float time, const ChartParams& params, const Halvings& halvings,
                   const Control& control) {
  scene::check_indices(scene);
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  require(halvings.empty() || halvings.size() == scene.instances.size(), "charts",
          "there are not the texels' widths of each instance");
  Charts out;
  out.own.assign(scene.instances.size(), 0);
  std::map<std::string, std::size_t> left_out;
  std::map<int, std::string> problems;  // of meshes' second coordinates
  ProgressStage stage(control, "charts", scene.instances.size(), "surfaces");
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    control.check();
    stage.advance(1);
    const scene::Instance& instance = scene.instances[i];
    if (instance.mesh < 0) continue;
    const scene::Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.triangles.empty()) continue;
    if (const std::string reason = reason_against(scene, instance, params.moving); !reason.empty()) {
      ++left_out[reason];
      continue;
    }
    bool own = params.uvs == UvChoice::own;
    if (!own) {
      const auto [known, fresh] = problems.try_emplace(instance.mesh);
      if (fresh) known->second = second_uvs_problem(mesh);
      if (!known->second.empty() && params.uvs == UvChoice::scene)
        throw Error(fmt::format("mesh \"{}\"", mesh.name), known->second,
                    "unwrap it anew, or let own charts be made (--uvs own)");
      own = !known->second.empty();
    }
    const WorldMesh in_world(scene, instance, world);
    if (own) {
      out.own[i] = 1;
      const bool all_alike = halvings.empty() || halvings[i].empty();
      require(all_alike || halvings[i].size() == mesh.triangles.size(), "charts",
              "there are not the texels' widths of each triangle");
      own_charts(in_world, static_cast<std::uint32_t>(i), params,
                 all_alike ? std::span<const std::uint8_t>() : halvings[i], out.charts);
    } else {
      uv_charts(in_world, static_cast<std::uint32_t>(i), out.charts);
    }
  }
  for (const auto& [reason, count] : left_out)
    out.notes.push_back(fmt::format("no lightmap for {}: {}", counted(count, "surface"), reason));
  return out;
}

}  // namespace ssphh::lightmap
