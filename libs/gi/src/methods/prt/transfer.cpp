#include "transfer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>

namespace ssphh::gi {
namespace {

constexpr std::size_t vertices_at_once = 32;
/// How far toward its neighbours a vertex's rays start, of the way.
constexpr float spread = 0.5f;

/// The triangles around each vertex.
struct Rings {
  std::vector<std::uint32_t> begin;  ///< one more than vertices
  std::vector<std::uint32_t> triangle;

  explicit Rings(const TransferMesh& mesh) : begin(mesh.vertices.size() + 1, 0) {
    for (const uvec3& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) ++begin[t[k] + 1];
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    triangle.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) triangle[next[mesh.triangles[i][k]]++] = static_cast<std::uint32_t>(i);
  }
};

class Finder {
 public:
  Finder(const TransferMesh& mesh, const MeshIndex& index, const scene::TransportSource& source,
         const TransferParams& params)
      : mesh_(mesh),
        index_(index),
        source_(source),
        params_(params),
        rings_(mesh),
        lift_(1e-4f * source.part_bounds(0).radius()),
        stride_(static_cast<std::size_t>(sh::coefficient_count(params.degree))),
        buried_(mesh.vertices.size(), 0) {}

  TransferVectors run(const Control& control) {
    const std::size_t count = mesh_.vertices.size();
    TransferVectors result{params_.degree, std::vector<float>(count * stride_, 0.0f), {}};
    ProgressStage progress(control, "transfer vectors", count * static_cast<std::size_t>(params_.bounces + 1),
                           "vertices");
    for_vertices(
        control, progress,
        [&](std::size_t v, std::span<const scene::RayQuery> rays, std::span<const scene::RayHit> hits) {
          shadow(v, rays, hits, &result.direct[v * stride_]);
        });
    find_neighbours();
    fill(result.direct);
    if (params_.bounces == 0) return result;

    result.reflected.assign(count * stride_, vec3(0));
    std::vector<vec3> last(result.direct.begin(), result.direct.end()), next(last.size());
    for (int bounce = 0; bounce < params_.bounces; ++bounce) {
      for_vertices(
          control, progress,
          [&](std::size_t v, std::span<const scene::RayQuery> rays, std::span<const scene::RayHit> hits) {
            gather(rays, hits, last, &next[v * stride_]);
          });
      fill(next);
      for (std::size_t i = 0; i < next.size(); ++i) result.reflected[i] += next[i];
      last.swap(next);
    }
    return result;
  }

 private:
  /// Calls body(vertex, rays, hits) for all, on all threads.
  template <class Body>
  void for_vertices(const Control& control, ProgressStage& progress, const Body& body) const {
    parallel_for(
        mesh_.vertices.size(), vertices_at_once,
        [&](std::size_t begin, std::size_t end) {
          const auto per_vertex = static_cast<std::size_t>(params_.rays);
          std::vector<scene::RayQuery> rays;
          for (std::size_t v = begin; v < end; ++v) add_rays(v, rays);
          std::vector<scene::RayHit> hits(rays.size());
          source_.intersect(0, rays, hits);
          for (std::size_t v = begin; v < end; ++v) {
            const std::size_t first = (v - begin) * per_vertex;
            body(v, std::span(rays).subspan(first, per_vertex), std::span(hits).subspan(first, per_vertex));
          }
          progress.advance(end - begin);
        },
        control);
  }

  void add_rays(std::size_t v, std::vector<scene::RayQuery>& rays) const {
    const auto ring =
        std::span(rings_.triangle).subspan(rings_.begin[v], rings_.begin[v + 1] - rings_.begin[v]);
    std::vector<float> below(ring.size());
    float area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Corners c = mesh_.corners(ring[i]);
      below[i] = area += glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
    }
    const scene::SurfacePoint& vertex = mesh_.vertices[v];
    const Frame frame = Frame::around(vertex.normal);
    for (int r = 0; r < params_.rays; ++r) {
      SampleSequence sample(hash_combine(0x7472616e73666572, v), static_cast<std::uint32_t>(r));
      const vec2 u = sample.next2();
      const vec3 direction = frame.to_world(sample_cosine_hemisphere(u));
      const float pick = sample.next() * area;
      const vec2 place = sample.next2();
      const auto chosen =
          static_cast<std::size_t>(std::upper_bound(below.begin(), below.end(), pick) - below.begin());
      const std::uint32_t triangle = ring[std::min(chosen, ring.size() - 1)];
      rays.push_back(start(vertex, triangle, place, direction));
    }
  }

  /// A point of the triangle near the vertex, just above it.
  scene::RayQuery start(const scene::SurfacePoint& vertex, std::uint32_t triangle, const vec2& u,
                        const vec3& direction) const {
    const Corners c = mesh_.corners(triangle);
    const float root = std::sqrt(u.x);
    const vec3 at = (1 - root) * c[0] + root * (1 - u.y) * c[1] + root * u.y * c[2];
    const vec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    return {glm::mix(vertex.position, at, spread) + lift_ * normal, direction};
  }

  bool hidden(const scene::RayHit& hit) const { return hit.distance < params_.reach; }  // not if escaped

  /// Visibility and cosine: cosine-distributed rays leave π/rays each. Where most of them see the distant
  /// light, those that do not are taken from the whole cosine lobe instead: less noise, none in the open.
  void shadow(std::size_t v, std::span<const scene::RayQuery> rays, std::span<const scene::RayHit> hits,
              float* out) {
    std::array<float, sh::max_coefficient_count> basis;
    const float share = pi / static_cast<float>(rays.size());
    std::size_t backs = 0, seen = 0, hides = 0;
    for (const scene::RayHit& hit : hits) {
      seen += hit.escaped() ? 0 : 1;
      backs += hit.back ? 1 : 0;
      hides += hidden(hit) ? 1 : 0;
    }
    const bool open = 2 * hides <= rays.size();
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (hidden(hits[r]) != open) continue;
      sh::eval_basis(params_.degree, rays[r].direction, std::span(basis).first(stride_));
      for (std::size_t k = 0; k < stride_; ++k) out[k] += open ? -share * basis[k] : share * basis[k];
    }
    if (open) add_cosine_lobe(mesh_.vertices[v].normal, out);
    buried_[v] = 2 * backs > seen ? 1 : 0;
  }

  void add_cosine_lobe(const vec3& normal, float* out) const {
    std::array<float, sh::max_coefficient_count> basis;
    sh::eval_basis(params_.degree, normal, std::span(basis).first(stride_));
    for (int l = 0; l <= params_.degree; ++l) {
      const auto factor = static_cast<float>(sh::cosine_band_factor(l));
      for (int k = l * l; k < (l + 1) * (l + 1); ++k) out[k] += factor * basis[static_cast<std::size_t>(k)];
    }
  }

  /// What the surfaces hit make of the transfer before: ρ/π E for each ray, times π/rays.
  void gather(std::span<const scene::RayQuery> rays, std::span<const scene::RayHit> hits,
              std::span<const vec3> last, vec3* out) const {
    std::fill(out, out + stride_, vec3(0));
    const float share = 1 / static_cast<float>(rays.size());
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (!hidden(hits[r])) continue;
      const vec3 at = rays[r].origin + hits[r].distance * rays[r].direction;
      const MeshPlace place = index_.find({at, hits[r].normal});
      if (place.triangle < 0) continue;
      const uvec3& t = mesh_.triangles[static_cast<std::size_t>(place.triangle)];
      for (int c = 0; c < 3; ++c) {
        const vec3 factor = share * place.weight[c] * hits[r].albedo;
        const vec3* from = &last[t[c] * stride_];
        for (std::size_t k = 0; k < stride_; ++k) out[k] += factor * from[k];
      }
    }
  }

  /// Which vertices a buried one takes its value from: wave by wave from those that are not.
  void find_neighbours() {
    std::vector<char> known(buried_.size());
    for (std::size_t v = 0; v < buried_.size(); ++v) known[v] = buried_[v] ? 0 : 1;
    for (bool more = true; more;) {
      std::vector<std::uint32_t> wave;
      for (std::uint32_t v = 0; v < known.size(); ++v) {
        if (known[v]) continue;
        std::vector<std::uint32_t> from;
        for (std::uint32_t i = rings_.begin[v]; i < rings_.begin[v + 1]; ++i) {
          const uvec3& t = mesh_.triangles[rings_.triangle[i]];
          for (int k = 0; k < 3; ++k)
            if (known[t[k]]) from.push_back(t[k]);
        }
        if (from.empty()) continue;
        filled_.push_back({v, std::move(from)});
        wave.push_back(v);
      }
      for (const std::uint32_t v : wave) known[v] = 1;
      more = !wave.empty();
    }
  }

  template <class Value>
  void fill(std::vector<Value>& values) const {
    for (const auto& [v, from] : filled_) {
      for (std::size_t k = 0; k < stride_; ++k) {
        Value sum(0);
        for (const std::uint32_t other : from) sum += values[other * stride_ + k];
        values[v * stride_ + k] = sum / static_cast<float>(from.size());
      }
    }
  }

  const TransferMesh& mesh_;
  const MeshIndex& index_;
  const scene::TransportSource& source_;
  TransferParams params_;
  Rings rings_;
  float lift_;
  std::size_t stride_;
  std::vector<char> buried_;
  std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> filled_;
};

}  // namespace

vec3 TransferVectors::direct_irradiance(std::size_t v, const sh::RadianceSh& light) const {
  vec3 sum(0);
  for (std::size_t k = 0; k < stride(); ++k) sum += direct[v * stride() + k] * light.values[k];
  return sum;
}

vec3 TransferVectors::reflected_irradiance(std::size_t v, const sh::RadianceSh& light) const {
  vec3 sum(0);
  if (reflected.empty()) return sum;
  for (std::size_t k = 0; k < stride(); ++k) sum += reflected[v * stride() + k] * light.values[k];
  return sum;
}

TransferVectors find_transfer(const TransferMesh& mesh, const MeshIndex& index,
                              const scene::TransportSource& source, const TransferParams& params,
                              const Control& control) {
  SSPHH_CHECK(params.rays > 0 && params.bounces >= 0 && params.degree >= 0 &&
              params.degree <= sh::max_degree);
  return Finder(mesh, index, source, params).run(control);
}

}  // namespace ssphh::gi
