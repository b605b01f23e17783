#include "transfer.h"

#include <algorithm>
#include <array>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/transport/gbuffer.h>

namespace ssphh::methods::prt {
namespace {

using Basis = std::array<float, sh::max_coefficient_count>;

void add_cosine_lobe(int degree, const vec3& normal, float* out) {
  Basis basis;
  sh::eval_basis(degree, normal, basis);
  for (int l = 0; l <= degree; ++l) {
    const auto factor = static_cast<float>(sh::cosine_band_factor(l));
    for (int k = l * l; k < (l + 1) * (l + 1); ++k) out[k] += factor * basis[k];
  }
}

/// The vertices within bodies, wave by wave from those that are not, each with its neighbours known before.
struct Filling {
  struct Entry {
    std::uint32_t vertex;
    std::vector<std::uint32_t> from;
  };
  std::vector<Entry> entries;

  Filling(const TransferMesh& mesh, const VertexRings& rings, std::span<const std::uint8_t> buried) {
    std::vector<std::uint8_t> known;
    for (const std::uint8_t b : buried) known.push_back(b ? 0 : 1);
    for (bool more = true; more;) {
      const std::size_t before = entries.size();
      for (std::uint32_t v = 0; v < known.size(); ++v) {
        if (known[v]) continue;
        std::vector<std::uint32_t> from;
        for (const std::uint32_t triangle : rings.of(v)) {
          const uvec3& t = mesh.triangles[triangle];
          for (int k = 0; k < 3; ++k)
            if (known[t[k]]) from.push_back(t[k]);
        }
        if (!from.empty()) entries.push_back({v, std::move(from)});
      }
      for (std::size_t i = before; i < entries.size(); ++i) known[entries[i].vertex] = 1;
      more = entries.size() > before;
    }
  }

  template <class Value>
  void apply(std::size_t stride, std::vector<Value>& values) const {
    for (const Entry& entry : entries) {
      for (std::size_t k = 0; k < stride; ++k) {
        Value sum(0);
        for (const std::uint32_t other : entry.from) sum += values[other * stride + k];
        values[entry.vertex * stride + k] = sum / static_cast<float>(entry.from.size());
      }
    }
  }
};

class Finder {
 public:
  Finder(const TransferMesh& mesh, const VertexRays& rays, const TransferParams& params)
      : mesh_(mesh),
        rays_(rays),
        params_(params),
        stride_(static_cast<std::size_t>(sh::coefficient_count(params.degree))) {}

  /// Visibility and cosine: cosine-distributed rays leave π/rays each. Where most of them see the distant
  /// light, those that do not are taken from the whole cosine lobe instead: less noise, none in the open.
  void shadow(std::size_t v, float* out) const {
    const std::span<const VertexHit> hits = rays_.of(v);
    const auto hides =
        static_cast<std::size_t>(std::ranges::count_if(hits, [&](const VertexHit& h) { return hidden(h); }));
    const bool open = 2 * hides <= hits.size();
    const float share = (open ? -pi : pi) / static_cast<float>(hits.size());
    Basis basis;
    for (std::size_t r = 0; r < hits.size(); ++r) {
      if (hidden(hits[r]) != open) continue;
      sh::eval_basis(params_.degree, vertex_ray_direction(mesh_, v, static_cast<int>(r)), basis);
      for (std::size_t k = 0; k < stride_; ++k) out[k] += share * basis[k];
    }
    if (open) add_cosine_lobe(params_.degree, mesh_.vertices[v].normal, out);
  }

  /// What the surfaces hit make of the transfer before: ρ/π E for each ray, times π/rays.
  void gather(std::size_t v, std::span<const vec3> last, vec3* out) const {
    std::fill(out, out + stride_, vec3(0));
    const std::span<const VertexHit> hits = rays_.of(v);
    const float share = 1 / static_cast<float>(hits.size());
    for (const VertexHit& hit : hits) {
      if (!hidden(hit) || hit.triangle < 0) continue;
      const uvec3& t = mesh_.triangles[hit.triangle];
      const vec3 weights = hit.weights(), albedo = share * transport::unpack_albedo(hit.albedo);
      for (int c = 0; c < 3; ++c) {
        const vec3 factor = weights[c] * albedo;
        const vec3* from = &last[t[c] * stride_];
        for (std::size_t k = 0; k < stride_; ++k) out[k] += factor * from[k];
      }
    }
  }

 private:
  bool hidden(const VertexHit& hit) const { return hit.distance < params_.reach; }

  const TransferMesh& mesh_;
  const VertexRays& rays_;
  TransferParams params_;
  std::size_t stride_;
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

TransferVectors find_transfer(const TransferMesh& mesh, const VertexRings& rings, const VertexRays& rays,
                              const TransferParams& params, const Control& control) {
  sh::require_degree(params.degree, "radiance transfer");
  require(params.bounces >= 0, "radiance transfer", "bounces must not be negative");
  const std::size_t count = mesh.vertices.size();
  TransferVectors result{params.degree, {}, {}};
  const std::size_t stride = result.stride();
  result.direct.assign(count * stride, 0.0f);
  const Finder finder(mesh, rays, params);
  const Filling filling(mesh, rings, rays.buried);
  ProgressStage progress(control, "transfer vectors", static_cast<std::uint64_t>(params.bounces + 1),
                         "bounces");
  const auto for_vertices = [&](const auto& body) {
    parallel_for(
        count, vertices_at_once, [&](std::size_t v) { body(v); }, control);
    progress.advance(1);
  };
  for_vertices([&](std::size_t v) { finder.shadow(v, &result.direct[v * stride]); });
  filling.apply(stride, result.direct);
  if (params.bounces == 0) return result;

  result.reflected.assign(count * stride, vec3(0));
  std::vector<vec3> last(result.direct.begin(), result.direct.end()), next(last.size());
  for (int bounce = 0; bounce < params.bounces; ++bounce) {
    for_vertices([&](std::size_t v) { finder.gather(v, last, &next[v * stride]); });
    filling.apply(stride, next);
    for (std::size_t i = 0; i < next.size(); ++i) result.reflected[i] += next[i];
    last.swap(next);
  }
  return result;
}

TransferVectors open_transfer(const TransferMesh& mesh, int degree) {
  TransferVectors result{degree, {}, {}};
  const std::size_t stride = result.stride();
  result.direct.assign(mesh.vertices.size() * stride, 0.0f);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    add_cosine_lobe(degree, mesh.vertices[v].normal, &result.direct[v * stride]);
  return result;
}

}  // namespace ssphh::methods::prt
