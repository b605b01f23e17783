#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/transport/surfels.h>

namespace ssphh::transport {
namespace {

constexpr int axis_bits = 15;
constexpr std::size_t max_members = 48;

/// Which of ±x, ±y, ±z the normal is nearest to: 0..5.
int direction_bin(const vec3& n) {
  const vec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
  return 2 * axis + (n[axis] < 0);
}

/// How the points of one cell are divided: `owner` indexes known surfels first, then the cell's new ones.
struct CellResult {
  std::vector<std::size_t> founders;  ///< points that become representatives
  std::vector<int> owner;             ///< per point of the cell
};

}  // namespace

SurfelSet::SurfelSet(const rays::TransportSource& source, float size) : source_(source), size_(size) {
  if (!(size > 0) || !std::isfinite(size))
    throw Error("surfel size", fmt::format("{} m is no size", size), "give a positive number of metres");
  for (int part = 0; part < source.part_count(); ++part) {
    const scene::Bounds bounds = source.part_bounds(part);
    // A quarter of a voxel off, or walls at the bounds would lie on the border of two voxels and rounding
    // would make two surfels of each.
    origin_.push_back(bounds.empty() ? vec3(0) : bounds.min - 2.25f * size);
    if (bounds.empty()) continue;
    const float extent = max_component(bounds.max - bounds.min);
    if (extent / size > static_cast<float>((1 << axis_bits) - 8)) {
      throw Error("surfel size", fmt::format("{} m divides a scene of {} m too finely", size, extent),
                  fmt::format("at least {:.3g} m", extent / 32000));
    }
  }
}

SurfelSet::Voxel SurfelSet::voxel(int part, const vec3& position) const {
  const vec3 v = glm::floor((position - origin_[static_cast<std::size_t>(part)]) / size_);
  const vec3 c = glm::clamp(v, 1.0f, static_cast<float>((1 << axis_bits) - 2));
  return {static_cast<int>(c.x), static_cast<int>(c.y), static_cast<int>(c.z)};
}

std::uint64_t SurfelSet::key(int part, const Voxel& v, int bin) {
  std::uint64_t k = static_cast<std::uint64_t>(part);
  for (const int c : {v.x, v.y, v.z}) k = k << axis_bits | static_cast<std::uint64_t>(c);
  return k << 3 | static_cast<std::uint64_t>(bin);
}

rays::RayQuery SurfelSet::segment(const rays::SurfacePoint& a, const rays::SurfacePoint& b) const {
  const vec3 from = a.position + lift() * a.normal, to = b.position + lift() * b.normal;
  return {from, to - from, 1};
}

std::span<const int> SurfelSet::cell(int part, const rays::SurfacePoint& point) const {
  const auto found = cells_.find(key(part, voxel(part, point.position), direction_bin(point.normal)));
  if (found == cells_.end()) return {};
  return found->second;
}

std::vector<int> SurfelSet::candidates(int part, const rays::SurfacePoint& point) const {
  const Voxel centre = voxel(part, point.position);
  const int bin = direction_bin(point.normal);
  std::vector<int> own, around;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const auto found = cells_.find(key(part, {centre.x + x, centre.y + y, centre.z + z}, bin));
        if (found == cells_.end()) continue;
        std::vector<int>& list = x == 0 && y == 0 && z == 0 ? own : around;
        list.insert(list.end(), found->second.begin(), found->second.end());
      }
    }
  }
  const auto nearer = [&](int a, int b) {
    const auto distance2 = [&](int s) {
      const vec3 d = surfels_[static_cast<std::size_t>(s)].point.position - point.position;
      return glm::dot(d, d);
    };
    return std::pair(distance2(a), a) < std::pair(distance2(b), b);
  };
  std::ranges::sort(own, nearer);
  std::ranges::sort(around, nearer);
  own.insert(own.end(), around.begin(), around.end());
  return own;
}

std::vector<int> SurfelSet::add(int part, std::span<const ClusterPoint> points) {
  // Bring the points of each cell together, in their order.
  std::vector<std::pair<std::uint64_t, std::size_t>> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const rays::SurfacePoint& p = points[i].point;
    order[i] = {key(part, voxel(part, p.position), direction_bin(p.normal)), i};
  }
  std::ranges::sort(order);
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) runs.push_back(i);
  }
  runs.push_back(order.size());

  // Divide every cell by sight: those that the first unowned point sees are its own.
  const std::size_t cell_count = runs.empty() ? 0 : runs.size() - 1;
  std::vector<CellResult> results(cell_count);
  parallel_for(cell_count, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> left, still_left;
    std::vector<rays::RayQuery> segments;
    std::vector<std::uint8_t> blocked;
    for (std::size_t c = begin; c < end; ++c) {
      const std::size_t first = runs[c], size = runs[c + 1] - first;
      CellResult& result = results[c];
      result.owner.assign(size, no_surfel);
      const auto point = [&](std::size_t local) -> const rays::SurfacePoint& {
        return points[order[first + local].second].point;
      };
      left.clear();
      for (std::size_t i = 0; i < size; ++i) left.push_back(i);
      const auto claim = [&](const rays::SurfacePoint& representative, int owner) {
        segments.clear();
        for (const std::size_t i : left) segments.push_back(segment(representative, point(i)));
        blocked.resize(segments.size());
        source_.occluded(part, segments, blocked);
        still_left.clear();
        for (std::size_t i = 0; i < left.size(); ++i) {
          if (blocked[i])
            still_left.push_back(left[i]);
          else
            result.owner[left[i]] = owner;
        }
        left.swap(still_left);
      };
      const auto known = cells_.find(order[first].first);
      int owner = 0;
      if (known != cells_.end()) {
        for (const int s : known->second) {
          if (left.empty()) break;
          claim(surfels_[static_cast<std::size_t>(s)].point, owner++);
        }
        owner = static_cast<int>(known->second.size());
      }
      while (!left.empty()) {
        const std::size_t founder = left.front();
        result.founders.push_back(order[first + founder].second);
        result.owner[founder] = owner;
        left.erase(left.begin());
        claim(point(founder), owner++);
      }
    }
  });

  // Number the new surfels by cell and book the members.
  std::vector<int> surfel_of(points.size(), no_surfel);
  for (std::size_t c = 0; c < cell_count; ++c) {
    std::vector<int>& list = cells_[order[runs[c]].first];
    for (const std::size_t founder : results[c].founders) {
      list.push_back(static_cast<int>(surfels_.size()));
      surfels_.push_back({points[founder].point, vec3(0), part});
      albedo_sum_.emplace_back(0);
      member_count_.push_back(0);
      members_.emplace_back();
    }
    for (std::size_t i = 0; i < results[c].owner.size(); ++i) {
      const std::size_t point = order[runs[c] + i].second;
      const int s = list[static_cast<std::size_t>(results[c].owner[i])];
      surfel_of[point] = s;
      const auto index = static_cast<std::size_t>(s);
      albedo_sum_[index] += glm::dvec3(points[point].albedo);
      member_count_[index] += 1;
      if (members_[index].size() < max_members) members_[index].push_back(points[point].point);
    }
  }
  return surfel_of;
}

void SurfelSet::update_albedo() {
  for (std::size_t s = 0; s < surfels_.size(); ++s)
    surfels_[s].albedo = vec3(albedo_sum_[s] / member_count_[s]);
}

std::vector<rays::SurfacePoint> SurfelSet::spread_members(int surfel, int count) const {
  // Farthest-point order: begin at the representative, then always take the one farthest from all taken.
  const std::vector<rays::SurfacePoint>& all = members_[static_cast<std::size_t>(surfel)];
  std::vector<float> distance2(all.size(), std::numeric_limits<float>::infinity());
  std::vector<rays::SurfacePoint> chosen;
  for (std::size_t next = 0; static_cast<int>(chosen.size()) < count;) {
    chosen.push_back(all[next]);
    float farthest = 0;
    const vec3 last = all[next].position;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const vec3 d = all[i].position - last;
      distance2[i] = std::min(distance2[i], glm::dot(d, d));
      if (distance2[i] > farthest) farthest = distance2[i], next = i;
    }
    if (!(farthest > 0)) break;
  }
  return chosen;
}

}  // namespace ssphh::transport
