#include "triangulate.h"

#include <numeric>

namespace ssphh::scene_io {
namespace {

struct Point {
  double x, y;
};

double cross(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Projects onto the coordinate plane that the polygon faces most, so that its corners run counter-clockwise.
std::vector<Point> project(std::span<const vec3> polygon) {
  glm::dvec3 normal(0);  // Newell's method
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a(polygon[i]), b(polygon[(i + 1) % polygon.size()]);
    normal += glm::dvec3((a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y));
  }
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Point> points;
  points.reserve(polygon.size());
  for (const vec3& p : polygon) {
    points.push_back({sign * double{p[(axis + 1) % 3]}, double{p[(axis + 2) % 3]}});
  }
  return points;
}

// Whether some other corner lies in the triangle (a, b, c) of the remaining corners.
bool blocked(const std::vector<Point>& points, const std::vector<std::uint32_t>& corners, std::size_t a,
             std::size_t b, std::size_t c) {
  const Point &pa = points[corners[a]], &pb = points[corners[b]], &pc = points[corners[c]];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == a || i == b || i == c) continue;
    const Point& p = points[corners[i]];
    const bool is_corner =
        (p.x == pa.x && p.y == pa.y) || (p.x == pb.x && p.y == pb.y) || (p.x == pc.x && p.y == pc.y);
    if (!is_corner && cross(pa, pb, p) >= 0 && cross(pb, pc, p) >= 0 && cross(pc, pa, p) >= 0) return true;
  }
  return false;
}

}  // namespace

void triangulate(std::span<const vec3> polygon, std::uint64_t& work, std::vector<uvec3>& out) {
  std::vector<std::uint32_t> corners(polygon.size());
  std::iota(corners.begin(), corners.end(), 0u);
  const auto fan = [&] {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      out.emplace_back(corners[0], corners[i], corners[i + 1]);
  };
  if (polygon.size() == 3) return fan();

  const std::vector<Point> points = project(polygon);
  bool convex = true;
  for (std::size_t i = 0; i < points.size() && convex; ++i) {
    convex = cross(points[i], points[(i + 1) % points.size()], points[(i + 2) % points.size()]) >= 0;
  }
  if (convex) return fan();

  // Clip ears, going round from the last one
  std::size_t tried = 0, i = 0;
  while (corners.size() > 3 && tried < corners.size() && work >= corners.size()) {
    const std::size_t n = corners.size(), a = i % n, b = (i + 1) % n, c = (i + 2) % n;
    work -= n;
    if (cross(points[corners[a]], points[corners[b]], points[corners[c]]) > 0 &&
        !blocked(points, corners, a, b, c)) {
      out.emplace_back(corners[a], corners[b], corners[c]);
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(b));
      tried = 0;
    } else {
      i = b;
      ++tried;
    }
  }
  fan();
}

}  // namespace ssphh::scene_io
