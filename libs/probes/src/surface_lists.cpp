#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/geometry/nearest.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/probes/surface_lists.h>

#include "still_surface.h"
#include "surface_entry.h"

namespace ssphh::probes {
namespace {

// By how much less than SurfaceInterpolation takes a point's normal may agree with the surface's:
// shading normals are not those.
constexpr float least_cosine = 0.2f;

std::vector<vec3> positions_of(std::span<const rays::SurfacePoint> points) {
  std::vector<vec3> positions;
  for (const rays::SurfacePoint& point : points) positions.push_back(point.position);
  return positions;
}

struct Sample {
  vec3 position, normal;  ///< of one side; the other's is −normal
  /// Whether any point that faces this side's way, or the other's, is seen from there. What sees none lies
  /// within a body, and has no say.
  std::array<bool, 2> alive{};
};

/// What one thread needs while it makes a cell's list.
struct Work {
  struct Candidate {
    std::uint32_t point;
    std::vector<std::uint32_t> asked;  ///< samples that it may light
    std::vector<char> seen;            ///< by those; empty: by all
  };
  std::vector<geometry::Near> near;
  std::vector<Sample> samples;
  std::vector<unsigned char> taken;
  std::vector<Candidate> candidates;
  std::vector<uvec4> list;
};

class Preparation {
 public:
  Preparation(SurfaceLists& out, std::vector<StillTriangle> triangles, const SeesProbe& sees)
      : out_(out),
        triangles_(std::move(triangles)),
        sees_(sees),
        positions_(positions_of(out.points)),
        near_(positions_) {
    place_grid();
    cover_.resize(out_.points.size());
    parallel_for(cover_.size(), 64,
                 [&](std::size_t i) { cover_[i] = surface_cover(out_.points[i], out_.spacing, sees_); });
    in_cells_ = triangle_cells(triangles_, out_.origin, out_.cell_size, out_.cells);
  }

  void run(const Control& control) {
    const std::size_t count = in_cells_.first.size() - 1;
    std::vector<std::vector<uvec4>> lists(count);
    parallel_for(
        count, 16,
        [&](std::size_t begin, std::size_t end) {
          Work work;
          for (std::size_t cell = begin; cell < end; ++cell) {
            if (in_cells_.first[cell] < in_cells_.first[cell + 1]) lists[cell] = list_of(cell, work);
          }
        },
        control);
    for (std::vector<uvec4>& list : lists) {
      const std::size_t points = list.empty() ? 0 : list.size() - 1;
      out_.ranges.emplace_back(out_.lists.size(), points);
      if (points > 0) out_.lists.insert(out_.lists.end(), list.begin(), list.end());
      list = {};
    }
  }

 private:
  void place_grid() {
    constexpr float most_cells = 1 << 21;
    scene::Bounds bounds;
    for (const StillTriangle& t : triangles_) bounds.add(t.a), bounds.add(t.b), bounds.add(t.c);
    out_.cell_size = 2 * out_.spacing / 3;  // so that a lookup's reach, four spacings, is six cells
    // Surfaces of a wall in a cell's plane must not fall into either of two
    const vec3 extent = bounds.max - bounds.min + 0.5f * out_.spacing;
    out_.origin = bounds.min - 0.25f * out_.spacing;
    const auto number = [&] { return glm::ceil(extent / out_.cell_size); };
    while (number().x * number().y * number().z > most_cells) out_.cell_size *= 1.26f;
    out_.cells = ivec3(number());
  }

  /// How far a lookup at x looks [m].
  float reach(const vec3& x) const {
    const float radius = 4 * out_.spacing;
    std::array<geometry::Near, most_surface_points> near;
    const int count = near_.find(x, near, radius);
    return count == static_cast<int>(most_surface_points)
               ? std::sqrt(near[most_surface_points - 1].distance2) * 1.0001f
               : radius;
  }

  std::vector<uvec4> list_of(std::size_t cell, Work& work) const {
    const auto c = static_cast<int>(cell);
    const vec3 number(c % out_.cells.x, c / out_.cells.x % out_.cells.y, c / (out_.cells.x * out_.cells.y));
    const vec3 corner = out_.origin + out_.cell_size * number;
    take_samples(cell, corner, work);
    if (work.samples.empty()) return {};

    std::array<float, 8> reaches;
    float farthest = 0;
    for (int i = 0; i < 8; ++i) {
      const float r = reach(corner + out_.cell_size * vec3(i & 1, i >> 1 & 1, i >> 2));
      reaches[static_cast<std::size_t>(i)] = r;
      farthest = std::max(farthest, r);
    }
    find_candidates(corner, farthest, work);
    for (Work::Candidate& candidate : work.candidates) ask(candidate, work);
    for (const Work::Candidate& candidate : work.candidates) {
      for (std::size_t i = 0; i < candidate.asked.size(); ++i) {
        Sample& s = work.samples[candidate.asked[i]];
        s.alive[side(s, candidate.point)] |= candidate.seen.empty() || candidate.seen[i];
      }
    }

    work.list.assign(1, uvec4(0));
    for (int i = 0; i < 4; ++i) {
      const auto k = static_cast<std::size_t>(2 * i);
      work.list[0][i] = glm::packHalf2x16(vec2(reaches[k], reaches[k + 1]));
    }
    for (const Work::Candidate& candidate : work.candidates) {
      if (work.list.size() > static_cast<std::size_t>(SurfaceLists::longest)) break;
      const rays::SurfacePoint& point = out_.points[candidate.point];
      const CoarseNormal normal = CoarseNormal::of(point.normal);
      const std::uint64_t squares = squares_of(candidate, normal.axis(), corner, work);
      if (squares == 0) continue;
      work.list.push_back(pack_surface_entry(candidate.point, cover_[candidate.point],
                                             (point.position - corner) / out_.cell_size, normal, squares));
    }
    return work.list;
  }

  /// At most two points in each of the cell's 8³ parts for each direction that a surface may face.
  void take_samples(std::size_t cell, const vec3& corner, Work& work) const {
    work.samples.clear();
    work.taken.assign(512 * 3, 0);
    const float size = out_.cell_size;
    for (std::size_t i = in_cells_.first[cell]; i < in_cells_.first[cell + 1]; ++i) {
      const StillTriangle& whole = triangles_[in_cells_.triangles[i]];
      const vec3 normal = glm::normalize(glm::cross(whole.b - whole.a, whole.c - whole.a));
      const int axis = CoarseNormal::of(normal).axis();
      visit_parts(whole, corner, corner + size, size / 8, [&](const StillTriangle& t) {
        const vec3 x = (t.a + t.b + t.c) / 3.0f;
        const ivec3 at(glm::floor((x - corner) * (8 / size)));
        // A part that sticks out belongs to the neighbour, but for slivers at the very edge
        if (glm::any(glm::lessThan(at, ivec3(0))) || glm::any(glm::greaterThan(at, ivec3(7)))) return;
        unsigned char& taken =
            work.taken[static_cast<std::size_t>(((at.z * 8 + at.y) * 8 + at.x) * 3 + axis)];
        if (taken++ < 2) work.samples.push_back({x, normal});
        taken = std::min<unsigned char>(taken, 2);
      });
    }
  }

  void find_candidates(const vec3& corner, float farthest, Work& work) const {
    const float size = out_.cell_size;
    const vec3 middle = corner + 0.5f * size;
    work.near.resize(std::min<std::size_t>(256, positions_.size()));
    const int found = near_.find(middle, work.near, 1.02f * farthest + 0.87f * size);
    work.candidates.clear();
    for (int k = 0; k < found; ++k) {
      const auto p = static_cast<std::uint32_t>(work.near[static_cast<std::size_t>(k)].index);
      const rays::SurfacePoint& point = out_.points[p];
      Work::Candidate candidate{p, {}, {}};
      for (std::size_t i = 0; i < work.samples.size(); ++i) {
        const Sample& s = work.samples[i];
        const vec3 d = point.position - s.position;
        const float distance2 = glm::dot(d, d);
        if (std::abs(glm::dot(s.normal, point.normal)) < least_cosine ||
            distance2 > 1.05f * farthest * farthest)
          continue;
        // A shading normal may lean toward the point
        const float off = std::abs(glm::dot(d, s.normal));
        if (off > 0.75f * out_.spacing + 0.3f * std::sqrt(distance2)) continue;
        candidate.asked.push_back(static_cast<std::uint32_t>(i));
      }
      if (!candidate.asked.empty()) work.candidates.push_back(std::move(candidate));
    }
  }

  /// 1 where the point faces the other side's way.
  std::size_t side(const Sample& sample, std::uint32_t p) const {
    return glm::dot(sample.normal, out_.points[p].normal) < 0;
  }

  bool sees(const Sample& sample, std::uint32_t p) const {
    const rays::SurfacePoint& point = out_.points[p];
    const vec3 n = side(sample, p) ? -sample.normal : sample.normal;
    return see_along_surface({sample.position, n}, point, out_.spacing, sees_);
  }

  /// Asks a few samples first, then all where those disagree.
  void ask(Work::Candidate& candidate, const Work& work) const {
    constexpr std::size_t few = 16;
    const std::size_t count = candidate.asked.size(), step = (count + few - 1) / few;
    std::size_t asked = 0, seen = 0;
    for (std::size_t i = 0; i < count; i += step, ++asked)
      seen += sees(work.samples[candidate.asked[i]], candidate.point);
    if (seen == asked) return;
    candidate.seen.assign(count, 0);
    if (seen == 0) return;
    for (std::size_t i = 0; i < count; ++i)
      candidate.seen[i] = sees(work.samples[candidate.asked[i]], candidate.point);
  }

  /// Squares in which every sample sees the point, sides within bodies apart. A square
  /// without samples is as those around it.
  std::uint64_t squares_of(const Work::Candidate& candidate, int axis, const vec3& corner,
                           const Work& work) const {
    if (candidate.seen.empty()) return ~std::uint64_t{0};
    std::uint64_t known = 0, hidden = 0;
    for (std::size_t i = 0; i < candidate.asked.size(); ++i) {
      const Sample& s = work.samples[candidate.asked[i]];
      if (!s.alive[side(s, candidate.point)]) continue;
      const std::uint64_t bit = std::uint64_t{1}
                                << surface_square((s.position - corner) / out_.cell_size, axis);
      known |= bit;
      if (!candidate.seen[i]) hidden |= bit;
    }
    std::uint64_t seen = known & ~hidden;
    if (seen == 0) return 0;
    constexpr std::uint64_t not_first = 0xfefefefefefefefe, not_last = 0x7f7f7f7f7f7f7f7f;
    const auto grown = [](std::uint64_t m) {
      const std::uint64_t wide = m | (m << 1 & not_first) | (m >> 1 & not_last);
      return wide | wide << 8 | wide >> 8;
    };
    while (~known != 0) {
      const std::uint64_t near_hidden = grown(known & ~seen) & ~known,
                          near_seen = grown(seen) & ~known & ~near_hidden;
      seen |= near_seen;
      known |= near_hidden | near_seen;
    }
    return seen;
  }

  SurfaceLists& out_;
  std::vector<StillTriangle> triangles_;
  const SeesProbe& sees_;
  std::vector<vec3> positions_;
  std::vector<int> cover_;
  geometry::NearestPoints near_;
  TriangleCells in_cells_;
};

}  // namespace

SurfaceLists prepare_surfaces(const scene::Scene& scene, float time, std::vector<rays::SurfacePoint> points,
                              const SeesProbe& sees, const Control& control) {
  SurfaceLists out;
  out.points = std::move(points);
  if (out.points.size() > SurfaceLists::most_points)
    throw Error("surface points", fmt::format("there are {}, at most {} can be drawn", out.points.size(),
                                              SurfaceLists::most_points));
  out.spacing = surface_spacing(out.points);
  std::vector<StillTriangle> triangles = still_triangles(scene, time);
  if (!std::isfinite(out.spacing) || triangles.empty()) return out;
  Preparation(out, std::move(triangles), sees).run(control);
  return out;
}

}  // namespace ssphh::probes
