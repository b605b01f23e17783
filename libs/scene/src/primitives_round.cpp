#include <cmath>
#include <vector>

#include <ssphh/core/require.h>
#include <ssphh/scene/primitives.h>

namespace ssphh::scene {
namespace {

/// Unit circle in n steps: (cos, sin) of 2πi/n, with point n exactly equal to point 0.
vec2 circle(int i, int n) {
  const double angle = 2 * pi_d * (i % n) / n;
  return {std::cos(angle), std::sin(angle)};
}

/// Triangles of a grid of (columns + 1) × (rows + 1) vertices, rows upward, columns counter-clockwise about
/// the outward side's left: vertex (c, r) has index first + r · (columns + 1) + c. Rows that shrink to a
/// point lose the triangles without area.
void add_grid(Mesh& mesh, std::size_t first, int columns, int rows, bool point_below, bool point_above) {
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto a = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(r * (columns + 1) + c);
      const auto above = a + static_cast<std::uint32_t>(columns + 1);
      if (!(point_below && r == 0)) mesh.triangles.emplace_back(a, a + 1, above + 1);
      if (!(point_above && r == rows - 1)) mesh.triangles.emplace_back(a, above + 1, above);
    }
  }
}

/// A strip of revolution between two profile points with the normals (radial, y) at its ends.
void add_band(Mesh& mesh, const vec2& low, const vec2& high, const vec2& normal_low, const vec2& normal_high,
              float v_low, float v_high, int segments) {
  const std::size_t first = mesh.positions.size();
  for (int r = 0; r < 2; ++r) {
    const vec2 p = r == 0 ? low : high, n = r == 0 ? normal_low : normal_high;
    for (int c = 0; c <= segments; ++c) {
      const vec2 direction = circle(c, segments);
      mesh.positions.emplace_back(p.x * direction.x, p.y, -p.x * direction.y);
      mesh.normals.push_back(glm::normalize(vec3(n.x * direction.x, n.y, -n.x * direction.y)));
      mesh.uvs[0].emplace_back(static_cast<float>(c) / static_cast<float>(segments), r == 0 ? v_low : v_high);
    }
  }
  add_grid(mesh, first, segments, 1, low.x == 0, high.x == 0);
}

}  // namespace

Mesh make_sphere(float radius, int segments, int rings) {
  require(segments >= 3 && rings >= 2, "sphere", "it needs at least 3 segments and 2 rings");
  Mesh mesh;
  for (int r = 0; r <= rings; ++r) {
    const double polar = pi_d * r / rings;  // from the south pole
    const bool pole = r == 0 || r == rings;
    const auto across = pole ? 0.0f : static_cast<float>(std::sin(polar));
    const auto y = static_cast<float>(-std::cos(polar));
    for (int c = 0; c <= segments; ++c) {
      const vec2 direction = circle(c, segments);
      const vec3 n(across * direction.x, y, -across * direction.y);
      mesh.positions.push_back(radius * n);
      mesh.normals.push_back(glm::normalize(n));
      mesh.uvs[0].emplace_back(static_cast<float>(c) / static_cast<float>(segments),
                               1 - static_cast<float>(r) / static_cast<float>(rings));
    }
  }
  add_grid(mesh, 0, segments, rings, true, true);
  return mesh;
}

Mesh make_torus(float major_radius, float minor_radius, int segments, int sides) {
  require(segments >= 3 && sides >= 3, "torus", "it needs at least 3 segments and 3 sides");
  Mesh mesh;
  for (int s = 0; s <= sides; ++s) {
    const vec2 section = circle(s, sides);
    for (int c = 0; c <= segments; ++c) {
      const vec2 direction = circle(c, segments);
      const float across = major_radius + minor_radius * section.x;
      mesh.positions.emplace_back(across * direction.x, minor_radius * section.y, -across * direction.y);
      mesh.normals.push_back(
          glm::normalize(vec3(section.x * direction.x, section.y, -section.x * direction.y)));
      mesh.uvs[0].emplace_back(static_cast<float>(c) / static_cast<float>(segments),
                               1 - static_cast<float>(s) / static_cast<float>(sides));
    }
  }
  add_grid(mesh, 0, segments, sides, false, false);
  return mesh;
}

Mesh make_lathe(std::span<const vec2> profile, int segments) {
  require(profile.size() >= 3 && segments >= 3, "lathe", "it needs at least 3 points and 3 segments");
  require(profile.front().x == 0 && profile.back().x == 0, "lathe",
          "its profile must begin and end at radius 0");
  // Outward normal of each piece of the profile.
  std::vector<vec2> normals;
  std::vector<float> lengths{0};
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const vec2 d = profile[i + 1] - profile[i];
    require(glm::length(d) > 0, "lathe", "two points of its profile are one");
    normals.push_back(glm::normalize(vec2(d.y, -d.x)));
    lengths.push_back(lengths.back() + glm::length(d));
  }
  const float smooth = std::cos(pi / 6);
  const auto joint = [&](std::size_t piece, std::size_t neighbor) {
    if (neighbor >= normals.size() || glm::dot(normals[piece], normals[neighbor]) < smooth)
      return normals[piece];
    return glm::normalize(normals[piece] + normals[neighbor]);
  };
  Mesh mesh;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float total = lengths.back();
    add_band(mesh, profile[i], profile[i + 1], joint(i, i - 1), joint(i, i + 1), 1 - lengths[i] / total,
             1 - lengths[i + 1] / total, segments);
  }
  return mesh;
}

Mesh make_cylinder(float radius, float height, int segments) {
  return make_lathe(std::vector<vec2>{{0, 0}, {radius, 0}, {radius, height}, {0, height}}, segments);
}

Mesh make_cone(float radius, float height, int segments) {
  return make_lathe(std::vector<vec2>{{0, 0}, {radius, 0}, {0, height}}, segments);
}

Mesh make_column(float radius, float height, int segments) {
  const float r = radius, h = height;
  std::vector<vec2> profile{{0, 0}, {1.4f * r, 0}, {1.4f * r, 0.2f * r}};
  // Base: a half round (torus) from the plinth to the shaft.
  for (int i = 0; i <= 8; ++i) {
    const float angle = -pi / 2 + pi * static_cast<float>(i) / 8;
    profile.emplace_back(1.1f * r + 0.2f * r * std::cos(angle), 0.4f * r + 0.2f * r * std::sin(angle));
  }
  // Shaft with entasis: full below, 5/6 at the top.
  for (int i = 0; i <= 12; ++i) {
    const float s = static_cast<float>(i) / 12;
    profile.emplace_back(r * (1 - s * s / 6), 0.6f * r + s * (h - 1.5f * r));
  }
  // Capital: a quarter round under a slab.
  for (int i = 1; i <= 6; ++i) {
    const float angle = pi / 2 * static_cast<float>(i) / 6;
    profile.emplace_back(r * (5.0f / 6 + 0.45f * (1 - std::cos(angle))),
                         h - 0.9f * r + 0.5f * r * std::sin(angle));
  }
  profile.emplace_back(1.4f * r, h - 0.4f * r);
  profile.emplace_back(1.4f * r, h);
  profile.emplace_back(0.0f, h);
  return make_lathe(profile, segments);
}

}  // namespace ssphh::scene
