#include "results/leak_map.h"

#include <cmath>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/metrics/heat_map.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::app {
namespace {

/// Through the centres of the pixels, row after row from the top left.
std::vector<rays::RayQuery> camera_rays(const scene::CameraPose& pose, int width, int height) {
  const auto axis = [&](int i) { return glm::normalize(vec3(pose.world[i])); };
  const vec3 right = axis(0), up = axis(1), forward = -axis(2), eye(pose.world[3]);
  const scene::Camera& camera = pose.camera;
  const float half = camera.orthographic ? 0.5f * camera.yheight : std::tan(0.5f * camera.yfov);
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  std::vector<rays::RayQuery> rays;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = (2 * (static_cast<float>(x) + 0.5f) / w - 1) * half * w / h;
      const float v = (1 - 2 * (static_cast<float>(y) + 0.5f) / h) * half;
      if (camera.orthographic) {
        rays.push_back({eye + u * right + v * up, forward});
      } else {
        rays.push_back({eye, glm::normalize(forward + u * right + v * up)});
      }
    }
  }
  return rays;
}

}  // namespace

LeakMap leak_map(const rays::TransportSource& surfaces, float time, const scene::CameraPose& camera,
                 int width, int height, const rays::RadianceSource& source, const rays::IndirectLight& lookup,
                 const study::LeakParams& params, const Control& control) {
  const std::vector<rays::RayQuery> rays = camera_rays(camera, width, height);
  std::vector<rays::RayHit> hits(rays.size());
  std::vector<std::uint8_t> moves(rays.size());
  rays::PosedWorld(surfaces, time).intersect(rays, hits, moves);

  LeakMap map{image::Image(width, height, 1), image::Image(width, height, 1)};
  std::vector<rays::SurfacePoint> points;
  std::vector<std::size_t> pixel;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].escaped()) continue;
    map.grey.pixels[i] =
        0.5f * std::abs(glm::dot(hits[i].normal, rays[i].direction)) * luminance(hits[i].albedo);
    points.push_back({rays[i].origin + hits[i].distance * rays[i].direction, hits[i].normal, moves[i] != 0});
    pixel.push_back(i);
  }
  if (points.empty()) return map;
  const study::LeakReport report = study::measure_leak(source, lookup, points, params, control);
  map.dark = report.dark;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (report.dark_at[i]) map.leaked.pixels[pixel[i]] = report.looked_up[i] / params.mean;
  }
  return map;
}

float write_leak_map(const std::filesystem::path& path, const LeakMap& map) {
  if (image::format_of_extension(path) == image::FileFormat::exr) {
    image::write_image(path, map.leaked);
    return 0;
  }
  // Colours only where there is something to see: black ones would hide the scene.
  const float scale = metrics::automatic_scale(map.leaked);
  const image::Rgba8 colors = metrics::heat_map(map.leaked, metrics::ColorRamp::inferno, scale);
  image::Rgba8 picture = metrics::heat_map(map.grey, metrics::ColorRamp::grey, 1);
  for (std::size_t i = 0; i < map.leaked.pixels.size(); ++i) {
    if (!(map.leaked.pixels[i] > 0.01f * scale)) continue;
    for (std::size_t c = 0; c < 4; ++c) picture.rgba[4 * i + c] = colors.rgba[4 * i + c];
  }
  write_file(path, image::encode_png(picture));
  return scale;
}

}  // namespace ssphh::app
