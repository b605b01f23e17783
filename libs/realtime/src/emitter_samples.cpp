#include "emitter_samples.h"

#include <algorithm>
#include <cmath>

#include <ssphh/image/sphere_map.h>
#include <ssphh/image/transfer.h>
#include <ssphh/scene/query.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/shading/lights.h>

namespace ssphh::realtime {
namespace {

struct Place {
  vec3 world, normal;

  /// Squared; unit normals that face opposite ways count as twice the root of `turn`.
  float distance2(const Place& other, float turn) const {
    const vec3 d = world - other.world, n = normal - other.normal;
    return glm::dot(d, d) + turn * glm::dot(n, n);
  }
};

std::vector<Place> points_by_area(const scene::Mesh& mesh, const mat4& to_world, int count) {
  std::vector<double> sum;
  double total = 0;
  const auto corner = [&](unsigned i) { return vec3(to_world * vec4(mesh.positions[i], 1)); };
  for (const uvec3& t : mesh.triangles) {
    const vec3 cross = glm::cross(corner(t.y) - corner(t.x), corner(t.z) - corner(t.x));
    sum.push_back(total += 0.5 * static_cast<double>(glm::length(cross)));
  }
  std::vector<Place> places;
  if (!(total > 0)) return places;
  for (int i = 0; i < count; ++i) {
    const double at = total * (i + 0.5) / count;
    const auto found = std::ranges::lower_bound(sum, at);
    const auto t = static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(found - sum.begin(), static_cast<std::ptrdiff_t>(sum.size()) - 1));
    const uvec3& triangle = mesh.triangles[t];
    const auto n = static_cast<unsigned>(i + 1);
    const auto root = static_cast<float>(std::sqrt(radical_inverse(n, 2)));
    const auto v = static_cast<float>(radical_inverse(n, 3));
    const vec3 a = corner(triangle.x), b = corner(triangle.y), c = corner(triangle.z);
    const vec3 cross = glm::cross(b - a, c - a);
    if (!(glm::length(cross) > 0)) continue;
    places.push_back({(1 - root) * a + root * (1 - v) * b + root * v * c, glm::normalize(cross)});
  }
  return places;
}

}  // namespace

double radical_inverse(unsigned i, unsigned base) {
  double value = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

std::optional<Ball> as_ball(const scene::Mesh& mesh) {
  constexpr float off_round = 0.02f, least_area = 0.8f;
  scene::Bounds box;
  for (const uvec3& t : mesh.triangles)
    for (int c = 0; c < 3; ++c) box.add(mesh.positions[t[c]]);
  const vec3 center = 0.5f * (box.min + box.max);
  const float round = 0.5f * (box.max.x - box.min.x);
  float area = 0;
  for (const uvec3& t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    for (const vec3& corner : {a, b, c})
      if (std::abs(glm::distance(corner, center) - round) > off_round * round) return std::nullopt;
    const vec3 cross = glm::cross(b - a, c - a);
    if (glm::dot(cross, a - center) < 0) return std::nullopt;  // seen from within
    area += 0.5f * glm::length(cross);
  }
  if (!(area > least_area * 4 * pi * round * round)) return std::nullopt;
  return Ball{center, std::sqrt(area / (4 * pi))};
}

std::vector<AreaPoint> spread_points(const scene::Mesh& mesh, const mat4& to_world, int count) {
  constexpr int candidates_each = 64, rounds = 12;
  const std::vector<Place> places = points_by_area(mesh, to_world, candidates_each * count);
  if (places.empty()) return {};
  scene::Bounds box;
  for (const Place& p : places) box.add(p.world);
  // Points that face different ways are as far apart as half the light
  const float turn = 0.25f * box.radius() * box.radius();

  std::vector<Place> centers;
  const std::size_t step = std::max<std::size_t>(1, places.size() / static_cast<std::size_t>(count));
  for (std::size_t i = step / 2; i < places.size() && centers.size() < static_cast<std::size_t>(count);
       i += step)
    centers.push_back(places[i]);
  std::vector<int> members(centers.size());
  for (int round = 0; round < rounds; ++round) {
    std::vector<Place> sums(centers.size(), {vec3(0), vec3(0)});
    std::ranges::fill(members, 0);
    for (const Place& p : places) {
      std::size_t best = 0;
      for (std::size_t c = 1; c < centers.size(); ++c) {
        if (p.distance2(centers[c], turn) < p.distance2(centers[best], turn)) best = c;
      }
      sums[best].world += p.world, sums[best].normal += p.normal;
      ++members[best];
    }
    for (std::size_t c = 0; c < centers.size(); ++c) {
      if (members[c] == 0) continue;
      centers[c].world = sums[c].world / static_cast<float>(members[c]);
      if (glm::length(sums[c].normal) > 0) centers[c].normal = glm::normalize(sums[c].normal);
    }
  }

  // On the surface itself: the nearest of the places
  const mat4 back = glm::inverse(to_world);
  std::vector<AreaPoint> points;
  for (std::size_t c = 0; c < centers.size(); ++c) {
    if (members[c] == 0) continue;
    const Place& nearest = *std::ranges::min_element(places, [&](const Place& a, const Place& b) {
      return a.distance2(centers[c], turn) < b.distance2(centers[c], turn);
    });
    const vec3 normal = glm::normalize(glm::transpose(mat3(to_world)) * nearest.normal);
    points.push_back({vec3(back * vec4(nearest.world, 1)), normal,
                      static_cast<float>(members[c]) / static_cast<float>(places.size())});
  }
  return points;
}

namespace {

/// The radius of a point of the unit ball by its share u of the points: their density falls as 1/sqrt(1 -
/// r²), and so they fill a disc evenly from wherever they are seen. With r = sin a, u is (2 a - sin 2a) / pi.
double even_disc_radius(double u) {
  double low = 0, high = pi_d / 2;
  while (high - low > 1e-9) {
    const double middle = (low + high) / 2;
    (2 * middle - std::sin(2 * middle) < u * pi_d ? low : high) = middle;
  }
  return std::sin(low);
}

}  // namespace

std::vector<AreaPoint> ball_points(float radius, int count) {
  std::vector<AreaPoint> points;
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<unsigned>(i + 1);
    const double z = 1 - 2 * (i + 0.5) / count, phi = 2 * pi_d * radical_inverse(n, 2);
    const double r = count == 1 ? 0 : static_cast<double>(radius) * even_disc_radius(radical_inverse(n, 3));
    const double s = std::sqrt(1 - z * z);
    points.push_back({vec3(glm::dvec3(r * s * std::cos(phi), r * s * std::sin(phi), r * z)), vec3(0),
                      1.0f / static_cast<float>(count)});
  }
  return points;
}

std::vector<vec3> disc_parts(float radius, int most) {
  // A map of depth knows no sides of what stands along the light: a ray that leans by more may pass through
  constexpr double widest = 0.04;
  // In up to three rings. Of a straight edge's shadow these err by at most 0, 0.038, 0.019, 0.022, 0.014 of
  // the light
  constexpr int rings[][3] = {{1, 0, 0}, {4, 0, 0}, {1, 6, 0}, {3, 9, 0}, {1, 5, 10}};
  const auto number = [](const int(&ring)[3]) { return ring[0] + ring[1] + ring[2]; };
  const double sine = std::sin(std::min(static_cast<double>(radius), pi_d / 2));
  std::size_t chosen = 0;
  while (chosen + 1 < std::size(rings) && number(rings[chosen + 1]) <= most &&
         number(rings[chosen]) * widest * widest < sine * sine)
    ++chosen;

  const int count = number(rings[chosen]);
  std::vector<glm::dvec2> places;
  double spread = 0;  // mean square
  for (int ring = 0, inside = 0; ring < 3; ++ring) {
    const int n = rings[chosen][ring];
    const double r = n == 1 ? 0 : std::sqrt((inside + 0.5 * n) / count);
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * pi_d * (i + 0.5 * ring) / n;
      places.emplace_back(r * std::cos(angle), r * std::sin(angle));
      spread += r * r / count;
    }
    inside += n;
  }
  // The mean square of a disc of radius 1 is 1/2, of which a part has 1/(2 count)
  const double scale = count > 1 ? sine * std::sqrt((0.5 - 0.5 / count) / spread) : 0;
  std::vector<vec3> parts;
  for (const glm::dvec2& p : places)
    parts.emplace_back(glm::dvec3(scale * p, std::sqrt(1 - scale * scale * glm::dot(p, p))));
  return parts;
}

std::vector<EnvironmentSample> environment_directions(const scene::Environment& environment, int count) {
  scene::Scene alone;
  alone.environment = environment;
  const shading::LightSet lights(alone, {});
  std::vector<EnvironmentSample> out;
  if (lights.emitter_count() == 0) return out;
  for (int i = 0; i < count; ++i) {
    const vec2 u((static_cast<float>(i) + 0.5f) / static_cast<float>(count),
                 static_cast<float>(radical_inverse(static_cast<unsigned>(i) + 1, 2)));
    const auto sample = lights.sample_emitter(0, vec3(0), u);
    if (!sample || !(sample->pdf > 0)) continue;
    out.push_back({sample->wi, sample->radiance / (sample->pdf * static_cast<float>(count))});
  }
  return out;
}

sh::IrradianceSh environment_irradiance(const scene::Environment& environment) {
  constexpr int degree = 4;
  std::array<float, 25> basis;
  sh::RadianceSh light(degree);
  const image::Image& image = environment.equirect;
  if (image.empty()) {
    light[0] = environment.color * std::sqrt(4 * pi);
    return sh::irradiance_from_radiance(light);
  }
  const int width = image.width, height = image.height;
  const float c = std::cos(environment.rotation), s = std::sin(environment.rotation);
  for (int y = 0; y < height; ++y) {
    const auto solid_angle = static_cast<float>(image::equirect_solid_angle(y, width, height));
    for (int x = 0; x < width; ++x) {
      const vec3 d = image::equirect_direction((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                               (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
      sh::eval_basis(degree, vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x), basis);
      const vec3 radiance = environment.color * image.rgb(x, y) * solid_angle;
      for (int k = 0; k < 25; ++k) light[k] += radiance * basis[k];
    }
  }
  return sh::irradiance_from_radiance(light);
}

vec3 mean_emission(const scene::Scene& scene, const scene::Material& material) {
  if (material.emission_texture.texture < 0) return material.emission;
  const scene::Texture& texture = scene.textures[material.emission_texture.texture];
  glm::dvec3 sum(0);
  const std::size_t texels = texture.rgba.size() / 4;
  for (std::size_t i = 0; i < texels; ++i) {
    for (int c = 0; c < 3; ++c)
      sum[c] +=
          static_cast<double>(image::srgb8_to_linear(texture.rgba[4 * i + static_cast<std::size_t>(c)]));
  }
  return material.emission * vec3(sum / static_cast<double>(std::max<std::size_t>(texels, 1)));
}

}  // namespace ssphh::realtime
