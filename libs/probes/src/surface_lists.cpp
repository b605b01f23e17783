#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/probes/surface_lists.h>

#include "still_surface.h"
#include "surface_entry.h"
#include "surface_samples.h"

namespace ssphh::probes {
namespace {

/// What one thread needs while it makes a cell's list.
struct Work {
  struct Candidate {
    std::uint32_t point;
    float order;                       ///< distance from the cell's middle, in the point's spacings, squared
    std::vector<std::uint32_t> asked;  ///< samples that it may light
    std::vector<char> seen;            ///< by those; empty: by all
    std::uint64_t outweighed = 0;      ///< squares with samples at which it does not count
  };
  SurfaceSamples samples;
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
        spacings_(surface_spacings(out.points)),
        reach_(surface_reach(out.points, spacings_)) {
    place_grid();
    cover_.resize(out_.points.size());
    parallel_for(cover_.size(), 64,
                 [&](std::size_t i) { cover_[i] = surface_cover(out_.points[i], spacings_[i], sees_); });
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
      out_.ranges.emplace_back(out_.lists.size(), list.size());
      out_.lists.insert(out_.lists.end(), list.begin(), list.end());
      list = {};
    }
  }

 private:
  void place_grid() {
    constexpr float most_cells = 1 << 21;
    scene::Bounds bounds;
    for (const StillTriangle& t : triangles_) bounds.add(t.a), bounds.add(t.b), bounds.add(t.c);
    std::vector<float> sorted = spacings_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    const float spacing = *middle;
    out_.cell_size = 2 * spacing / 3;
    // Surfaces of a wall in a cell's plane must not fall into either of two
    const vec3 extent = bounds.max - bounds.min + 0.5f * spacing;
    out_.origin = bounds.min - 0.25f * spacing;
    const auto number = [&] { return glm::ceil(extent / out_.cell_size); };
    while (number().x * number().y * number().z > most_cells) out_.cell_size *= 1.26f;
    out_.cells = ivec3(number());
  }

  std::vector<uvec4> list_of(std::size_t cell, Work& work) const {
    const auto c = static_cast<int>(cell);
    const vec3 number(c % out_.cells.x, c / out_.cells.x % out_.cells.y, c / (out_.cells.x * out_.cells.y));
    const vec3 corner = out_.origin + out_.cell_size * number;
    take_samples(cell, corner, work);
    if (work.samples.size() == 0) return {};

    find_candidates(corner, work);
    work.list.clear();
    for (const Work::Candidate& candidate : work.candidates) {
      if (work.list.size() == static_cast<std::size_t>(SurfaceLists::longest)) break;
      const std::uint32_t p = candidate.point;
      const int axis = surface_axis(out_.points[p].normal);
      const std::uint64_t squares = squares_of(candidate, axis, work);
      if (squares != 0) work.list.push_back(pack_surface_entry(p, cover_[p], axis, squares, spacings_[p]));
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
      const int axis = surface_axis(normal);
      visit_parts(whole, corner, corner + size, size / 8, [&](const StillTriangle& t) {
        const vec3 x = (t.a + t.b + t.c) / 3.0f;
        const ivec3 at(glm::floor((x - corner) * (8 / size)));
        // A part that sticks out belongs to the neighbour, but for slivers at the very edge
        if (glm::any(glm::lessThan(at, ivec3(0))) || glm::any(glm::greaterThan(at, ivec3(7)))) return;
        unsigned char& taken =
            work.taken[static_cast<std::size_t>(((at.z * 8 + at.y) * 8 + at.x) * 3 + axis)];
        if (taken++ < 2) work.samples.add(x, normal, (x - corner) / size);
        taken = std::min<unsigned char>(taken, 2);
      });
    }
  }

  /// Those that light some sample, and are not outweighed there; asks the samples.
  void find_candidates(const vec3& corner, Work& work) const {
    const float size = out_.cell_size;
    work.candidates.clear();
    reach_.visit_box(corner, corner + size, [&](std::uint32_t p, float) {
      const vec3 d = out_.points[p].position - (corner + 0.5f * size);
      const float spacing = spacings_[p];
      work.candidates.push_back({p, glm::dot(d, d) / (spacing * spacing), {}, {}, 0});
    });
    std::ranges::sort(work.candidates, [](const Work::Candidate& a, const Work::Candidate& b) {
      return a.order < b.order || (a.order == b.order && a.point < b.point);
    });
    for (Work::Candidate& candidate : work.candidates) {
      const int axis = surface_axis(out_.points[candidate.point].normal);
      work.samples.judge(out_.points[candidate.point], spacings_[candidate.point]);
      for (std::size_t i = 0; i < work.samples.size(); ++i) {
        const SurfaceSamples::Verdict verdict = work.samples.verdict(i);
        if (verdict == SurfaceSamples::asked) {
          candidate.asked.push_back(static_cast<std::uint32_t>(i));
        } else if (verdict == SurfaceSamples::outweighed) {
          candidate.outweighed |= work.samples.square(i, axis);
        }
      }
      if (!candidate.asked.empty()) ask(candidate, work);
    }
    std::erase_if(work.candidates, [](const Work::Candidate& c) { return c.asked.empty(); });
  }

  bool sees(const SurfaceSamples& samples, std::size_t i, std::uint32_t p) const {
    const rays::SurfacePoint& point = out_.points[p];
    const vec3 n = samples.normal(i);
    return see_along_surface({samples.position(i), samples.side(i, point.normal) == 1 ? -n : n}, point,
                             spacings_[p], sees_);
  }

  /// Asks a few samples first, then all where those disagree.
  void ask(Work::Candidate& candidate, Work& work) const {
    constexpr std::size_t few = 16;
    const std::size_t count = candidate.asked.size(), step = (count + few - 1) / few;
    std::size_t asked = 0, seen = 0;
    for (std::size_t i = 0; i < count; i += step, ++asked)
      seen += sees(work.samples, candidate.asked[i], candidate.point);
    if (seen < asked) candidate.seen.assign(count, 0);
    if (seen < asked && seen > 0) {
      for (std::size_t i = 0; i < count; ++i)
        candidate.seen[i] = sees(work.samples, candidate.asked[i], candidate.point);
    }
    if (seen == 0) return;
    const rays::SurfacePoint& point = out_.points[candidate.point];
    work.samples.weigh(point, spacings_[candidate.point], cover_[candidate.point]);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t sample = candidate.asked[i];
      if (candidate.seen.empty() || candidate.seen[i])
        work.samples.count_in(sample, work.samples.side(sample, point.normal));
    }
  }

  /// Whether something else stands so near before a sample that nobody looks in there: the wall behind a
  /// picture must not take light from the picture before it.
  bool is_narrow(SurfaceSamples& samples, std::size_t i, std::size_t side) const {
    return samples.narrow(i, side, [&] {
      const vec3 n = side == 1 ? -samples.normal(i) : samples.normal(i), x = samples.position(i);
      return !sees_(x + fitted_lift * out_.cell_size * n, x + 0.25f * out_.cell_size * n);
    });
  }

  /// Squares in which every sample sees the point, sides within bodies and narrow gaps apart. A square
  /// without samples is as those around it.
  std::uint64_t squares_of(const Work::Candidate& candidate, int axis, Work& work) const {
    if (candidate.seen.empty() && candidate.outweighed == 0) return ~std::uint64_t{0};
    std::uint64_t known = candidate.outweighed, hidden = candidate.outweighed;
    for (std::size_t i = 0; i < candidate.asked.size(); ++i) {
      const std::size_t sample = candidate.asked[i];
      const std::size_t side = work.samples.side(sample, out_.points[candidate.point].normal);
      if (!work.samples.alive(sample, side)) continue;
      const bool hides = !candidate.seen.empty() && !candidate.seen[i];
      if (hides && is_narrow(work.samples, sample, side)) continue;
      const std::uint64_t bit = work.samples.square(sample, axis);
      known |= bit;
      if (hides) hidden |= bit;
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
  std::vector<float> spacings_;
  std::vector<int> cover_;
  geometry::Balls reach_;
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
  std::vector<StillTriangle> triangles = still_triangles(scene, time);
  const bool apart = std::ranges::any_of(
      out.points, [&](const rays::SurfacePoint& p) { return p.position != out.points[0].position; });
  if (!apart || triangles.empty()) return out;
  Preparation(out, std::move(triangles), sees).run(control);
  return out;
}

}  // namespace ssphh::probes
