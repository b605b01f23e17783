#pragma once
/// A RadianceSource with closed-form answers: an analytic field without surfaces, ghost spheres in empty
/// space, and a blocking rule of the test's choice.

#include <atomic>
#include <cmath>
#include <functional>

#include <ssphh/core/random.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::test {

class FakeSource : public rays::RadianceSource {
 public:
  using Field = std::function<vec3(const vec3& position, const vec3& direction)>;

  std::vector<std::string> groups{"sky"};
  /// Per group; missing ones are dark.
  std::vector<Field> emitted, reflected;
  /// Whether the segment is free.
  std::function<bool(const vec3&, const vec3&)> free = [](const vec3&, const vec3&) { return true; };
  float backfaces = 0;
  /// Called at the start of every cube: tests cancel or throw here.
  std::function<void()> on_cube = [] {};

  const std::vector<std::string>& light_groups() const override { return groups; }

  std::vector<rays::GroupRadiance> incident_radiance(const rays::CubeRequest& request,
                                                     const Control&) const override {
    on_cube();
    std::vector<rays::GroupRadiance> result;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      result.push_back({cube(request, g < emitted.size() ? emitted[g] : Field()),
                        cube(request, g < reflected.size() ? reflected[g] : Field())});
    }
    return result;
  }

  /// Spheres seen in empty space, with `spp` jittered rays per texel; radiance 1 where a ray meets the sphere
  /// and the segment to its centre is free. Emission directions are exact.
  std::vector<image::CubeMap> ghost_radiance(const rays::CubeRequest& request,
                                             std::span<const rays::GhostSphere> ghosts, const GhostSink& sink,
                                             const Control&) const override {
    on_cube();
    std::vector<image::CubeMap> cubes(ghosts.size(), image::CubeMap(request.face_size));
    const int n = request.face_size, spp = request.path.spp;
    for (int face = 0; face < 6; ++face) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
          Pcg32 rng(pixel_seed(request.path.seed, static_cast<std::uint32_t>(x),
                               static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(face)));
          const auto omega = static_cast<float>(texel_solid_angle(x, y, n));
          for (int s = 0; s < spp; ++s) {
            const vec2 u = rng.uniform2();
            const vec3 d = cube_direction({face, (static_cast<float>(x) + u.x) / static_cast<float>(n),
                                           (static_cast<float>(y) + u.y) / static_cast<float>(n)});
            for (std::size_t j = 0; j < ghosts.size(); ++j) {
              if (!meets(request.position, d, ghosts[j]) || !free(request.position, ghosts[j].center))
                continue;
              const float value = 1 / static_cast<float>(spp);
              image::Image& image = cubes[j].faces[face];
              image.set_rgb(x, y, image.rgb(x, y) + value);
              if (sink)
                sink((face * n + y) % ghost_chunk_count, {static_cast<int>(j), d, -d, vec3(value * omega)});
            }
          }
          rays_ += static_cast<std::uint64_t>(spp);
        }
      }
    }
    return cubes;
  }

  bool visible(const vec3& a, const vec3& b) const override { return free(a, b); }
  float backface_fraction(const vec3&) const override { return backfaces; }
  std::uint64_t rays_traced() const override { return rays_; }

 private:
  static bool meets(const vec3& origin, const vec3& d, const rays::GhostSphere& ghost) {
    const vec3 to = ghost.center - origin;
    const float distance2 = glm::dot(to, to), r2 = ghost.radius * ghost.radius;
    if (distance2 <= r2) return true;
    const float along = glm::dot(to, d);
    return along > 0 && distance2 - along * along < r2;
  }

  image::CubeMap cube(const rays::CubeRequest& request, const Field& field) const {
    image::CubeMap map(request.face_size);
    if (!field) return map;
    for (std::size_t face = 0; face < 6; ++face) {
      for (int y = 0; y < request.face_size; ++y) {
        for (int x = 0; x < request.face_size; ++x) {
          const vec3 d = texel_direction(static_cast<int>(face), x, y, request.face_size);
          map.faces[face].set_rgb(x, y, field(request.position, d));
        }
      }
    }
    rays_ +=
        6 * static_cast<std::uint64_t>(request.face_size) * static_cast<std::uint64_t>(request.face_size);
    return map;
  }

  mutable std::atomic<std::uint64_t> rays_{0};
};

/// A field of the same value everywhere and in every direction.
inline FakeSource::Field constant(const vec3& value) {
  return [value](const vec3&, const vec3&) { return value; };
}

}  // namespace ssphh::test
