#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include <ssphh/core/error.h>
#include <ssphh/geometry/tetrahedra.h>

namespace ssphh::geometry {
namespace {

constexpr double lattice_places = 1 << 19;
/// Share of the extent below which points count as flat, and of a tetrahedron's longest edge.
constexpr double flatness = 1e-3;

double volume6(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return glm::dot(b - a, glm::cross(c - a, d - a));
}

}  // namespace

Tetrahedra::Tetrahedra(std::span<const vec3> points) {
  if (points.empty()) throw Error("light probes", "there are none to interpolate between");
  make_frame(points);
  std::map<std::tuple<int, int, int>, std::int32_t> seen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LatticePoint at(glm::round(place_of(points[i])));
    if (!seen.try_emplace({at.x, at.y, at.z}, static_cast<std::int32_t>(i)).second) continue;
    points_.push_back(at);
    index_.push_back(static_cast<std::int32_t>(i));
  }
  if (dimension_ == 3) build_volume();
  if (dimension_ == 2) build_plane();
  if (dimension_ <= 1) build_line();
}

/// Lattice axes are the world's, unless the points are flat: then the first ones span them.
void Tetrahedra::make_frame(std::span<const vec3> points) {
  scene::Bounds box;
  for (const vec3& p : points) box.add(p);
  origin_ = box.center();
  const vec3 size = box.max - box.min;
  const double extent = static_cast<double>(max_component(size));
  if (!(extent > 0)) {
    dimension_ = 0;
    frame_ = glm::dmat3(0);
    return;
  }
  // Greedily: the farthest point from the first, from the line through both, from the plane of the three.
  const glm::dvec3 first(points[0]);
  const auto farthest = [&](const auto& distance) {
    double most = -1;
    glm::dvec3 at(0);
    for (const vec3& p : points) {
      const glm::dvec3 offset = glm::dvec3(p) - first;
      if (const double d = distance(offset); d > most) most = d, at = offset;
    }
    return std::pair(at, most);
  };
  const glm::dvec3 x = glm::normalize(farthest([](const glm::dvec3& v) { return glm::length(v); }).first);
  const auto off_line = [&](const glm::dvec3& v) { return v - glm::dot(v, x) * x; };
  const auto [aside, width] = farthest([&](const glm::dvec3& v) { return glm::length(off_line(v)); });
  const glm::dvec3 y =
      width > flatness * extent
          ? glm::normalize(off_line(aside))
          : glm::normalize(glm::cross(x, std::abs(x.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 z = glm::cross(x, y);
  const double height = farthest([&](const glm::dvec3& v) { return std::abs(glm::dot(v, z)); }).second;
  const double scale = lattice_places / extent;
  dimension_ = width <= flatness * extent ? 1 : height <= flatness * extent ? 2 : 3;
  if (dimension_ == 3) {
    frame_ = glm::dmat3(scale);
    return;
  }
  // Rows: a flat direction becomes 0. The turned box may be longer than the world's by a factor of √3.
  const glm::dvec3 zero(0);
  origin_ = first + x * glm::dot(origin_ - first, x) + y * glm::dot(origin_ - first, y);
  frame_ = glm::transpose(glm::dmat3(scale * x, dimension_ == 2 ? scale * y : zero, zero));
}

Tetrahedra::Place Tetrahedra::place_of(const vec3& p) const {
  return frame_ * (glm::dvec3(p) - origin_);
}

void Tetrahedra::build_volume() {
  cells_ = delaunay(points_);
  drop_flat_cells();
  std::vector<std::array<std::int32_t, 3>> faces;
  for (const Tetrahedron& cell : cells_) {
    for (std::size_t k = 0; k < 4; ++k)
      if (cell.neighbor[k] < 0)
        faces.push_back({cell.vertex[(k + 1) % 4], cell.vertex[(k + 2) % 4], cell.vertex[(k + 3) % 4]});
  }
  set_hull(faces);
  set_starts();
}

/// Rounding leaves cells of next to no height between points of the hull that were meant to lie in a plane;
/// their outer faces join points from far apart. They are peeled off, unless a point would be left out.
void Tetrahedra::drop_flat_cells() {
  std::vector<int> uses(points_.size(), 0);
  for (const Tetrahedron& cell : cells_)
    for (const std::int32_t v : cell.vertex) ++uses[v];
  const auto flat = [&](const Tetrahedron& cell) {
    std::array<glm::dvec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = points_[cell.vertex[k]];
    double longest = 0, area2 = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, glm::length(p[i] - p[j]));
      area2 = std::max(area2, glm::length(glm::cross(p[(i + 1) % 4] - p[i], p[(i + 2) % 4] - p[i])));
    }
    return volume6(p[0], p[1], p[2], p[3]) < flatness * longest * area2;
  };
  std::vector<char> gone(cells_.size(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      Tetrahedron& cell = cells_[c];
      const bool outside = std::ranges::any_of(cell.neighbor, [](std::int32_t n) { return n < 0; });
      const bool needed = std::ranges::any_of(cell.vertex, [&](std::int32_t v) { return uses[v] == 1; });
      if (gone[c] || !outside || needed || !flat(cell)) continue;
      gone[c] = 1;
      changed = true;
      for (const std::int32_t v : cell.vertex) --uses[v];
      for (const std::int32_t n : cell.neighbor) {
        if (n < 0) continue;
        for (std::int32_t& back : cells_[n].neighbor)
          if (back == static_cast<std::int32_t>(c)) back = -1;
      }
    }
  }
  std::vector<std::int32_t> index(cells_.size(), -1);
  std::vector<Tetrahedron> kept;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (gone[c]) continue;
    index[c] = static_cast<std::int32_t>(kept.size());
    kept.push_back(cells_[c]);
  }
  for (Tetrahedron& cell : kept)
    for (std::int32_t& n : cell.neighbor)
      if (n >= 0) n = index[n];
  cells_ = std::move(kept);
}

/// An apex off the plane makes its Delaunay triangles faces of a hull.
void Tetrahedra::build_plane() {
  std::vector<LatticePoint> raised = points_;
  raised.push_back({0, 0, static_cast<int>(lattice_places)});
  const auto apex = static_cast<std::int32_t>(points_.size());
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const Tetrahedron& cell : delaunay(raised)) {
    for (std::size_t k = 0; k < 4; ++k)
      if (cell.vertex[k] == apex)
        triangles.push_back({cell.vertex[(k + 1) % 4], cell.vertex[(k + 2) % 4], cell.vertex[(k + 3) % 4]});
  }
  set_hull(triangles);
}

/// Segments between neighbours, as triangles of no height.
void Tetrahedra::build_line() {
  std::vector<std::int32_t> order(points_.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::int32_t i) { return points_[i].x; });
  std::vector<std::array<std::int32_t, 3>> segments;
  if (order.size() == 1) segments.push_back({order[0], order[0], order[0]});
  for (std::size_t i = 1; i < order.size(); ++i) segments.push_back({order[i - 1], order[i], order[i]});
  set_hull(segments);
}

void Tetrahedra::set_hull(const std::vector<std::array<std::int32_t, 3>>& triangles) {
  hull_corners_ = triangles;
  std::vector<Corners> corners;
  for (const auto& triangle : triangles) {
    Corners& c = corners.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) c[k] = vec3(points_[triangle[k]]);
  }
  hull_ = TriangleTree(corners);
}

/// About one box per cell; each starts with the cell that holds its middle, or the one found before.
void Tetrahedra::set_starts() {
  glm::dvec3 low(points_[0]), high(points_[0]);
  for (const LatticePoint& p : points_)
    low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
  const glm::dvec3 size = glm::max(high - low, glm::dvec3(1));
  const double edge = std::cbrt(size.x * size.y * size.z / static_cast<double>(cells_.size()));
  constexpr double most = 64;
  start_size_ = glm::ivec3(glm::clamp(glm::ceil(size / edge), glm::dvec3(1), glm::dvec3(most)));
  start_low_ = low;
  start_step_ = size / glm::dvec3(start_size_);
  std::int32_t last = 0;
  std::array<double, 4> weight;
  for (int z = 0; z < start_size_.z; ++z) {
    for (int y = 0; y < start_size_.y; ++y) {
      for (int x = 0; x < start_size_.x; ++x) {
        const Place middle = start_low_ + start_step_ * (glm::dvec3(x, y, z) + 0.5);
        const std::int32_t found = walk(middle, last, weight);
        if (found >= 0) last = found;
        starts_.push_back(last);
      }
    }
  }
}

std::int32_t Tetrahedra::walk(const Place& p, std::int32_t from, std::array<double, 4>& weight) const {
  std::int32_t now = from;
  for (std::size_t step = 0; step <= cells_.size() && now >= 0; ++step) {
    const Tetrahedron& cell = cells_[now];
    std::array<glm::dvec3, 4> v;
    for (std::size_t k = 0; k < 4; ++k) v[k] = points_[cell.vertex[k]];
    weight = {volume6(p, v[1], v[2], v[3]), volume6(v[0], p, v[2], v[3]), volume6(v[0], v[1], p, v[3]),
              volume6(v[0], v[1], v[2], p)};
    const double sum = weight[0] + weight[1] + weight[2] + weight[3];
    const auto least = std::ranges::min_element(weight);
    if (*least >= -1e-12 * sum) {
      for (double& w : weight) w = std::max(w, 0.0) / sum;
      return now;
    }
    now = cell.neighbor[least - weight.begin()];
  }
  return -1;
}

CornerWeights Tetrahedra::on_hull(const Place& p) const {
  const TriangleTree::Found found = hull_.nearest(vec3(p));
  const auto& corners = hull_corners_[found.triangle];
  CornerWeights out;
  for (int k = 0; k < 3; ++k) {
    const float w = found.place.weight[k];
    if (w > 0) out.add(index_[corners[k]], w);
  }
  return out;
}

CornerWeights Tetrahedra::at(const vec3& p) const {
  const Place place = place_of(p);
  if (cells_.empty()) return on_hull(place);
  const glm::ivec3 box =
      glm::clamp(glm::ivec3(glm::clamp((place - start_low_) / start_step_, glm::dvec3(0), glm::dvec3(1e6))),
                 glm::ivec3(0), start_size_ - 1);
  const auto start = static_cast<std::size_t>((box.z * start_size_.y + box.y) * start_size_.x + box.x);
  std::array<double, 4> weight;
  const std::int32_t cell = walk(place, starts_[start], weight);
  if (cell < 0) return on_hull(place);
  CornerWeights out;
  for (std::size_t k = 0; k < 4; ++k) {
    if (weight[k] > 0) out.add(index_[cells_[cell].vertex[k]], static_cast<float>(weight[k]));
  }
  return out;
}

std::size_t Tetrahedra::bytes() const {
  return points_.size() * sizeof(LatticePoint) + index_.size() * sizeof(std::int32_t) +
         cells_.size() * sizeof(Tetrahedron) + hull_.bytes() +
         hull_corners_.size() * sizeof(hull_corners_[0]) + starts_.size() * sizeof(std::int32_t);
}

}  // namespace ssphh::geometry
