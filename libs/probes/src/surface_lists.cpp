#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/probes/surface_lists.h>

#include "still_surface.h"
#include "surface_entry.h"
#include "surface_grids.h"
#include "surface_samples.h"

namespace ssphh::probes {
namespace {

/// Sight begins above the surface by shares of a point's spacing, or of so many cells where that is less: far
/// points of a plain, hundreds of metres apart, would be seen from above the roofs by what lies under a
/// house.
constexpr float most_cells_apart = 8;

/// Samples of a part of a cell on surfaces that face one axis: one of each sheet of a few, a picture's front
/// and back and the wall behind it.
struct Layers {
  static constexpr int most = 4;
  std::array<std::uint32_t, most> samples;
  int count = 0;
};

/// Whether a sample sees a point.
enum class Seen : std::uint8_t { no, yes, through_glass };

/// What one thread needs while it makes a cell's list.
struct Work {
  struct Candidate {
    std::uint32_t point;
    float order;                            ///< squared distance from the cell's middle, over the spacing [m]
    std::vector<std::uint32_t> asked;       ///< samples that it may light
    std::vector<Seen> seen;                 ///< by those; empty: by all
    std::vector<std::uint32_t> outweighed;  ///< samples at which it does not count
  };
  SurfaceSamples samples;
  std::vector<Layers> taken;  ///< in each part of a cell, by axis
  std::vector<Candidate> candidates;
  float finest = 0;                  ///< spacing of those
  std::vector<std::uint32_t> panes;  ///< triangles of glass in the cell
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
    out_.grids = surface_grids(triangles_, out_.points, spacings_);
    cover_.resize(out_.points.size());
    room_.resize(out_.points.size());
    parallel_for(cover_.size(), 64, [&](std::size_t i) {
      cover_[i] = surface_cover(out_.points[i], spacings_[i], sees_);
      room_[i] = headroom(out_.points[i], fitted_roof * spacings_[i], fitted_lift * spacings_[i], sees_);
    });
  }

  void run(const Control& control) {
    for (SurfaceGrid& grid : out_.grids) {
      grid.first = out_.ranges.size();
      const std::size_t count = grid.count();
      if (count == 0) continue;
      grid_ = &grid;
      in_cells_ = triangle_cells(triangles_, grid.origin, grid.cell_size, grid.cells);
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
  }

 private:
  std::vector<uvec4> list_of(std::size_t cell, Work& work) const {
    const auto c = static_cast<int>(cell);
    const ivec3& cells = grid_->cells;
    const vec3 number(c % cells.x, c / cells.x % cells.y, c / (cells.x * cells.y));
    const vec3 corner = grid_->origin + grid_->cell_size * number;
    if (hidden_by_first(corner)) return {};
    take_samples(cell, corner, work);
    if (work.samples.size() == 0) return {};

    work.panes.clear();
    for (std::size_t i = in_cells_.first[cell]; i < in_cells_.first[cell + 1]; ++i)
      if (triangles_[in_cells_.triangles[i]].glass) work.panes.push_back(in_cells_.triangles[i]);
    find_candidates(corner, work);
    work.list.clear();
    for (const Work::Candidate& candidate : work.candidates) {
      if (work.list.size() == static_cast<std::size_t>(SurfaceLists::longest)) break;
      const std::uint32_t p = candidate.point;
      const CutParts best = seen_parts(candidate, work);
      if (best.seen != 0)
        work.list.push_back(pack_surface_entry(p, cover_[p], best.cut, best.seen, spacings_[p]));
    }
    return work.list;
  }

  /// Whether the first grid is asked in all of a cell of the second.
  bool hidden_by_first(const vec3& corner) const {
    const SurfaceGrid& first = out_.grids[0];
    return grid_ != &first && glm::all(glm::greaterThanEqual(corner, first.origin)) &&
           glm::all(glm::lessThanEqual(corner + grid_->cell_size, first.end()));
  }

  /// A point of each sheet in each of the cell's 8³ parts for each direction that a surface may face, and in
  /// half a part around it: where a room ends a finger within the cell, all else in there may be of other
  /// rooms.
  void take_samples(std::size_t cell, const vec3& corner, Work& work) const {
    constexpr int parts = 8, along = parts + 2;
    work.samples.clear();
    work.taken.assign(along * along * along * 3, {});
    const float size = grid_->cell_size, part = size / parts;
    const vec3 low = corner - 0.5f * part, high = corner + size + 0.5f * part;
    for (std::size_t i = in_cells_.first[cell]; i < in_cells_.first[cell + 1]; ++i) {
      const StillTriangle& whole = triangles_[in_cells_.triangles[i]];
      const vec3 normal = glm::normalize(glm::cross(whole.b - whole.a, whole.c - whole.a));
      const int axis = surface_axis(normal);
      visit_parts(whole, low, high, part, [&](const StillTriangle& t) {
        const std::optional<vec3> x = middle_within(t, low, high);
        if (!x) return;
        const ivec3 at = glm::clamp(ivec3(glm::floor((*x - corner) / part)), -1, parts) + 1;
        Layers& taken = work.taken[((at.z * along + at.y) * along + at.x) * 3 + axis];
        if (taken.count == Layers::most || is_taken(taken, work.samples, *x, normal, part)) return;
        taken.samples[taken.count++] = static_cast<std::uint32_t>(work.samples.size());
        work.samples.add(*x, normal, glm::clamp((*x - corner) / size, 0.0f, 1.0f));
      });
    }
  }

  /// Whether a sample of this sheet is among them.
  static bool is_taken(const Layers& taken, const SurfaceSamples& samples, const vec3& x, const vec3& normal,
                       float part) {
    constexpr float off_sheet = 0.1f, same = 0.9f;  // in parts; a cosine
    return std::any_of(taken.samples.begin(), taken.samples.begin() + taken.count, [&](std::uint32_t i) {
      return std::abs(glm::dot(x - samples.position(i), normal)) < off_sheet * part &&
             glm::dot(normal, samples.normal(i)) > same;
    });
  }

  /// Those that light some sample, and are not outweighed there; asks the samples.
  void find_candidates(const vec3& corner, Work& work) const {
    const float size = grid_->cell_size;
    work.candidates.clear();
    reach_.visit_box(corner, corner + size, [&](std::uint32_t p, float) {
      const vec3 d = out_.points[p].position - (corner + 0.5f * size);
      const float spacing = spacings_[p];
      work.candidates.push_back({p, glm::dot(d, d) / spacing, {}, {}, {}});
    });
    work.finest = std::numeric_limits<float>::infinity();
    for (const Work::Candidate& candidate : work.candidates)
      work.finest = std::min(work.finest, spacings_[candidate.point]);
    std::ranges::sort(work.candidates, [](const Work::Candidate& a, const Work::Candidate& b) {
      return a.order < b.order || (a.order == b.order && a.point < b.point);
    });
    for (std::size_t number = 0; Work::Candidate & candidate : work.candidates) {
      work.samples.judge(out_.points[candidate.point], spacings_[candidate.point]);
      for (std::size_t i = 0; i < work.samples.size(); ++i) {
        const SurfaceSamples::Verdict verdict = work.samples.verdict(i);
        if (verdict == SurfaceSamples::asked) {
          candidate.asked.push_back(static_cast<std::uint32_t>(i));
        } else if (verdict == SurfaceSamples::outweighed) {
          candidate.outweighed.push_back(static_cast<std::uint32_t>(i));
        }
      }
      if (!candidate.asked.empty()) ask(candidate, number++, work);
    }
    std::erase_if(work.candidates, [](const Work::Candidate& c) { return c.asked.empty(); });
  }

  Seen sees(Work& work, std::size_t i, std::uint32_t p) const {
    const rays::SurfacePoint& point = out_.points[p];
    const std::size_t side = work.samples.side(i, point.normal);
    const vec3 n = work.samples.normal(i);
    const rays::SurfacePoint at{work.samples.position(i), side == 1 ? -n : n};
    const float most = most_cells_apart * grid_->cell_size, spacing = std::min(spacings_[p], most);
    const float above = work.samples.headroom(i, side, [&] {
      return headroom(at, fitted_roof * most, fitted_lift * std::min(work.finest, most), sees_);
    });
    const float room = std::min(above, room_[p]);
    if (see_along_surface(at, point, spacing, room, sees_)) return Seen::yes;
    if (work.panes.empty()) return Seen::no;
    const auto through = [&](const vec3& from, const vec3& to) {
      return sees_(from, to) || sees_through(work.panes, from, to);
    };
    return see_along_surface(at, point, spacing, room, through) ? Seen::through_glass : Seen::no;
  }

  /// Whether a pane of the cell, of one sheet or two, is all that stands in the way.
  bool sees_through(const std::vector<std::uint32_t>& panes, const vec3& from, const vec3& to) const {
    float first = 1, last = 0;
    for (const std::uint32_t pane : panes) {
      const std::optional<float> share = passed(triangles_[pane], from, to);
      if (share) first = std::min(first, *share), last = std::max(last, *share);
    }
    const float off_sheet = 1e-3f;  // of the way
    return first <= last && sees_(from, glm::mix(from, to, first - off_sheet)) &&
           sees_(glm::mix(from, to, last + off_sheet), to);
  }

  /// Asks some samples first, other ones for the next candidate, then the others where those disagree.
  void ask(Work::Candidate& candidate, std::size_t number, Work& work) const {
    constexpr std::size_t few = 32;
    const std::size_t count = candidate.asked.size(), step = (count + few - 1) / few, begin = number % step;
    std::size_t asked = 0, seen = 0;
    candidate.seen.assign(count, Seen::no);
    const auto look = [&](std::size_t i) {
      candidate.seen[i] = sees(work, candidate.asked[i], candidate.point);
      seen += candidate.seen[i] == Seen::yes, ++asked;
    };
    for (std::size_t i = begin; i < count; i += step) look(i);
    if (seen == asked) {
      candidate.seen.clear();
    } else if (seen > 0) {
      for (std::size_t i = 0; i < count; ++i)
        if (i % step != begin) look(i);
    }
    const rays::SurfacePoint& point = out_.points[candidate.point];
    work.samples.weigh(point, spacings_[candidate.point], cover_[candidate.point]);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t sample = candidate.asked[i];
      const bool known = asked == count || i % step == begin;  // else it may lie in a thin wall
      const bool is_seen = candidate.seen.empty() || candidate.seen[i] == Seen::yes;
      const std::size_t side = work.samples.side(sample, point.normal);
      work.samples.count_in(sample, side, spacings_[candidate.point], is_seen, known);
    }
  }

  /// Whether something else stands so near before a sample that nobody looks in there: the wall behind a
  /// picture must not take light from the picture before it.
  bool is_narrow(SurfaceSamples& samples, std::size_t i, std::size_t side) const {
    return samples.narrow(i, side, [&] {
      const vec3 n = side == 1 ? -samples.normal(i) : samples.normal(i), x = samples.position(i);
      return !sees_(x + fitted_lift * grid_->cell_size * n, x + 0.25f * grid_->cell_size * n);
    });
  }

  struct CutParts {
    int cut;
    std::uint64_t seen;    ///< parts of the cell, so cut, in which the point is looked up
    std::size_t lost = 0;  ///< samples that see it, in other parts
  };

  /// By the cut that loses least: columns serve a wall, cubes the folds of a curtain.
  CutParts seen_parts(const Work::Candidate& candidate, Work& work) const {
    const int axis = surface_axis(out_.points[candidate.point].normal);
    if (candidate.seen.empty() && candidate.outweighed.empty()) return {axis, ~std::uint64_t{0}};
    CutParts best = cut_so(candidate, axis, work);
    for (int cut = 0; cut < cut_count && best.lost > 0; ++cut) {
      const CutParts other = cut_so(candidate, cut, work);
      if (other.lost < best.lost) best = other;
    }
    return best;
  }

  /// Parts in which some sample sees the point, and all others do so at least through a pane that divides the
  /// part, sides within bodies and narrow gaps apart. A part without samples is as those around it.
  CutParts cut_so(const Work::Candidate& candidate, int cut, Work& work) const {
    std::uint64_t known = 0, hidden = 0, seen = 0;
    for (const std::uint32_t sample : candidate.outweighed) hidden |= work.samples.part(sample, cut);
    known = hidden;
    const auto visit = [&](const auto& of_sample) {
      for (std::size_t i = 0; i < candidate.asked.size(); ++i) {
        const std::size_t sample = candidate.asked[i];
        const std::size_t side = work.samples.side(sample, out_.points[candidate.point].normal);
        if (!work.samples.alive(sample, side)) continue;
        const Seen sees = candidate.seen.empty() ? Seen::yes : candidate.seen[i];
        if (sees == Seen::yes || !is_narrow(work.samples, sample, side))
          of_sample(work.samples.part(sample, cut), sees);
      }
    };
    visit([&](std::uint64_t part, Seen sees) {
      known |= part;
      if (sees == Seen::no) hidden |= part;
      if (sees == Seen::yes) seen |= part;
    });
    CutParts out{cut, seen & ~hidden};
    visit([&](std::uint64_t part, Seen sees) { out.lost += sees == Seen::yes && (hidden & part) != 0; });
    while (out.seen != 0 && ~known != 0) {
      const std::uint64_t near_hidden = grown_parts(known & ~out.seen, cut) & ~known,
                          near_seen = grown_parts(out.seen, cut) & ~known & ~near_hidden;
      out.seen |= near_seen;
      known |= near_hidden | near_seen;
    }
    return out;
  }

  SurfaceLists& out_;
  std::vector<StillTriangle> triangles_;
  const SeesProbe& sees_;
  std::vector<float> spacings_;
  std::vector<int> cover_;
  std::vector<float> room_;  ///< headroom() up to that of see_along_surface [m]
  geometry::Balls reach_;
  const SurfaceGrid* grid_ = nullptr;  ///< whose lists are made
  TriangleCells in_cells_;             ///< of that
};

}  // namespace

SurfaceLists prepare_surfaces(const scene::Scene& scene, float time, std::vector<rays::SurfacePoint> points,
                              const SeesProbe& sees, const Control& control) {
  require(sees != nullptr, "surface points", "nothing tells what sees them");
  scene::check_indices(scene);
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
