#include "cut_mesh.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace ssphh::lightmap {
namespace {

enum class Wanted : std::uint8_t { unknown, so, smaller };
using Ends = std::pair<std::uint32_t, std::uint32_t>;

class Cutter {
 public:
  Cutter(scene::Mesh mesh, const mat4& to_world) : mesh_(std::move(mesh)), to_world_(to_world) {
    for (std::uint32_t v = 0; v < mesh_.positions.size(); ++v) place_vertex(v);
  }

  CutMesh run(const WantsCut& wants, std::size_t most) {
    wanted_.assign(mesh_.triangles.size(), Wanted::unknown);
    whole_.resize(mesh_.triangles.size());
    std::iota(whole_.begin(), whole_.end(), 0u);
    while (mesh_.triangles.size() < most && mark(wants)) split_marked();
    return {std::move(mesh_), std::move(whole_)};
  }

 private:
  void place_vertex(std::uint32_t v) {
    const vec3& p = mesh_.positions[v];
    world_.emplace_back(to_world_ * vec4(p, 1));
    place_.push_back(
        places_.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(places_.size())).first->second);
  }

  /// The ends of edge k as places: the same from both of its sides.
  Ends edge(const uvec3& t, int k) const {
    const std::uint32_t a = place_[t[k]], b = place_[t[(k + 1) % 3]];
    return {std::min(a, b), std::max(a, b)};
  }
  int longest(const uvec3& t) const {
    const auto order = [&](int k) {
      const vec3 d = world_[t[(k + 1) % 3]] - world_[t[k]];
      return std::pair(glm::dot(d, d), edge(t, k));
    };
    int best = 0;
    for (const int k : {1, 2})
      if (order(k) > order(best)) best = k;
    return best;
  }

  /// Marks the edges to be cut: of triangles that are wanted smaller the longest, and of each with a marked
  /// edge its longest, too.
  bool mark(const WantsCut& wants) {
    marked_.clear();
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const uvec3& t = mesh_.triangles[i];
      if (wanted_[i] == Wanted::unknown)
        wanted_[i] = wants({world_[t.x], world_[t.y], world_[t.z]}, whole_[i]) ? Wanted::smaller : Wanted::so;
      if (wanted_[i] == Wanted::smaller) marked_.insert(edge(t, longest(t)));
    }
    for (std::size_t before = 0; before != marked_.size();) {
      before = marked_.size();
      for (const uvec3& t : mesh_.triangles)
        if (marked_edge(t) >= 0) marked_.insert(edge(t, longest(t)));
    }
    return !marked_.empty();
  }
  /// −1: none. The longest edge comes first.
  int marked_edge(const uvec3& t) const {
    const int first = longest(t);
    for (int k = first; k < first + 3; ++k)
      if (marked_.contains(edge(t, k % 3))) return k % 3;
    return -1;
  }

  void split_marked() {
    const std::vector<uvec3> before = std::exchange(mesh_.triangles, {});
    const std::vector<Wanted> wanted = std::exchange(wanted_, {});
    const std::vector<std::uint32_t> whole = std::exchange(whole_, {});
    middles_.clear();
    for (std::size_t i = 0; i < before.size(); ++i) split(before[i], wanted[i], whole[i]);
  }
  void split(const uvec3& t, Wanted wanted, std::uint32_t whole) {
    const int k = marked_edge(t);
    if (k < 0) {
      mesh_.triangles.push_back(t), wanted_.push_back(wanted), whole_.push_back(whole);
      return;
    }
    const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], m = middle(a, b);
    split({a, m, c}, Wanted::unknown, whole);
    split({m, b, c}, Wanted::unknown, whole);
  }

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
    const auto [known, fresh] = middles_.try_emplace({std::min(a, b), std::max(a, b)}, next);
    if (!fresh) return known->second;
    const auto add = [&](auto& values) {
      if (!values.empty()) values.push_back(0.5f * (values[a] + values[b]));
    };
    add(mesh_.positions), add(mesh_.normals), add(mesh_.tangents), add(mesh_.colors);
    for (std::vector<vec2>& uvs : mesh_.uvs) add(uvs);
    if (!mesh_.normals.empty()) mesh_.normals.back() = unit(mesh_.normals.back(), mesh_.normals[a]);
    if (!mesh_.tangents.empty())
      mesh_.tangents.back() =
          vec4(unit(vec3(mesh_.tangents.back()), vec3(mesh_.tangents[a])), mesh_.tangents[a].w);
    place_vertex(next);
    return next;
  }
  static vec3 unit(const vec3& v, const vec3& otherwise) {
    const float length = glm::length(v);
    return length > 0 ? v / length : otherwise;
  }

  scene::Mesh mesh_;
  mat4 to_world_;
  std::vector<Wanted> wanted_;        ///< of each triangle
  std::vector<std::uint32_t> whole_;  ///< of each triangle
  std::vector<vec3> world_;
  std::vector<std::uint32_t> place_;  ///< of each vertex
  std::map<std::array<float, 3>, std::uint32_t> places_;
  std::set<Ends> marked_;
  std::map<Ends, std::uint32_t> middles_;  ///< by vertices
};

}  // namespace

CutMesh cut_mesh(scene::Mesh mesh, const mat4& to_world, const WantsCut& wants, std::size_t most) {
  return Cutter(std::move(mesh), to_world).run(wants, most);
}

}  // namespace ssphh::lightmap
