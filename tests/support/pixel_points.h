#pragma once
/// What stands behind the middle of every pixel, by rays of the tests' own: where pictures without noise are
/// compared.

#include <cmath>
#include <vector>

#include <ssphh/core/parallel.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/query.h>

namespace ssphh::test {

struct PictureSize {
  int width = 128, height = 72;
};

/// Through the middle of each pixel, row 0 on top.
inline std::vector<rays::RayQuery> pixel_rays(const scene::CameraPose& pose, PictureSize size) {
  const bool parallel = pose.camera.orthographic;
  const float up = parallel ? 0.5f * pose.camera.yheight : std::tan(0.5f * pose.camera.yfov),
              right = up * static_cast<float>(size.width) / static_cast<float>(size.height);
  std::vector<rays::RayQuery> rays;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const vec2 place = 2.0f * vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) /
                             vec2(size.width, size.height) -
                         1.0f;
      const vec3 plane(place.x * right, -place.y * up, 0);
      rays.push_back(
          {vec3(pose.world * vec4(parallel ? plane : vec3(0), 1)),
           glm::normalize(vec3(pose.world * vec4((parallel ? vec3(0) : plane) + vec3(0, 0, -1), 0)))});
    }
  }
  return rays;
}

struct PixelPoint {
  rays::RayHit hit;
  rays::SurfacePoint point;  ///< its normal toward the viewer; as the surface is, without smooth normals
  vec3 wo{0};                ///< toward the viewer
};

struct PixelPoints {
  PixelPoints(const rays::TransportSource& source, const scene::CameraPose& pose, PictureSize picture_size,
              float time = 0)
      : size(picture_size) {
    const std::vector<rays::RayQuery> rays = pixel_rays(pose, size);
    std::vector<rays::RayHit> hits(rays.size());
    std::vector<std::uint8_t> moves(rays.size());
    rays::PosedWorld(source, time).intersect(rays, hits, moves);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      pixels.push_back({hits[i], {}, -rays[i].direction});
      if (!hits[i].escaped())
        pixels[i].point = {rays[i].origin + hits[i].distance * rays[i].direction, hits[i].normal,
                           moves[i] != 0};
    }
  }

  std::size_t index(const PixelPoint& pixel) const {
    return static_cast<std::size_t>(&pixel - pixels.data());
  }
  const PixelPoint& at(int x, int y) const { return pixels[y * size.width + x]; }

  /// A picture of `value(const PixelPoint&)` where anything stands, else black.
  template <class Value>
  image::Image picture(const Value& value) const {
    image::Image image(size.width, size.height, 3);
    parallel_for(pixels.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (pixels[i].hit.escaped()) continue;
        const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
        image.set_rgb(x, y, value(pixels[i]));
      }
    });
    return image;
  }

  /// Where `differs(a, b)` holds for two pixels side by side or across, as at the edge of a shadow.
  template <class Differs>
  std::vector<bool> edges(const Differs& differs) const {
    std::vector<bool> found(pixels.size());
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        for (int i = 0; i < 9; ++i) {
          const int nx = x + i % 3 - 1, ny = y + i / 3 - 1;
          if (nx < 0 || ny < 0 || nx >= size.width || ny >= size.height) continue;
          const auto here = static_cast<std::size_t>(y * size.width + x);
          if (differs(here, static_cast<std::size_t>(ny * size.width + nx))) found[here] = true;
        }
      }
    }
    return found;
  }

  /// Where surfaces meet: which of them the middle of a pixel shows is a matter of rounding.
  std::vector<bool> corners() const {
    return edges([&](std::size_t a, std::size_t b) {
      return glm::dot(pixels[a].point.normal, pixels[b].point.normal) < 0.9f;
    });
  }

  PictureSize size;
  std::vector<PixelPoint> pixels;
};

}  // namespace ssphh::test
