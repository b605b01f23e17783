#include "vertex_rays.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/transport/gbuffer.h>

namespace ssphh::methods::prt {
namespace {

/// How far toward its neighbours a vertex's rays start, of the way.
constexpr float spread = 0.5f;

SampleSequence sequence(std::size_t vertex, int ray) {
  return {hash_combine(0x7472616e73666572, vertex), static_cast<std::uint32_t>(ray)};
}

/// A triangle around a vertex.
struct RingTriangle {
  geometry::Corners corners;
  vec3 lift;    ///< along its normal
  float below;  ///< twice the area of it and those before
};

std::vector<RingTriangle> ring_of(const TransferMesh& mesh, std::span<const std::uint32_t> ring, float lift) {
  std::vector<RingTriangle> result;
  float area = 0;
  for (const std::uint32_t triangle : ring) {
    const geometry::Corners c = mesh.corners(triangle);
    const vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    area += glm::length(normal);
    result.push_back({c, lift * glm::normalize(normal), area});
  }
  return result;
}

void add_rays(const TransferMesh& mesh, const VertexRings& rings, std::size_t vertex, int count, float lift,
              std::vector<rays::RayQuery>& rays) {
  const std::vector<RingTriangle> ring = ring_of(mesh, rings.of(vertex), lift);
  for (int r = 0; r < count; ++r) {
    SampleSequence sample = sequence(vertex, r);
    sample.next2();  // the direction's
    const float pick = sample.next() * ring.back().below;
    const auto found = std::ranges::upper_bound(ring, pick, {}, &RingTriangle::below);
    const RingTriangle& triangle = found == ring.end() ? ring.back() : *found;
    const vec2 u = sample.next2();
    const float root = std::sqrt(u.x);
    const vec3 at = (1 - root) * triangle.corners[0] + root * (1 - u.y) * triangle.corners[1] +
                    root * u.y * triangle.corners[2];
    rays.push_back({glm::mix(mesh.vertices[vertex].position, at, spread) + triangle.lift,
                    vertex_ray_direction(mesh, vertex, r)});
  }
}

VertexHit packed(const rays::RayQuery& ray, const rays::RayHit& hit, const MeshIndex& index) {
  VertexHit out{hit.distance, -1, 0, 0, 0};
  if (hit.escaped()) return out;
  const MeshPlace place = index.find({ray.origin + hit.distance * ray.direction, hit.normal});
  const auto share = [](float weight) { return static_cast<std::uint16_t>(std::lround(65535 * weight)); };
  out.triangle = place.triangle;
  out.second = share(place.weight.y);
  out.third = std::min(share(place.weight.z), static_cast<std::uint16_t>(65535 - out.second));
  out.albedo = transport::pack_albedo(hit.through * hit.albedo);
  return out;
}

}  // namespace

vec3 vertex_ray_direction(const TransferMesh& mesh, std::size_t vertex, int ray) {
  return Frame::around(mesh.vertices[vertex].normal)
      .to_world(sample_cosine_hemisphere(sequence(vertex, ray).next2()));
}

VertexRings::VertexRings(const TransferMesh& mesh) : begin(mesh.vertices.size() + 1, 0) {
  for (const uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++begin[t[k] + 1];
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  triangle.resize(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) triangle[next[mesh.triangles[i][k]]++] = static_cast<std::uint32_t>(i);
}

VertexRays find_vertex_rays(const TransferMesh& mesh, const VertexRings& rings, const MeshIndex& index,
                            const rays::TransportSource& source, int rays, const Control& control) {
  const std::size_t vertices = mesh.vertices.size(), count = static_cast<std::size_t>(rays);
  const float lift = 1e-4f * source.part_bounds(0).radius();
  VertexRays result{rays, std::vector<VertexHit>(vertices * count), std::vector<std::uint8_t>(vertices, 0)};
  ProgressStage progress(control, "rays of vertices", vertices, "vertices");
  parallel_for(
      vertices, vertices_at_once,
      [&](std::size_t begin, std::size_t end) {
        std::vector<rays::RayQuery> queries;
        for (std::size_t v = begin; v < end; ++v) add_rays(mesh, rings, v, rays, lift, queries);
        std::vector<rays::RayHit> hits(queries.size());
        source.intersect(0, queries, hits);
        for (std::size_t v = begin; v < end; ++v) {
          std::size_t seen = 0, backs = 0;
          for (std::size_t r = 0; r < count; ++r) {
            const std::size_t i = (v - begin) * count + r;
            seen += hits[i].escaped() ? 0 : 1;
            backs += hits[i].back ? 1 : 0;
            result.hits[v * count + r] = packed(queries[i], hits[i], index);
          }
          result.buried[v] = 2 * backs > seen ? 1 : 0;
        }
        progress.advance(end - begin);
      },
      control);
  return result;
}

}  // namespace ssphh::methods::prt
