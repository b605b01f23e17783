#include "surface_list_maker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ssphh/core/parallel.h>
#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/surface_interpolation.h>

#include "surface_entry.h"

namespace ssphh::probes {
namespace {

/// Sight begins above the surface by shares of a point's spacing, or of so many cells where that is less: far
/// points of a plain, hundreds of metres apart, would be seen from above the roofs by what lies under a
/// house.
constexpr float most_cells_apart = 8;

/// Several cells share a list where no point near them has less for spacing than so many of their box's
/// sides: as many as a cell of the first grid has, about.
constexpr float least_spacing = 1.5f;

/// Whether a sample of this sheet is among them.
bool is_taken(const SampleLayers& taken, const SurfaceSamples& samples, const vec3& x, const vec3& normal,
              float part) {
  constexpr float off_sheet = 0.1f, same = 0.9f;  // in parts; a cosine
  return std::any_of(taken.samples.begin(), taken.samples.begin() + taken.count, [&](std::uint32_t i) {
    return std::abs(glm::dot(x - samples.position(i), normal)) < off_sheet * part &&
           glm::dot(normal, samples.normal(i)) > same;
  });
}

}  // namespace

SurfaceListMaker::SurfaceListMaker(std::span<const rays::SurfacePoint> points,
                                   std::vector<StillTriangle> triangles, const SeesProbe& sees)
    : points_(points),
      triangles_(std::move(triangles)),
      sees_(sees),
      spacings_(surface_spacings(points)),
      cover_(points.size()),
      room_(points.size()),
      reach_(surface_reach(points, spacings_)) {
  parallel_for(points.size(), 64, [&](std::size_t i) {
    cover_[i] = surface_cover(points[i], spacings_[i], sees_);
    room_[i] = headroom(points[i], fitted_roof * spacings_[i], fitted_lift * spacings_[i], sees_);
  });
}

bool SurfaceListMaker::make(const ListedBox& box, ListWork& work) const {
  work.list.clear();
  work.cell_size = box.cell_size;
  find_near(box, work);
  if (work.candidates.empty()) return true;
  if (!box.one_cell()) {
    if (work.finest < least_spacing * box.size) return false;
    std::ranges::sort(work.triangles);
    work.triangles.erase(std::unique(work.triangles.begin(), work.triangles.end()), work.triangles.end());
  }
  take_samples(box, work);
  if (work.samples.size() == 0) return true;

  work.panes.clear();
  for (const std::uint32_t t : work.triangles)
    if (triangles_[t].glass) work.panes.push_back(t);
  if (!ask_all(box.one_cell(), work)) return false;
  for (const ListWork::Candidate& candidate : work.candidates) {
    if (work.list.size() == static_cast<std::size_t>(SurfaceLists::longest)) break;
    const std::uint32_t p = candidate.point;
    const CutParts best = box.one_cell() ? seen_parts(candidate, work) : CutParts{0, ~std::uint64_t{0}};
    if (best.seen != 0)
      work.list.push_back(pack_surface_entry(p, cover_[p], best.cut, best.seen, spacings_[p]));
  }
  return true;
}

/// A point of each sheet in each of the box's 8³ parts for each direction that a surface may face, and in
/// half a part around it: where a room ends a finger within the box, all else in there may be of other
/// rooms.
void SurfaceListMaker::take_samples(const ListedBox& box, ListWork& work) const {
  constexpr int parts = 8, along = parts + 2;
  work.samples.clear();
  work.taken.assign(along * along * along * 3, {});
  const vec3& corner = box.corner;
  const float size = box.size, part = size / parts;
  const vec3 low = corner - 0.5f * part, high = corner + size + 0.5f * part;
  for (const std::uint32_t number : work.triangles) {
    const StillTriangle& whole = triangles_[number];
    const vec3 normal = glm::normalize(glm::cross(whole.b - whole.a, whole.c - whole.a));
    const int axis = surface_axis(normal);
    visit_parts(whole, low, high, part, [&](const StillTriangle& t) {
      const std::optional<vec3> x = middle_within(t, low, high);
      if (!x) return;
      const ivec3 at = glm::clamp(ivec3(glm::floor((*x - corner) / part)), -1, parts) + 1;
      SampleLayers& taken = work.taken[((at.z * along + at.y) * along + at.x) * 3 + axis];
      if (taken.count == SampleLayers::most || is_taken(taken, work.samples, *x, normal, part)) return;
      taken.samples[taken.count++] = static_cast<std::uint32_t>(work.samples.size());
      work.samples.add(*x, normal, glm::clamp((*x - corner) / size, 0.0f, 1.0f));
    });
  }
}

/// All whose reach meets a box.
void SurfaceListMaker::find_near(const ListedBox& box, ListWork& work) const {
  const vec3 end = box.corner + box.size, middle = box.corner + 0.5f * box.size;
  work.candidates.clear();
  work.finest = std::numeric_limits<float>::infinity();
  reach_.visit_box(box.corner, end, [&](std::uint32_t p, float) {
    const vec3 d = points_[p].position - middle;
    const float spacing = spacings_[p];
    work.candidates.push_back({p, glm::dot(d, d) / spacing, {}, {}, {}});
    work.finest = std::min(work.finest, spacing);
  });
}

/// Keeps those that light some sample, and are not outweighed there, and asks the samples. Unless they are
/// of one cell, stops at the first that some sample does not see: false.
bool SurfaceListMaker::ask_all(bool one_cell, ListWork& work) const {
  std::ranges::sort(work.candidates, [](const ListWork::Candidate& a, const ListWork::Candidate& b) {
    return a.order < b.order || (a.order == b.order && a.point < b.point);
  });
  for (std::size_t number = 0; ListWork::Candidate & candidate : work.candidates) {
    work.samples.judge(points_[candidate.point], spacings_[candidate.point]);
    for (std::size_t i = 0; i < work.samples.size(); ++i) {
      const SurfaceSamples::Verdict verdict = work.samples.verdict(i);
      if (verdict == SurfaceSamples::asked) {
        candidate.asked.push_back(static_cast<std::uint32_t>(i));
      } else if (verdict == SurfaceSamples::outweighed) {
        candidate.outweighed.push_back(static_cast<std::uint32_t>(i));
      }
    }
    if (!candidate.asked.empty()) ask(candidate, number++, work);
    if (!one_cell && !candidate.seen.empty()) return false;
  }
  std::erase_if(work.candidates, [](const ListWork::Candidate& c) { return c.asked.empty(); });
  return true;
}

Seen SurfaceListMaker::sees(ListWork& work, std::size_t i, std::uint32_t p) const {
  const rays::SurfacePoint& point = points_[p];
  const std::size_t side = work.samples.side(i, point.normal);
  const vec3 n = work.samples.normal(i);
  const rays::SurfacePoint at{work.samples.position(i), side == 1 ? -n : n};
  const float most = most_cells_apart * work.cell_size, spacing = std::min(spacings_[p], most);
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

/// Whether a pane of the box, of one sheet or two, is all that stands in the way.
bool SurfaceListMaker::sees_through(const std::vector<std::uint32_t>& panes, const vec3& from,
                                    const vec3& to) const {
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
void SurfaceListMaker::ask(ListWork::Candidate& candidate, std::size_t number, ListWork& work) const {
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
  const rays::SurfacePoint& point = points_[candidate.point];
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
bool SurfaceListMaker::is_narrow(ListWork& work, std::size_t i, std::size_t side) const {
  const SurfaceSamples& samples = work.samples;
  return work.samples.narrow(i, side, [&] {
    const vec3 n = side == 1 ? -samples.normal(i) : samples.normal(i), x = samples.position(i);
    return !sees_(x + fitted_lift * work.cell_size * n, x + 0.25f * work.cell_size * n);
  });
}

/// By the cut that loses least: columns serve a wall, cubes the folds of a curtain.
SurfaceListMaker::CutParts SurfaceListMaker::seen_parts(const ListWork::Candidate& candidate,
                                                        ListWork& work) const {
  const int axis = surface_axis(points_[candidate.point].normal);
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
SurfaceListMaker::CutParts SurfaceListMaker::cut_so(const ListWork::Candidate& candidate, int cut,
                                                    ListWork& work) const {
  std::uint64_t known = 0, hidden = 0, seen = 0;
  for (const std::uint32_t sample : candidate.outweighed) hidden |= work.samples.part(sample, cut);
  known = hidden;
  const auto visit = [&](const auto& of_sample) {
    for (std::size_t i = 0; i < candidate.asked.size(); ++i) {
      const std::size_t sample = candidate.asked[i];
      const std::size_t side = work.samples.side(sample, points_[candidate.point].normal);
      if (!work.samples.alive(sample, side)) continue;
      const Seen sees = candidate.seen.empty() ? Seen::yes : candidate.seen[i];
      if (sees == Seen::yes || !is_narrow(work, sample, side))
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

}  // namespace ssphh::probes
