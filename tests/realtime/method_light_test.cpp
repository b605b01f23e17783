/// Methods that keep no light in probes: the drawn picture is what the method itself finds at the middle of every
/// pixel, where nothing has noise.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/core/parallel.h>
#include <ssphh/gi/methods/table.h>
#include <ssphh/gi/surface_points.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "count_allocations.h"
#include "gl_context.h"
#include "pictures.h"

namespace ssphh {
namespace {

using test::PictureSize;
using Settings = std::vector<std::string>;
using testing::HasSubstr;

constexpr PictureSize size{96, 54};

/// A method in a scene, lit for one time.
struct Subject {
  Subject(scene::Scene given, const std::string& name, const Settings& settings, float at = 0)
      : scene(std::move(given)), source(scene), time(at) {
    const gi::MethodEntry& entry = gi::find_method(name);
    method = entry.make({scene, source}, gi::MethodParameters(name, entry.parameters, settings), {});
    method->update(gi::frame_at(source, time), {});
  }
  Subject(const std::string& builtin, const std::string& name, const Settings& settings, float at = 0)
      : Subject(scene::make_builtin(builtin), name, settings, at) {}

  scene::CameraPose camera(const std::string& name) const { return scene::camera_pose(scene, name, time); }

  scene::Scene scene;
  trace::TransportScene source;
  float time;
  std::unique_ptr<gi::Method> method;
};

/// What stands in the middle of each pixel.
std::vector<scene::RayQuery> pixel_rays(const scene::CameraPose& pose) {
  const float up = std::tan(0.5f * pose.camera.yfov),
              right = up * static_cast<float>(size.width) / static_cast<float>(size.height);
  std::vector<scene::RayQuery> rays;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const vec2 place = 2.0f * vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) /
                             vec2(size.width, size.height) -
                         1.0f;
      const vec3 local = glm::normalize(vec3(place.x * right, -place.y * up, -1));
      rays.push_back({vec3(pose.world[3]), vec3(pose.world * vec4(local, 0))});
    }
  }
  return rays;
}

struct Picture {
  image::Image radiance, normal;
};

/// ρ E/π by the method's own lookup.
Picture looked_up(const Subject& subject, const std::string& camera) {
  const std::vector<scene::RayQuery> rays = pixel_rays(subject.camera(camera));
  std::vector<scene::RayHit> hits(rays.size());
  gi::PosedSurfaces(subject.source, subject.time).intersect(rays, hits);
  Picture picture{{size.width, size.height, 3}, {size.width, size.height, 3}};
  parallel_for(rays.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (hits[i].escaped()) continue;
      const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
      const vec3 at = rays[i].origin + hits[i].distance * rays[i].direction;
      const vec3 e = subject.method->light().irradiance({at, hits[i].normal});
      picture.radiance.set_rgb(x, y, hits[i].albedo / pi * e);
      picture.normal.set_rgb(x, y, hits[i].normal);
    }
  });
  return picture;
}

/// Of luminance, relative to the truth, its mean / 10 added in squares.
struct Difference {
  double relmse = 0;
  double largest = 0;  ///< of the means of blocks of 6 × 6
  double ratio = 0;    ///< of the pictures' means
};

/// Leaves out pixels that show different surfaces: edges that pass through their very middle.
Difference difference(const Picture& picture, const Picture& truth) {
  constexpr int block = 6;
  const auto counts = [&](int x, int y) {
    return glm::dot(picture.normal.rgb(x, y), truth.normal.rgb(x, y)) > 0.99f;
  };
  const auto value = [&](const Picture& p, int x, int y) {
    return counts(x, y) ? static_cast<double>(luminance(p.radiance.rgb(x, y))) : 0;
  };
  double mean = 0, of_picture = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) mean += value(truth, x, y), of_picture += value(picture, x, y);
  }
  Difference d{0, 0, of_picture / mean};
  constexpr double pixels = size.width * size.height;
  const double least = 0.1 * mean / pixels;
  for (int by = 0; by < size.height / block; ++by) {
    for (int bx = 0; bx < size.width / block; ++bx) {
      double a = 0, b = 0;
      for (int i = 0; i < block * block; ++i) {
        const int x = bx * block + i % block, y = by * block + i / block;
        const double p = value(picture, x, y), t = value(truth, x, y);
        a += p / (block * block), b += t / (block * block);
        d.relmse += (p - t) * (p - t) / (t * t + least * least) / pixels;
      }
      d.largest = std::max(d.largest, std::abs(a - b) / std::hypot(b, least));
    }
  }
  return d;
}

class MethodLight : public test::WithGl {
 protected:
  Picture draw(realtime::Renderer& renderer, const Subject& subject, const std::string& camera,
               realtime::FrameSettings settings = {}) {
    const auto view = [&](realtime::View wanted) {
      settings.view = wanted;
      stats_ = renderer.draw(subject.camera(camera), settings, {.width = size.width, .height = size.height});
      return renderer.read_back();
    };
    Picture picture{{}, view(realtime::View::normal)};
    for (float& v : picture.normal.pixels) v = 2 * v - 1;
    picture.radiance = view(realtime::View::indirect);
    return picture;
  }
  Picture draw(const Subject& subject, const std::string& camera,
               const realtime::RendererParams& params = {}) {
    realtime::Renderer renderer(gl(), subject.scene, params, subject.time);
    renderer.set_method_light(subject.method->light_data());
    return draw(renderer, subject, camera);
  }

  realtime::FrameStats stats_;
};

[[maybe_unused]] double number(const realtime::Renderer& renderer, const std::string& name) {
  for (const auto& [key, value] : renderer.method_numbers())
    if (key == name) return value;
  ADD_FAILURE() << name;
  return 0;
}

struct View {
  std::string scene, camera;
  float time;
};
void PrintTo(const View& view, std::ostream* out) {
  *out << view.scene << " " << view.camera << " " << view.time;
}

class MethodPicture : public MethodLight, public testing::WithParamInterface<View> {};

/// The same arithmetic on the same voxels. What differs: voxels are halves (2⁻¹¹), normals have 16 bits, and a
/// pixel at an edge may show the other surface, which counts in blocks of 36 pixels.
TEST_P(MethodPicture, OfConesThroughVoxelsIsTheCpus) {
  const View& view = GetParam();
  for (const char* storage : {"storage=sparse", "storage=dense"}) {
    const Subject subject(view.scene, "vct", {"resolution=32", "bounces=2", storage}, view.time);
    const Difference d = difference(draw(subject, view.camera), looked_up(subject, view.camera));
    std::printf("vct %s %g %s: relMSE %.2e largest %.4f ratio %.5f\n", view.camera.c_str(), double(view.time), storage, d.relmse, d.largest, d.ratio);
    EXPECT_LT(d.relmse, 1e-3);
    EXPECT_LT(d.largest, 0.03);
    EXPECT_NEAR(d.ratio, 1, 0.003);
  }
}

TEST_P(MethodPicture, OfVirtualLightsIsTheCpus) {
  const View& view = GetParam();
  for (const char* kind : {"kind=point", "kind=sphere"}) {
    const Subject subject(view.scene, "vpl", {"photons=48", "check_points=0", kind}, view.time);
    const Picture truth = looked_up(subject, view.camera);
    for (const std::size_t mib : {4, 16, 64, 256}) {
      const Difference d = difference(draw(subject, view.camera, {.virtual_light_map_bytes = mib << 20}), truth);
      std::printf("vpl %s %g %s: %d relMSE %.2e largest %.4f ratio %.5f\n", view.camera.c_str(), double(view.time), kind, int(mib), d.relmse, d.largest, d.ratio);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Builtin, MethodPicture,
                         testing::Values(View{"cornell", "", 0}, View{"two-rooms", "room-a", 0},
                                         View{"two-rooms", "room-b", 1}),
                         [](const auto& given) {
                           std::string name = given.param.scene + given.param.camera;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace ssphh
