#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/lightmap/texels.h>

#include "fit.h"
#include "flat.h"
#include "world_mesh.h"

namespace ssphh::lightmap {
namespace {

/// How far places lie inside of a chart's border [texels].
constexpr float inset = 0.1f;

/// A point of a flat triangle by shares of its corners, and how far it is.
struct Nearest {
  vec3 share{1, 0, 0};
  float distance2 = 0;
};

vec3 shares_of(const std::array<vec2, 3>& t, const vec2& p) {
  const float all = cross(t[1] - t[0], t[2] - t[0]);
  return vec3(cross(t[1] - p, t[2] - p), cross(t[2] - p, t[0] - p), cross(t[0] - p, t[1] - p)) / all;
}

Nearest nearest(const std::array<vec2, 3>& t, const vec2& p) {
  const vec3 inside = shares_of(t, p);
  if (inside.x >= 0 && inside.y >= 0 && inside.z >= 0) return {inside / (inside.x + inside.y + inside.z), 0};
  Nearest best{{}, std::numeric_limits<float>::infinity()};
  for (int k = 0; k < 3; ++k) {
    const vec2 a = t[k], edge = t[(k + 1) % 3] - a;
    const float length2 = glm::dot(edge, edge);
    const float s = length2 > 0 ? glm::clamp(glm::dot(p - a, edge) / length2, 0.0f, 1.0f) : 0;
    const vec2 d = a + s * edge - p;
    if (!(glm::dot(d, d) < best.distance2)) continue;
    best.distance2 = glm::dot(d, d);
    best.share = vec3(0);
    best.share[k] = 1 - s, best.share[(k + 1) % 3] = s;
  }
  return best;
}

/// Off the chart's border: straight away from it or, where the face is too sharp for that, along it.
vec3 within(const Face& face, const vec3& share) {
  const std::array<vec2, 3>& at = face.at;
  const float twice_area = cross(at[1] - at[0], at[2] - at[0]);
  const vec2 from = share.x * at[0] + share.y * at[1] + share.z * at[2];
  vec3 least(0);
  vec2 p = from;
  for (int round = 0; round < 3; ++round) {  // off one side of a corner, and then off the other
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(face.open >> k & 1)) continue;
      const vec2 edge = at[(k + 1) % 3] - at[k];
      const float length = glm::length(edge), height = std::abs(twice_area) / length;
      const auto opposite = static_cast<int>((k + 2) % 3);
      least[opposite] = std::min(0.3f, inset / height);
      const vec2 inward = (twice_area > 0 ? vec2(-edge.y, edge.x) : vec2(edge.y, -edge.x)) / length;
      p += std::max(0.0f, least[opposite] * height - glm::dot(p - at[k], inward)) * inward;
    }
  }
  if (p == from) return share;
  const vec3 straight = shares_of(at, p);
  if (glm::all(glm::greaterThanEqual(straight, 0.99f * least))) return straight;
  const vec3 lifted = glm::max(share, least), spare = lifted - least;
  const float over = lifted.x + lifted.y + lifted.z - 1, free = spare.x + spare.y + spare.z;
  return free > 0 ? lifted - spare * (over / free) : lifted;
}

void add_faces(const WorldMesh& mesh, const Chart& chart, const PlacedChart& place,
               std::vector<Face>& faces) {
  for (const FlatTriangle& flat : chart.triangles) {
    const uvec3& t = mesh.mesh.triangles[flat.triangle];
    Face face;
    face.front = glm::normalize(mesh.front(t));
    face.open = flat.open;
    face.moves = mesh.moves;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = t[static_cast<int>(k)];
      face.position[k] = mesh.positions[v];
      face.normal[k] = mesh.normals.empty() ? face.front : mesh.normals[v];
      // A shading normal behind its surface would be lit from within.
      if (!(glm::dot(face.normal[k], face.front) > 0)) face.normal[k] = face.front;
      face.at[k] = place.texel(flat.at[k]);
    }
    faces.push_back(face);
  }
}

/// Texels of one chart, by rows.
std::vector<Texel> chart_texels(std::span<const Face> faces, std::uint32_t first_face,
                                const PlacedChart& place, int width) {
  const glm::ivec2 low = place.first - gutter, size = place.count + 2 * gutter;
  struct Best {
    float away2 = std::numeric_limits<float>::infinity();  ///< of its place from its centre
    std::uint32_t face = 0;
    vec3 share{0};
    vec2 way{0};
  };
  std::vector<Best> best(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::array<vec2, 3>& at = faces[f].at;
    const vec2 from = glm::min(at[0], glm::min(at[1], at[2])) - 1.5f,
               to = glm::max(at[0], glm::max(at[1], at[2])) + 0.5f;
    const glm::ivec2 begin = glm::max(glm::ivec2(glm::floor(from)), low),
                     end = glm::min(glm::ivec2(glm::ceil(to)), low + size - 1);
    for (int y = begin.y; y <= end.y; ++y) {
      for (int x = begin.x; x <= end.x; ++x) {
        const vec2 centre = vec2(x, y) + 0.5f;
        const Nearest found = nearest(at, centre);
        // A filter reaches less than a texel along each axis.
        if (found.distance2 > 2) continue;
        // Off the border may be in the neighbour.
        const vec3 share = within(faces[f], found.share);
        const vec2 its = share.x * at[0] + share.y * at[1] + share.z * at[2];
        const bool is_centre = found.distance2 == 0 && share == found.share;
        const vec2 way = is_centre ? vec2(0) : centre - its;
        const float away2 = glm::dot(way, way);
        Best& known = best[static_cast<std::size_t>(y - low.y) * static_cast<std::size_t>(size.x) +
                           static_cast<std::size_t>(x - low.x)];
        if (away2 < known.away2) known = {away2, static_cast<std::uint32_t>(f), share, way};
      }
    }
  }
  std::vector<Texel> out;
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (std::isinf(best[i].away2)) continue;
    const auto columns = static_cast<std::size_t>(size.x);
    const std::size_t x = static_cast<std::size_t>(low.x) + i % columns,
                      y = static_cast<std::size_t>(low.y) + i / columns;
    out.push_back({static_cast<std::uint32_t>(y * static_cast<std::size_t>(width) + x),
                   first_face + best[i].face, best[i].share, best[i].way});
  }
  return out;
}

}  // namespace

Texels make_texels(const scene::Scene& scene, float time, std::span<const Chart> charts, const Layout& layout,
                   const Control& control) {
  require_fit(scene, charts, layout, "lightmap texels");
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  Texels out;
  out.width = layout.width, out.height = layout.height, out.places = layout.places;
  std::vector<std::size_t> first_face = {0};
  std::optional<WorldMesh> mesh;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    if (i == 0 || charts[i].instance != charts[i - 1].instance)
      mesh.emplace(scene, scene.instances[charts[i].instance], world);
    add_faces(*mesh, charts[i], layout.places[i], out.faces);
    first_face.push_back(out.faces.size());
  }
  std::vector<std::vector<Texel>> each(charts.size());
  parallel_for(
      charts.size(), 1,
      [&](std::size_t i) {
        each[i] = chart_texels(std::span(out.faces).subspan(first_face[i], first_face[i + 1] - first_face[i]),
                               static_cast<std::uint32_t>(first_face[i]), layout.places[i], layout.width);
      },
      control);
  out.first = {0};
  for (std::vector<Texel>& texels : each) {
    out.texels.insert(out.texels.end(), texels.begin(), texels.end());
    out.first.push_back(out.texels.size());
    texels = {};
  }
  return out;
}

rays::SurfacePoint place_of(const Texels& texels, const Texel& texel, const vec2& step) {
  const Face& face = texels.faces[texel.face];
  vec3 share = texel.share;
  if (step != vec2(0)) {
    const vec2 at = share.x * face.at[0] + share.y * face.at[1] + share.z * face.at[2];
    share = within(face, nearest(face.at, at + step).share);
  }
  const auto mean = [&](const std::array<vec3, 3>& v) {
    return share.x * v[0] + share.y * v[1] + share.z * v[2];
  };
  const vec3 normal = mean(face.normal);
  const float length = glm::length(normal);
  return {mean(face.position), length > 0 ? normal / length : face.front, face.moves};
}

}  // namespace ssphh::lightmap
