#pragma once
/// What a cooked file must give, from the set itself: the formulas of docs/cooked-files.md in double
/// precision, with rays in place of stored distances, and none of the runtime's code.

#include <algorithm>

#include <ssphh/core/sphere.h>
#include <ssphh/probes/fitted_surfaces.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::test {

/// Sight by the ray through the middle of a texel around a probe.
class TexelSight {
 public:
  TexelSight(const rays::TransportSource& source, float time, int size) : world_(source, time), size_(size) {}

  /// From `lifted`, a little above `at`.
  bool sees(const rays::SurfacePoint& at, const vec3& lifted, const vec3& probe) const {
    const glm::dvec3 away = glm::dvec3(at.position) - glm::dvec3(probe), n(at.normal);
    const double height = -glm::dot(n, away), length = glm::length(away);
    if (!at.moves && height < 0 && -height > 0.05 * length) return false;
    const vec3 d = lifted - probe;
    if (d == vec3(0)) return true;
    const CubePoint place = cube_point(d);
    const auto middle = [&](float s) {
      const int i = std::clamp(static_cast<int>(s * static_cast<float>(size_)), 0, size_ - 1);
      return (static_cast<float>(i) + 0.5f) / static_cast<float>(size_);
    };
    const vec3 ray = cube_direction_unnormalized({place.face, middle(place.s), middle(place.t)});
    const vec3 a = glm::abs(d);
    double asked = static_cast<double>(std::max({a.x, a.y, a.z}));
    const double slope = -glm::dot(n, glm::dvec3(ray));
    if (!at.moves && height > 0 && slope > 0) asked = std::min(asked, height / slope);
    const rays::RayQuery query{probe, ray};
    rays::RayHit hit;
    world_.intersect({&query, 1}, {&hit, 1});
    return static_cast<double>(hit.distance) * (1 + 1.5 / size_) >= asked;
  }

 private:
  rays::PosedWorld world_;
  int size_;
};

/// The points that light a place, of lists as prepare_surfaces makes them, and their weights.
struct ListedShares {
  std::vector<std::pair<std::size_t, double>> shares;  ///< sum 1; empty: none lights it

  ListedShares(const probes::SurfaceLists& lists, const rays::SurfacePoint& at) {
    using namespace probes;
    using glm::dvec3;
    if (at.moves || lists.empty()) return;
    const auto holds = [&](const SurfaceGrid& g) {
      return glm::all(glm::greaterThanEqual(at.position, g.origin)) &&
             glm::all(glm::lessThan((at.position - g.origin) / g.cell_size, vec3(g.cells)));
    };
    const auto grid = std::ranges::find_if(lists.grids, holds);
    if (grid == lists.grids.end()) return;
    const vec3 u = (at.position - grid->origin) / grid->cell_size;
    const ivec3 cell(glm::floor(u));
    const ivec3 q(glm::floor(8.0f * (u - vec3(cell))));
    const std::array parts = {q.y + 8 * q.z, q.x + 8 * q.z, q.x + 8 * q.y,
                              q.x / 2 + 4 * (q.y / 2) + 16 * (q.z / 2)};
    const uvec2 range =
        lists.ranges[grid->first +
                     static_cast<std::size_t>((cell.z * grid->cells.y + cell.y) * grid->cells.x + cell.x)];
    const Frame frame = Frame::around(at.normal);
    std::vector<dvec3> places;
    std::vector<std::pair<double, double>> near;  // of each its squared distance and its spacing
    double counted = 0, per_spacing = 0;
    for (unsigned i = 0; i < range.y; ++i) {
      const uvec4 e = lists.lists[range.x + i];
      const std::size_t point = e.x & 0x7ffffu;
      const int s = parts[e.x >> 22];
      if (!((s < 32 ? e.y : e.z) >> (s & 31) & 1u)) continue;
      const rays::SurfacePoint& p = lists.points[point];
      const auto spacing = static_cast<double>(std::bit_cast<float>(e.w));
      const dvec3 offset = dvec3(p.position) - dvec3(at.position), n(at.normal);
      const double d2 = glm::dot(offset, offset);
      const double t = std::max(1 - d2 / (9 * spacing * spacing), 0.0);
      const double facing = (glm::dot(dvec3(p.normal), n) - 0.7) / 0.3;
      const double off = glm::dot(offset, n) / (0.5 * spacing + 0.1 * std::sqrt(d2)), level = 1 - off * off;
      if (!(facing > 0) || !(level > 0) || !(t > 0)) continue;
      const int cover = e.x >> 19 & 7;
      const double quotient = d2 * std::pow(4.0, cover) / (spacing * spacing);
      const double weight =
          std::pow(t, 8) / spacing * facing * level * level / (cover == 0 ? 1 : 1 + quotient * quotient);
      shares.emplace_back(point, weight);
      places.push_back({1, glm::dot(offset, dvec3(frame.x)), glm::dot(offset, dvec3(frame.y))});
      near.emplace_back(d2, spacing);
      counted += weight, per_spacing += weight / spacing;
    }
    if (shares.empty()) return;
    double total = 0, square = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const auto& [d2, spacing] = near[i];
      const double weight = shares[i].second /=
          1 + std::pow(d2 / std::pow(2.5 * counted / per_spacing, 2), 2);
      total += weight, square += weight * spacing * spacing;
    }
    glm::dmat3 m(0);
    for (std::size_t i = 0; i < shares.size(); ++i)
      for (glm::length_t c = 0; c < 3; ++c) m[c] += shares[i].second / total * places[i][c] * places[i];
    m[1][1] += 0.05 * square / total, m[2][2] += 0.05 * square / total;
    const dvec3 row = glm::inverse(m)[0];
    double negative = 0, sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i)
      negative += shares[i].second / total * std::max(-glm::dot(row, places[i]), 0.0);
    const double most = std::min(1.0, 0.25 / negative);
    for (std::size_t i = 0; i < shares.size(); ++i)
      sum += shares[i].second *= 1 - most + most * glm::dot(row, places[i]);
    for (auto& share : shares) share.second /= sum;
  }
};

/// Irradiance of a place by the set, without its points or with lists of them.
class CookedReference {
 public:
  CookedReference(const scene::Scene& scene, const rays::TransportSource& source, const probes::ProbeSet& set,
                  int sight_size)
      : sight_(source, set.generator.time, sight_size), set_(set) {
    const rays::PosedWorld world(source, set.generator.time);
    const probes::SeesProbe sees = [&](const vec3& a, const vec3& b) { return world.visible(a, b); };
    if (set.surface) lists_ = probes::prepare_surfaces(scene, set.generator.time, set.surface->points, sees);
    if (set.fitted) {
      probes::FittedSurfaces fitted = probes::prepare_fitted(scene, set.generator.time, *set.fitted, sees);
      lists_ = fitted.surfaces, weights_ = fitted.weights;
    }
    std::vector<vec3> places;
    for (const probes::Probe& probe : set.probes) places.push_back(probe.position);
    const auto by_texel = [this](const vec3& lifted, const vec3& probe) {
      return sight_.sees(*asked_, lifted, probe);
    };
    probes::WeightParams mls;
    mls.method = probes::WeightMethod::mls;
    blended_.emplace(set, probes::make_weights(places, by_texel, mls));
    // Each probe by itself, for the points that blend them
    probes::ProbeSet one = set;
    one.surface.reset(), one.fitted.reset();
    for (std::size_t j = 0; set.fitted && j < set.probes.size(); ++j) {
      one.probes = {set.probes[j]};
      alone_.emplace_back(
          one, probes::make_weights(std::vector{places[j]}, [](const vec3&, const vec3&) { return true; }));
    }
  }

  vec3 irradiance(const rays::SurfacePoint& at) const {
    asked_ = &at;
    const ListedShares listed(lists_, at);
    if (listed.shares.empty()) return blended_->irradiance(at);
    glm::dvec3 e(0);
    for (const auto& [point, weight] : listed.shares) {
      if (set_.surface) {
        e += weight * glm::dvec3(set_.surface->light[point] * vec4(at.normal, 1));
        continue;
      }
      for (const probes::ProbeWeight& probe : weights_[point].used()) {
        const probes::IrradianceLookup& alone = alone_[probe.probe];
        e += weight * static_cast<double>(probe.weight) * glm::dvec3(alone.irradiance({vec3(0), at.normal}));
      }
    }
    return glm::max(vec3(e), vec3(0));
  }
  bool by_points(const rays::SurfacePoint& at) const { return !ListedShares(lists_, at).shares.empty(); }

 private:
  TexelSight sight_;
  const probes::ProbeSet& set_;
  probes::SurfaceLists lists_;
  std::vector<probes::PointWeights> weights_;
  std::optional<probes::IrradianceLookup> blended_;
  std::vector<probes::IrradianceLookup> alone_;
  mutable const rays::SurfacePoint* asked_ = nullptr;
};

}  // namespace ssphh::test
