#include "coarsen.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/scene/query.h>

#include "clearance.h"
#include "cut_mesh.h"
#include "world_mesh.h"

namespace ssphh::lightmap {
namespace {

constexpr int most_halvings = 6;
constexpr std::size_t most_triangles = std::size_t{1} << 18;  ///< of a mesh that is cut

int halvings_at(float distance, float near) {
  if (!(distance >= 2 * near)) return 0;
  return std::isinf(distance) ? most_halvings : std::min(most_halvings, std::ilogb(distance / near));
}

using Corners = std::array<vec3, 3>;

float longest_edge(const Corners& t) {
  return std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
}
float area(const Corners& t) {
  return 0.5f * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}

/// What decides how wide texels of an instance may be.
class Instance {
 public:
  Instance(const Clearance& clearance, const WorldMesh& mesh, float near)
      : clearance_(clearance), mesh_(mesh), near_(near) {}

  /// Whether places of the triangle may have wider texels than others.
  bool is_uneven(const Corners& t, std::uint32_t whole) const {
    const float longest = longest_edge(t), most = extent(whole);
    if (!(longest > near_) || !(most >= 2 * near_)) return false;
    const vec3 middle = (t[0] + t[1] + t[2]) / 3.0f;
    const float reach =
        std::max({glm::distance(middle, t[0]), glm::distance(middle, t[1]), glm::distance(middle, t[2])});
    const float distance = clearance_.at(middle, front(whole));
    const int least = halvings_at(std::min(most, std::max(0.0f, distance - reach)), near_);
    return longest > std::ldexp(near_, least) && halvings_at(std::min(most, distance + reach), near_) > least;
  }
  int halvings(const Corners& t, std::uint32_t whole) const {
    float least = extent(whole);
    for (const vec3& place : {(t[0] + t[1] + t[2]) / 3.0f, t[0], t[1], t[2]}) {
      if (!(least >= 2 * near_)) return 0;
      least = std::min(least, clearance_.at(place, front(whole)));
    }
    return halvings_at(least, near_);
  }

 private:
  /// Of a triangle before it was cut, in metres; 0 without area.
  float extent(std::uint32_t whole) const {
    const uvec3& t = mesh_.mesh.triangles[whole];
    const float length = glm::length(mesh_.front(t));
    if (!(length > 0) || !std::isfinite(length)) return 0;
    return longest_edge({mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]});
  }
  vec3 front(std::uint32_t whole) const { return glm::normalize(mesh_.front(mesh_.mesh.triangles[whole])); }

  const Clearance& clearance_;
  const WorldMesh& mesh_;
  float near_;
};

}  // namespace

std::optional<Coarsened> coarsen(const scene::Scene& scene, float time, std::span<const std::uint8_t> own,
                                 float near, const Control& control) {
  const Clearance clearance(scene, time);
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  Coarsened out{scene, Halvings(scene.instances.size())};
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    control.check();
    if (!own[i]) continue;
    const scene::Instance& from = scene.instances[i];
    const mat4 to_world = from.node < 0 ? mat4(1) : world[from.node];
    const WorldMesh whole(scene, from, world);
    const Instance instance(clearance, whole, near);
    CutMesh cut = cut_mesh(
        whole.mesh, to_world, [&](const Corners& t, std::uint32_t of) { return instance.is_uneven(t, of); },
        most_triangles);
    const std::size_t count = cut.mesh.triangles.size();
    const auto corners = [&](std::size_t k) {
      const uvec3& t = cut.mesh.triangles[k];
      const auto at = [&](std::uint32_t v) { return vec3(to_world * vec4(cut.mesh.positions[v], 1)); };
      return Corners{at(t.x), at(t.y), at(t.z)};
    };
    std::vector<std::uint8_t> halvings(count);
    parallel_for(
        count, 64,
        [&](std::size_t k) {
          halvings[k] = static_cast<std::uint8_t>(instance.halvings(corners(k), cut.whole[k]));
        },
        control);
    const int most = count == 0 ? 0 : *std::ranges::max_element(halvings);
    if (most == 0) continue;
    out.most_halvings = std::max(out.most_halvings, most);
    for (std::size_t k = 0; k < count; ++k)
      if (halvings[k] > 0) out.area += static_cast<double>(area(corners(k)));
    out.halvings[i] = std::move(halvings);
    if (count == whole.mesh.triangles.size()) continue;
    out.scene.instances[i].mesh = static_cast<int>(out.scene.meshes.size());
    out.scene.meshes.push_back(std::move(cut.mesh));
  }
  if (out.most_halvings == 0) return std::nullopt;
  return out;
}

}  // namespace ssphh::lightmap
