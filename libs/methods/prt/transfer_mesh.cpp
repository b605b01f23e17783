#include "transfer_mesh.h"

#include <array>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

namespace ssphh::methods::prt {
namespace {

/// Least cosine between a point's normal, which a normal map may have bent, and its triangle's.
constexpr float least_cosine = 0.2f;
constexpr int open_rays = 16;

struct Vertex {
  vec3 position, normal;
};
using Triangle = std::array<Vertex, 3>;

Vertex between(const Vertex& a, const Vertex& b) {
  const vec3 n = a.normal + b.normal;
  const float length = glm::length(n);
  return {0.5f * (a.position + b.position), length > 0 ? n / length : a.normal};
}

/// Halves long edges until there are none. Which ones are halved depends on the edge alone.
template <class Emit>
void refine(const Triangle& t, float edge, const Emit& emit) {
  std::array<bool, 3> cut;  // edge k runs from corner k to the next
  int cuts = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    cut[k] = glm::length(t[(k + 1) % 3].position - t[k].position) > edge;
    cuts += cut[k] ? 1 : 0;
  }
  if (cuts == 0) return emit(t);
  if (cuts == 3) {
    const Vertex a = between(t[0], t[1]), b = between(t[1], t[2]), c = between(t[2], t[0]);
    for (const Triangle& part :
         {Triangle{t[0], a, c}, Triangle{a, t[1], b}, Triangle{c, b, t[2]}, Triangle{a, b, c}})
      refine(part, edge, emit);
    return;
  }
  // Turned such that the first edge is cut, and where two are, the second as well.
  std::size_t first = 0;
  while (!cut[first] || (cuts == 2 && !cut[(first + 1) % 3])) ++first;
  const Triangle s = {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
  const Vertex a = between(s[0], s[1]);
  if (cuts == 1) {
    refine(Triangle{s[0], a, s[2]}, edge, emit);
    refine(Triangle{a, s[1], s[2]}, edge, emit);
    return;
  }
  const Vertex b = between(s[1], s[2]);
  refine(Triangle{a, s[1], b}, edge, emit);
  refine(Triangle{s[0], a, b}, edge, emit);
  refine(Triangle{s[0], b, s[2]}, edge, emit);
}

struct Key {
  std::array<float, 3> position;
  std::array<int, 3> normal;
  bool operator==(const Key&) const = default;
};
struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t h = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      h = hash_combine(h, std::bit_cast<std::uint32_t>(key.position[k] + 0.0f));
      h = hash_combine(h, static_cast<std::uint32_t>(key.normal[k]));
    }
    return h;
  }
};

/// Joins vertices at the same place whose normals agree.
class Welder {
 public:
  Welder(TransferMesh& mesh, int most) : mesh_(mesh), most_(most) {}

  void add(const Triangle& t) {
    uvec3 index;
    for (int k = 0; k < 3; ++k) index[k] = vertex(t[k]);
    if (index.x != index.y && index.y != index.z && index.z != index.x) mesh_.triangles.push_back(index);
  }

 private:
  std::uint32_t vertex(const Vertex& v) {
    constexpr float steps = 32;
    const glm::ivec3 n(glm::round(v.normal * steps));
    const Key key{{v.position.x, v.position.y, v.position.z}, {n.x, n.y, n.z}};
    const auto [found, fresh] = index_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (fresh) {
      if (mesh_.vertices.size() >= static_cast<std::size_t>(most_)) {
        throw Error("transfer vectors", fmt::format("the scene needs more than {} vertices", most_),
                    "give a larger edge, or allow more vertices");
      }
      mesh_.vertices.push_back({v.position, v.normal});
    }
    return found->second;
  }

  TransferMesh& mesh_;
  int most_;
  std::unordered_map<Key, std::uint32_t, KeyHash> index_;
};

vec3 cross_of(const Triangle& t) {
  return glm::cross(t[1].position - t[0].position, t[2].position - t[0].position);
}

Triangle reversed(const Triangle& t) {
  Triangle r = {t[0], t[2], t[1]};
  for (Vertex& v : r) v.normal = -v.normal;
  return r;
}

/// World space triangles of all that stands still, fronts first.
std::vector<Triangle> static_triangles(const scene::Scene& scene) {
  const std::vector<mat4> world = scene::world_matrices(scene);
  std::vector<Triangle> triangles;
  for (const scene::Instance& instance : scene.instances) {
    const auto node = static_cast<std::size_t>(instance.node);
    if (scene.nodes[node].movable) continue;
    const scene::Mesh& mesh = scene.meshes[instance.mesh];
    const mat4& to_world = world[node];
    const mat3 normals = glm::transpose(glm::inverse(mat3(to_world)));
    // What is scaled to nothing or mirrored: inverse and winding differ.
    const float det = glm::determinant(mat3(to_world));
    if (!(std::abs(det) > 0)) continue;
    for (const uvec3& index : mesh.triangles) {
      Triangle t;
      for (int k = 0; k < 3; ++k) t[k].position = vec3(to_world * vec4(mesh.positions[index[k]], 1));
      if (det < 0) std::swap(t[1], t[2]);
      const vec3 cross = cross_of(t);
      const float length = glm::length(cross);
      if (!(length > 0)) continue;
      const vec3 flat = cross / length;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t from = index[det < 0 ? (3 - k) % 3 : k];
        const vec3 smooth = mesh.normals.empty() ? flat : glm::normalize(normals * mesh.normals[from]);
        // A smooth normal that looks through its own triangle is none.
        t[k].normal = glm::dot(smooth, flat) > least_cosine ? smooth : flat;
      }
      triangles.push_back(t);
    }
  }
  return triangles;
}

/// 1 for the triangles whose side lies in the open.
std::vector<char> in_the_open(const rays::TransportSource& source, std::span<const Triangle> triangles) {
  const float lift = 1e-4f * source.part_bounds(0).radius();
  std::vector<rays::RayQuery> rays;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    const vec3 n = glm::normalize(cross_of(t));
    const vec3 at = (t[0].position + t[1].position + t[2].position) / 3.0f + lift * n;
    for (std::uint32_t r = 0; r < open_rays; ++r) {
      const vec2 u = SampleSequence(hash_combine(7, i), r).next2();
      rays.push_back({at, Frame::around(n).to_world(sample_cosine_hemisphere(u))});
    }
  }
  std::vector<rays::RayHit> hits(rays.size());
  source.intersect(0, rays, hits);
  std::vector<char> open(triangles.size(), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    int backs = 0, seen = 0;
    for (std::size_t r = i * open_rays; r < (i + 1) * open_rays; ++r) {
      seen += hits[r].escaped() ? 0 : 1;
      backs += hits[r].back ? 1 : 0;
    }
    open[i] = 2 * backs < std::max(seen, 1) ? 1 : 0;
  }
  return open;
}

}  // namespace

TransferMesh make_transfer_mesh(const scene::Scene& scene, const rays::TransportSource& source,
                                const TransferMeshParams& params) {
  SSPHH_CHECK(params.edge > 0);
  const std::vector<Triangle> fronts = static_triangles(scene);
  std::vector<Triangle> backs;
  for (const Triangle& t : fronts) backs.push_back(reversed(t));
  const std::vector<char> open =
      params.both_sides ? std::vector<char>(backs.size(), 1) : in_the_open(source, backs);
  TransferMesh mesh;
  Welder welder(mesh, params.most);
  const auto add = [&](const Triangle& t) { welder.add(t); };
  for (const Triangle& t : fronts) refine(t, params.edge, add);
  for (std::size_t i = 0; i < backs.size(); ++i)
    if (open[i]) refine(backs[i], params.edge, add);
  if (mesh.triangles.empty())
    throw Error("transfer vectors", "the scene has no surface that stands still",
                "use another method: irradiance-volume");
  return mesh;
}

MeshIndex::MeshIndex(const TransferMesh& mesh, float reach) : reach_(reach) {
  std::vector<geometry::Corners> corners;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const geometry::Corners c = mesh.corners(i);
    corners.push_back(c);
    normals_.push_back(glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0])));
  }
  tree_ = geometry::TriangleTree(corners);
}

MeshPlace MeshIndex::find(const rays::SurfacePoint& point) const {
  if (point.moves) return {};
  const geometry::TriangleTree::Found found = tree_.nearest(point.position, reach_, [&](std::int32_t i) {
    return glm::dot(normals_[i], point.normal) > least_cosine;
  });
  return {found.triangle, found.triangle < 0 ? vec3(0) : found.place.weight};
}

}  // namespace ssphh::methods::prt
