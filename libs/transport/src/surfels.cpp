#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/transport/surfels.h>

namespace ssphh::transport {
namespace {

constexpr int axis_bits = 17;
/// Along an axis; those near lamps are down to a quarter as large.
constexpr float most_voxels = (1 << (axis_bits - 2)) - 8;
constexpr std::size_t max_members = 48;

/// What counts as one flat sheet: members' distances from the representative's plane, of the voxel's edge,
/// and the cosines of their normals with its.
constexpr float most_unevenness = 0.01f, least_flatness = 0.99f;
/// Of the voxel's edge: what is closer before a sheet hides it.
constexpr float hidden_below = 0.1f;
/// Rays for each place wanted: some miss a surfel that has little of its voxel.
constexpr int looks_per_place = 4;
/// Fewer than these are no spread.
constexpr std::size_t least_places = 3;

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

SurfelSet::SurfelSet(const rays::TransportSource& source, SurfelSizes sizes, std::vector<int> part_levels)
    : source_(&source), sizes_(std::move(sizes)), part_levels_(std::move(part_levels)) {
  const float size = sizes_.usual();
  if (!(size > 0) || !std::isfinite(size))
    throw Error("surfel size", fmt::format("{} m is no size", size), "give a positive number of metres");
  part_levels_.resize(static_cast<std::size_t>(source.part_count()), 0);
  for (int part = 0; part < source.part_count(); ++part) {
    const scene::Bounds bounds = source.part_bounds(part);
    // A quarter of a voxel off, or walls at the bounds would lie on the border of two voxels and rounding
    // would make two surfels of each.
    origin_.push_back(bounds.empty() ? vec3(0) : bounds.min);
    if (bounds.empty()) continue;
    const float extent = max_component(bounds.max - bounds.min);
    if (extent / size > most_voxels) {
      throw Error("surfel size", fmt::format("{} m divides a scene of {} m too finely", size, extent),
                  fmt::format("at least {:.3g} m", extent / 32000));
    }
  }
}

int SurfelSet::level(int part, const vec3& position) const {
  return part == 0 ? sizes_.level(position) : part_levels_[part];
}

float SurfelSet::coarsest() const {
  int level = SurfelSizes::most_level;
  while (level > 0 && !has_level_[level]) --level;
  return size(level);
}

SurfelSet::Voxel SurfelSet::voxel(int part, int level, const vec3& position) const {
  const float size = sizes_.size(level);
  const vec3 origin = origin_[part] - 2.25f * size;
  const vec3 v = glm::floor((position - origin) / size);
  const vec3 c = glm::clamp(v, 1.0f, static_cast<float>((1 << axis_bits) - 2));
  return {level, static_cast<int>(c.x), static_cast<int>(c.y), static_cast<int>(c.z)};
}

SurfelSet::Key SurfelSet::key(int part, const Voxel& v, int bin) {
  std::uint64_t k = 0;
  for (const int c : {v.x, v.y, v.z}) k = k << axis_bits | static_cast<std::uint64_t>(c);
  return {static_cast<std::uint32_t>(part) << 8 | static_cast<std::uint32_t>(v.level),
          k << 3 | static_cast<std::uint64_t>(bin)};
}

SurfelSet::Key SurfelSet::key(int part, const rays::SurfacePoint& point) const {
  return key(part, voxel(part, level(part, point.position), point.position), direction_bin(point.normal));
}

std::size_t SurfelSet::KeyHash::operator()(const Key& key) const {
  return static_cast<std::size_t>(hash_combine(key.part_and_level, key.place_and_bin));
}

const std::vector<int>* SurfelSet::find_cell(const Key& key) const {
  const auto found = cells_.find(key);
  return found == cells_.end() ? nullptr : &found->second;
}

float SurfelSet::height(int part, const rays::SurfacePoint& point) const {
  const float most = lift(level(part, point.position)), begin = link_lift * size();
  const rays::RayQuery up{point.position + begin * point.normal, point.normal, 2 * most};
  rays::RayHit hit;
  source_->intersect(part, {&up, 1}, {&hit, 1});
  return std::min(most, 0.5f * (begin + hit.distance));
}

rays::RayQuery SurfelSet::segment(const rays::SurfacePoint& a, float height_a, const rays::SurfacePoint& b,
                                  float height_b) {
  const vec3 from = a.position + height_a * a.normal, to = b.position + height_b * b.normal;
  return {from, to - from, 1};
}

std::span<const int> SurfelSet::cell(int part, const rays::SurfacePoint& point) const {
  const std::vector<int>* found = find_cell(key(part, point));
  return found ? std::span<const int>(*found) : std::span<const int>();
}

std::span<const int> SurfelSet::candidates(int part, const rays::SurfacePoint& point,
                                           std::span<int> out) const {
  const auto nearer = [&](int a, int b) {
    const auto distance2 = [&](int s) {
      const vec3 d = surfels_[s].point.position - point.position;
      return glm::dot(d, d);
    };
    return std::pair(distance2(a), a) < std::pair(distance2(b), b);
  };
  std::size_t count = 0;
  // Into its place among those from `first` on; the farthest falls off the end.
  const auto add = [&](std::size_t first, const std::vector<int>& cell) {
    for (const int s : cell) {
      std::size_t at = count;
      while (at > first && nearer(s, out[at - 1])) --at;
      if (at == out.size()) continue;
      count = std::min(count + 1, out.size());
      for (std::size_t i = count - 1; i > at; --i) out[i] = out[i - 1];
      out[at] = s;
    }
  };
  const int own_level = level(part, point.position), bin = direction_bin(point.normal);
  const Key own_key = key(part, point);
  if (const std::vector<int>* own = find_cell(own_key)) add(0, *own);
  const std::size_t around = count;
  for (int l = std::max(own_level - 1, 0); l <= std::min(own_level + 1, SurfelSizes::most_level); ++l) {
    if (l != own_level && !has_level_[l]) continue;
    const Voxel centre = voxel(part, l, point.position);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Key k = key(part, {l, centre.x + x, centre.y + y, centre.z + z}, bin);
          if (const std::vector<int>* found = k == own_key ? nullptr : find_cell(k)) add(around, *found);
        }
      }
    }
  }
  return out.first(count);
}

std::vector<int> SurfelSet::add(int part, std::span<const ClusterPoint> points) {
  // Bring the points of each cell together, in their order.
  std::vector<std::pair<Key, std::size_t>> order(points.size());
  std::vector<float> heights(points.size());
  parallel_for(points.size(), 1024, [&](std::size_t i) {
    order[i] = {key(part, points[i].point), i};
    heights[i] = height(part, points[i].point);
  });
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
      const auto height_of = [&](std::size_t local) { return heights[order[first + local].second]; };
      left.clear();
      for (std::size_t i = 0; i < size; ++i) left.push_back(i);
      const auto claim = [&](const rays::SurfacePoint& representative, float above, int owner) {
        segments.clear();
        for (const std::size_t i : left)
          segments.push_back(segment(representative, above, point(i), height_of(i)));
        blocked.resize(segments.size());
        source_->occluded(part, segments, blocked);
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
          claim(surfels_[s].point, surfels_[s].height, owner++);
        }
        owner = static_cast<int>(known->second.size());
      }
      while (!left.empty()) {
        const std::size_t founder = left.front();
        result.founders.push_back(order[first + founder].second);
        result.owner[founder] = owner;
        left.erase(left.begin());
        claim(point(founder), height_of(founder), owner++);
      }
    }
  });

  // Number the new surfels by cell and book the members.
  std::vector<int> surfel_of(points.size(), no_surfel);
  for (std::size_t c = 0; c < cell_count; ++c) {
    const Key& cell = order[runs[c]].first;
    std::vector<int>& list = cells_[cell];
    has_level_[level_of(cell)] = true;
    for (const std::size_t founder : results[c].founders) {
      list.push_back(static_cast<int>(surfels_.size()));
      surfels_.push_back({points[founder].point, vec3(0), part, level_of(cell), heights[founder]});
      albedo_sum_.emplace_back(0);
      member_count_.push_back(0);
      members_.emplace_back();
    }
    for (std::size_t i = 0; i < results[c].owner.size(); ++i) {
      const std::size_t point = order[runs[c] + i].second;
      const int s = list[results[c].owner[i]];
      surfel_of[point] = s;
      const auto index = static_cast<std::size_t>(s);
      albedo_sum_[index] += glm::dvec3(points[point].albedo);
      member_count_[index] += 1;
      if (members_[index].size() < max_members) members_[index].push_back(points[point]);
    }
  }
  return surfel_of;
}

void SurfelSet::update_albedo() {
  for (std::size_t s = 0; s < surfels_.size(); ++s)
    surfels_[s].albedo = vec3(albedo_sum_[s] / member_count_[s]);
}

namespace {

/// The place of a point of [0, 1]³ along a curve that fills it (Morton's): points that follow each other lie
/// together.
std::uint32_t place_along_curve(const vec3& u) {
  constexpr int bits = 10;
  const uvec3 at(u * static_cast<float>((1 << bits) - 1));
  std::uint32_t place = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    for (int axis = 0; axis < 3; ++axis) place = place << 1 | (at[axis] >> bit & 1);
  }
  return place;
}

}  // namespace

std::vector<ClusterPoint> SurfelSet::spread_members(int surfel, int count) const {
  const std::vector<ClusterPoint>& all = members_[surfel];
  scene::Bounds bounds;
  for (const ClusterPoint& member : all) bounds.add(member.point.position);
  const float size = std::max(max_component(bounds.max - bounds.min), std::numeric_limits<float>::min());
  std::vector<std::pair<std::uint32_t, std::size_t>> order;
  for (std::size_t i = 0; i < all.size(); ++i)
    order.emplace_back(place_along_curve((all[i].point.position - bounds.min) / size), i);
  std::ranges::sort(order);
  const std::size_t wanted = std::min(order.size(), static_cast<std::size_t>(count));
  std::vector<ClusterPoint> chosen;
  for (std::size_t k = 0; k < wanted; ++k) {
    const ClusterPoint& middle = all[order[(2 * k + 1) * order.size() / (2 * wanted)].second];
    const bool known = std::ranges::any_of(
        chosen, [&](const ClusterPoint& c) { return c.point.position == middle.point.position; });
    if (!known) chosen.push_back(middle);
  }
  return chosen;
}

bool SurfelSet::is_flat(int index) const {
  const Surfel& surfel = surfels_[index];
  const float most = most_unevenness * size(surfel.level);
  return std::ranges::all_of(members_[index], [&](const ClusterPoint& member) {
    const vec3& normal = surfel.point.normal;
    return glm::dot(member.point.normal, normal) > least_flatness &&
           std::abs(glm::dot(member.point.position - surfel.point.position, normal)) < most;
  });
}

int SurfelSet::owner(const rays::SurfacePoint& point, float above, const Key& cell) const {
  for (const int s : *find_cell(cell)) {
    const rays::RayQuery way = segment(surfels_[s].point, surfels_[s].height, point, above);
    std::uint8_t blocked = 0;
    source_->occluded(surfels_[s].part, {&way, 1}, {&blocked, 1});
    if (!blocked) return s;
  }
  return no_surfel;
}

std::vector<ClusterPoint> SurfelSet::spread_places(int index, int count) const {
  const Surfel& surfel = surfels_[index];
  const Key own = key(surfel.part, surfel.point);
  const Voxel v = voxel(surfel.part, surfel.level, surfel.point.position);
  const float edge = sizes_.size(surfel.level), above = hidden_below * edge;
  const vec3 low = origin_[surfel.part] - 2.25f * edge +
                   edge * vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  const vec3 normal = surfel.point.normal;
  const int axis = direction_bin(normal) / 2, across = (axis + 1) % 3, along = (axis + 2) % 3;
  vec3 down(0);
  down[axis] = normal[axis] < 0 ? 1.0f : -1.0f;
  const std::uint64_t h = mix64(static_cast<std::uint64_t>(index));
  std::vector<ClusterPoint> places;
  for (int i = 1; i <= looks_per_place * count && static_cast<int>(places.size()) < count; ++i) {
    const double a = 0.7548776662466927 * i + static_cast<double>(h >> 32) * 0x1p-32;
    const double b = 0.5698402909980532 * i + static_cast<double>(h & 0xffffffffu) * 0x1p-32;
    vec3 on_plane = low;
    on_plane[across] += edge * static_cast<float>(a - std::floor(a));
    on_plane[along] += edge * static_cast<float>(b - std::floor(b));
    const vec3 apart = on_plane - surfel.point.position;
    on_plane[axis] = surfel.point.position[axis] -
                     (apart[across] * normal[across] + apart[along] * normal[along]) / normal[axis];
    const rays::RayQuery ray{on_plane - above * down, down, 2 * above};
    rays::RayHit hit;
    source_->intersect(surfel.part, {&ray, 1}, {&hit, 1});
    if (hit.escaped() || hit.back || hit.distance > ray.t_max) continue;
    const rays::SurfacePoint place{ray.origin + (1 - 2e-5f) * hit.distance * down, hit.normal};
    if (key(surfel.part, place) != own) continue;
    if (owner(place, height(surfel.part, place), own) == index) places.push_back({place, hit.albedo});
  }
  return places;
}

std::vector<ClusterPoint> SurfelSet::spread_samples(int index, int count) const {
  const auto wanted = static_cast<std::size_t>(count), least = std::min(least_places, wanted);
  std::vector<ClusterPoint> chosen;
  // Points found on a moving part are spread over its area already
  if (surfels_[index].part == 0 && is_flat(index)) chosen = spread_places(index, count);
  if (chosen.size() >= least) return chosen;
  for (const ClusterPoint& member : spread_members(index, count)) {
    if (chosen.size() < wanted) chosen.push_back(member);
  }
  return chosen;
}

}  // namespace ssphh::transport
