#include <cmath>
#include <vector>

#include <ssphh/core/require.h>
#include <ssphh/scene/primitives.h>

namespace ssphh::scene {
namespace {

struct TubeFrame {
  vec3 position, tangent, side;  // side ⟂ tangent
};

/// Frames that do not twist, by double reflection; on a closed curve the angle left at the end is spread
/// evenly.
std::vector<TubeFrame> tube_frames(const std::function<vec3(float)>& curve, bool closed, int segments) {
  const auto at = [&](int i) {
    if (closed) i = (i % segments + segments) % segments;
    return curve(static_cast<float>(i) / static_cast<float>(segments));
  };
  std::vector<TubeFrame> frames(static_cast<std::size_t>(segments) + 1);
  for (int i = 0; i <= segments; ++i) {
    TubeFrame& f = frames[i];
    f.position = at(i);
    const vec3 before = closed || i > 0 ? at(i - 1) : f.position;
    const vec3 after = closed || i < segments ? at(i + 1) : f.position;
    f.tangent = glm::normalize(after - before);
  }
  frames[0].side = Frame::around(frames[0].tangent).x;
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    const TubeFrame& f = frames[i];
    TubeFrame& next = frames[i + 1];
    const vec3 v1 = next.position - f.position;
    const float c1 = glm::dot(v1, v1);
    const vec3 side = f.side - (2 / c1) * glm::dot(v1, f.side) * v1;
    const vec3 tangent = f.tangent - (2 / c1) * glm::dot(v1, f.tangent) * v1;
    const vec3 v2 = next.tangent - tangent;
    const float c2 = glm::dot(v2, v2);
    next.side = c2 > 0 ? side - (2 / c2) * glm::dot(v2, side) * v2 : side;
    next.side = glm::normalize(next.side - glm::dot(next.side, next.tangent) * next.tangent);
  }
  if (!closed) return frames;
  const TubeFrame& last = frames.back();
  const vec3 up = glm::cross(last.tangent, last.side);
  const float twist = std::atan2(glm::dot(frames[0].side, up), glm::dot(frames[0].side, last.side));
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const float angle = twist * static_cast<float>(i) / static_cast<float>(segments);
    TubeFrame& f = frames[i];
    f.side = std::cos(angle) * f.side + std::sin(angle) * glm::cross(f.tangent, f.side);
  }
  frames.back() = frames.front();
  return frames;
}

/// Flat end, front toward `normal`, over the ring that begins at vertex `first`.
void add_cap(Mesh& mesh, std::uint32_t first, int sides, const vec3& center, const vec3& normal,
             bool reversed) {
  const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(center);
  mesh.normals.push_back(normal);
  mesh.uvs[0].emplace_back(0.5f, 0.5f);
  for (int s = 0; s <= sides; ++s) {
    mesh.positions.push_back(mesh.positions[first + static_cast<std::uint32_t>(s)]);
    mesh.normals.push_back(normal);
    const float angle = 2 * pi * static_cast<float>(s) / static_cast<float>(sides);
    mesh.uvs[0].emplace_back(0.5f + 0.5f * std::cos(angle), 0.5f + 0.5f * std::sin(angle));
  }
  for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(sides); ++s) {
    const std::uint32_t a = middle + 1 + s, b = a + 1;
    mesh.triangles.emplace_back(middle, reversed ? b : a, reversed ? a : b);
  }
}

}  // namespace

Mesh make_tube(const std::function<vec3(float)>& curve, bool closed, float radius, int segments, int sides) {
  require(segments >= 3 && sides >= 3, "tube", "it needs at least 3 segments and 3 sides");
  require(curve != nullptr, "tube", "it has no curve");
  const std::vector<TubeFrame> frames = tube_frames(curve, closed, segments);
  Mesh mesh;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const TubeFrame& f = frames[i];
    const vec3 up = glm::cross(f.tangent, f.side);
    for (int s = 0; s <= sides; ++s) {
      const double angle = 2 * pi_d * (s % sides) / sides;
      const vec3 n = static_cast<float>(std::cos(angle)) * f.side + static_cast<float>(std::sin(angle)) * up;
      mesh.positions.push_back(f.position + radius * n);
      mesh.normals.push_back(glm::normalize(n));
      mesh.uvs[0].emplace_back(static_cast<float>(i) / static_cast<float>(segments),
                               static_cast<float>(s) / static_cast<float>(sides));
    }
  }
  const auto stride = static_cast<std::uint32_t>(sides) + 1;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segments); ++i) {
    for (std::uint32_t s = 0; s + 1 < stride; ++s) {
      const std::uint32_t a = i * stride + s, b = a + stride;
      mesh.triangles.emplace_back(a, a + 1, b + 1);
      mesh.triangles.emplace_back(a, b + 1, b);
    }
  }
  if (!closed) {
    add_cap(mesh, 0, sides, frames.front().position, -frames.front().tangent, true);
    add_cap(mesh, static_cast<std::uint32_t>(segments) * stride, sides, frames.back().position,
            frames.back().tangent, false);
  }
  return mesh;
}

Mesh make_torus_knot(int p, int q, float major_radius, float minor_radius, float tube_radius, int segments,
                     int sides) {
  const auto curve = [=](float t) {
    const double a = 2 * pi_d * p * static_cast<double>(t), b = 2 * pi_d * q * static_cast<double>(t);
    const double across = major_radius + minor_radius * std::cos(b);
    return vec3(across * std::cos(a), minor_radius * std::sin(b), -across * std::sin(a));
  };
  return make_tube(curve, true, tube_radius, segments, sides);
}

Mesh make_spiral(float radius_bottom, float radius_top, float height, float turns, float tube_radius,
                 int segments, int sides) {
  const auto curve = [=](float t) {
    const float across = radius_bottom + t * (radius_top - radius_bottom), angle = 2 * pi * turns * t;
    return vec3(across * std::cos(angle), t * height, -across * std::sin(angle));
  };
  return make_tube(curve, false, tube_radius, segments, sides);
}

}  // namespace ssphh::scene
