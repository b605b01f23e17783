#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/shading/mesh_view.h>

namespace ssphh::shading {
namespace {

using glm::dvec3;

/// Irradiance / radiance of a spherical triangle with unit corners, on a plane below it.
double form_factor(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& normal) {
  const auto edge = [&](const dvec3& p, const dvec3& q) {
    const dvec3 n = glm::cross(p, q);
    const double sine = glm::length(n);
    return sine > 0 ? std::atan2(sine, glm::dot(p, q)) * glm::dot(n, normal) / sine : 0.0;
  };
  return std::abs(edge(a, b) + edge(b, c) + edge(c, a)) / 2;
}

/// Van Oosterom & Strackee, The Solid Angle of a Plane Triangle, 1983.
double solid_angle(const dvec3& a, const dvec3& b, const dvec3& c) {
  return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
                        1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

/// Part of v across the unit vector a, as a unit vector.
dvec3 across(const dvec3& v, const dvec3& a) {
  return glm::normalize(v - glm::dot(v, a) * a);
}

/// Uniform on the spherical triangle of solid angle `area` (Arvo 1995).
dvec3 sample_spherical_triangle(const dvec3& a, const dvec3& b, const dvec3& c, double area, const vec2& u) {
  // Angle at a between the arcs to b and to c
  const double cos_a = glm::clamp(glm::dot(across(b, a), across(c, a)), -1.0, 1.0);
  const double sin_a = std::sqrt(1 - cos_a * cos_a), angle_a = std::acos(cos_a);
  const double part = area * static_cast<double>(u.x);
  const double s = std::sin(part - angle_a), t = std::cos(part - angle_a);
  const double p = t - cos_a, r = s + sin_a * glm::dot(a, b);
  const double denominator = (r * s + p * t) * sin_a;
  const double q =
      denominator != 0 ? glm::clamp(((r * t - p * s) * cos_a - r) / denominator, -1.0, 1.0) : 1.0;
  // The corner that cuts off the part of the area, then a place on the arc from b to it
  const dvec3 corner = q * a + std::sqrt(1 - q * q) * across(c, a);
  const double z = 1 - static_cast<double>(u.y) * (1 - glm::dot(corner, b));
  const dvec3 side = corner - glm::dot(corner, b) * b;
  const double length = glm::length(side);
  return length > 0 ? z * b + std::sqrt(std::max(1 - z * z, 0.0)) / length * side : b;
}

/// Below this solid angle the spherical triangle is flat to rounding, and its own sampling loses digits.
constexpr double flat = 1e-7;

}  // namespace

void MeshView::add(const vec3& p0, const vec3& p1, const vec3& p2) {
  require(count_ + 2 <= pieces_.size(), "emissive mesh", "it has too many triangles for a closed form");
  const dvec3 corners[3] = {dvec3(p0) - position_, dvec3(p1) - position_, dvec3(p2) - position_};
  dvec3 clipped[4];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const dvec3 &from = corners[i], &to = corners[(i + 1) % 3];
    const double height = glm::dot(from, normal_), next = glm::dot(to, normal_);
    if (height > 0) clipped[count++] = from;
    if ((height > 0) != (next > 0)) clipped[count++] = from + height / (height - next) * (to - from);
  }
  for (int i = 2; i < count; ++i) add_piece(clipped[0], clipped[i - 1], clipped[i]);
}

void MeshView::add_piece(const dvec3& a, const dvec3& b, const dvec3& c) {
  const double e = form_factor(glm::normalize(a), glm::normalize(b), glm::normalize(c), normal_);
  if (e > 0 && std::isfinite(e)) {
    const double sum = total() + e;
    pieces_[count_++] = {a, b, c, sum};
  }
}

std::optional<LightSample> MeshView::sample(const vec2& u) const {
  if (count_ == 0) return std::nullopt;
  // Choose a piece
  const double target = static_cast<double>(u.x) * total();
  std::size_t i = 0;
  while (i + 1 < count_ && pieces_[i].sum <= target) ++i;
  const Piece& piece = pieces_[i];
  const double below = i > 0 ? pieces_[i - 1].sum : 0, share = piece.sum - below;
  const vec2 place(glm::clamp(static_cast<float>((target - below) / share), 0.0f, 1.0f), u.y);

  // A direction to it
  const dvec3 a = glm::normalize(piece.a), b = glm::normalize(piece.b), c = glm::normalize(piece.c);
  const double area = solid_angle(a, b, c);
  if (!(area > 0)) return std::nullopt;
  dvec3 wi;
  if (area > flat) {
    wi = glm::normalize(sample_spherical_triangle(a, b, c, area, place));
  } else {
    const double s = std::sqrt(static_cast<double>(place.x)), v = static_cast<double>(place.y);
    wi = glm::normalize((1 - s) * a + s * (1 - v) * b + s * v * c);
  }
  const dvec3 plane = glm::cross(piece.b - piece.a, piece.c - piece.a);
  const double distance = glm::dot(piece.a, plane) / glm::dot(wi, plane);
  if (!(distance > 0 && std::isfinite(distance))) return std::nullopt;
  return LightSample{vec3(wi),  static_cast<float>(distance),
                     radiance_, static_cast<float>(share / (total() * area)),
                     false,     group_};
}

}  // namespace ssphh::shading
