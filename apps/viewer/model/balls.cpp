#include "balls.h"

#include <algorithm>
#include <map>

#include <ssphh/probes/lookup_weights.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>

namespace ssphh::viewer {
namespace {

BallMesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

BallMesh halved(const BallMesh& mesh) {
  BallMesh out;
  out.vertices = mesh.vertices;
  std::map<std::pair<unsigned, unsigned>, unsigned> middles;
  const auto middle = [&](unsigned a, unsigned b) {
    const auto [it, is_new] = middles.insert({std::minmax(a, b), static_cast<unsigned>(out.vertices.size())});
    if (is_new) out.vertices.push_back(glm::normalize(out.vertices[a] + out.vertices[b]));
    return it->second;
  };
  for (const uvec3& t : mesh.triangles) {
    const unsigned ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
    for (const uvec3& part : {uvec3{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}})
      out.triangles.push_back(part);
  }
  return out;
}

const sh::RadianceSh* function_of(const probes::ProbeSet& set, std::size_t i, Ball ball) {
  const auto& hierarchy = set.hierarchy;
  switch (ball) {
    case Ball::neighbor:
      return hierarchy ? &hierarchy->neighbor[i] : nullptr;
    case Ball::radiance:
    case Ball::irradiance:
    case Ball::sum:
      return hierarchy ? &hierarchy->sum[i] : &set.probes[i].self;
    case Ball::self:
      return &set.probes[i].self;
  }
  return nullptr;
}

}  // namespace

BallMesh make_ball(int levels) {
  BallMesh mesh = octahedron();
  for (int level = 0; level < levels; ++level) mesh = halved(mesh);
  return mesh;
}

BallShader::BallShader(BallMesh mesh) : mesh_(std::move(mesh)) {
  constexpr auto stride = static_cast<std::size_t>(sh::max_coefficient_count);
  basis_.resize(mesh_.vertices.size() * stride);
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
    sh::eval_basis(sh::max_degree, mesh_.vertices[v], std::span(basis_).subspan(v * stride, stride));
}

void BallShader::shade(const probes::ProbeSet& set, std::size_t i, Ball ball, std::span<vec3> out) const {
  constexpr auto stride = static_cast<std::size_t>(sh::max_coefficient_count);
  const sh::RadianceSh* function = function_of(set, i, ball);
  if (!function || function->empty()) {
    std::ranges::fill(out, vec3(0));
    return;
  }
  std::array<vec3, stride> coefficients;
  const std::size_t count = function->values.size();
  std::ranges::copy(function->values, coefficients.begin());
  if (ball == Ball::irradiance) {
    for (int l = 0; l <= function->degree(); ++l) {
      const auto factor = static_cast<float>(sh::cosine_band_factor(l) / pi_d);
      for (int m = -l; m <= l; ++m) coefficients[sh::coefficient_index(l, m)] *= factor;
    }
  }
  for (std::size_t v = 0; v < out.size(); ++v) {
    vec3 value(0);
    for (std::size_t k = 0; k < count; ++k) value += basis_[v * stride + k] * coefficients[k];
    out[v] = glm::max(value, vec3(0));
  }
}

int ball_levels(std::size_t balls) {
  return balls <= 64 ? 4 : balls <= 512 ? 3 : 2;
}

float seen_ball_size(float radius, const View& view, const vec3& place) {
  return view.orthographic ? radius : std::min(radius, widest_ball * glm::distance(view.eye, place));
}

float default_ball_size(const probes::ProbeSet& set) {
  std::vector<vec3> positions;
  for (const probes::Probe& probe : set.probes) positions.push_back(probe.position);
  if (positions.size() < 2) return 0.12f;
  const float spacing = probes::median_spacing(positions);
  return std::min(spacing / 6, std::max(0.12f, spacing / 20));
}

}  // namespace ssphh::viewer
