/// Methods that keep no light in probes: the drawn picture is what the method itself finds at the middle of every
/// pixel, where nothing has noise.

#include <cmath>

#include <gmock/gmock.h>

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

/// ρ E/π at what stands in the middle of each pixel, by the method's own lookup.
image::Image looked_up(const Subject& subject, const std::string& camera) {
  const scene::CameraPose pose = subject.camera(camera);
  const float up = std::tan(0.5f * pose.camera.yfov),
              right = up * static_cast<float>(size.width) / static_cast<float>(size.height);
  std::vector<scene::RayQuery> rays;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const vec2 place = 2.0f * vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) /
                             vec2(size.width, size.height) -
                         1.0f;
      const vec3 local = glm::normalize(vec3(place.x * right, -place.y * up, -1));
      rays.push_back({vec3(pose.world[3]), glm::normalize(vec3(pose.world * vec4(local, 0)))});
    }
  }
  std::vector<scene::RayHit> hits(rays.size());
  gi::PosedSurfaces(subject.source, subject.time).intersect(rays, hits);
  image::Image picture(size.width, size.height, 3);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].escaped()) continue;
    const vec3 x = rays[i].origin + hits[i].distance * rays[i].direction;
    const auto pixel = static_cast<int>(i);
    picture.set_rgb(pixel % size.width, pixel / size.width,
                    hits[i].albedo / pi * subject.method->light().irradiance({x, hits[i].normal}));
  }
  return picture;
}

struct Difference {
  double relmse = 0;   ///< mean of squared differences over squared values, luminance, (mean/10)² added
  double largest = 0;  ///< difference of the means of blocks of 6 × 6 over their value, likewise
  double ratio = 0;    ///< of the pictures' means
};

Difference difference(const image::Image& picture, const image::Image& truth) {
  constexpr int block = 6;
  Difference d;
  const double mean = test::mean_luminance(truth), floor = 0.1 * mean;
  for (int by = 0; by < size.height / block; ++by) {
    for (int bx = 0; bx < size.width / block; ++bx) {
      double a = 0, b = 0;
      for (int i = 0; i < block * block; ++i) {
        const int x = bx * block + i % block, y = by * block + i / block;
        const auto p = static_cast<double>(luminance(picture.rgb(x, y)));
        const auto t = static_cast<double>(luminance(truth.rgb(x, y)));
        a += p / (block * block), b += t / (block * block);
        d.relmse += (p - t) * (p - t) / (t * t + floor * floor) / (size.width * size.height);
      }
      d.largest = std::max(d.largest, std::abs(a - b) / std::hypot(b, floor));
    }
  }
  d.ratio = test::mean_luminance(picture) / mean;
  return d;
}

class MethodLight : public test::WithGl {
 protected:
  image::Image draw(realtime::Renderer& renderer, const Subject& subject, const std::string& camera,
                    realtime::FrameSettings settings = {}) {
    settings.view = realtime::View::indirect;
    stats_ = renderer.draw(subject.camera(camera), settings, {.width = size.width, .height = size.height});
    return renderer.read_back();
  }
  image::Image draw(const Subject& subject, const std::string& camera,
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
    const Subject subject(view.scene, "vpl", {"photons=128", "check_points=0", kind}, view.time);
    const Difference d = difference(draw(subject, view.camera), looked_up(subject, view.camera));
    std::printf("vpl %s %g %s: relMSE %.2e largest %.4f ratio %.5f\n", view.camera.c_str(), double(view.time), kind, d.relmse, d.largest, d.ratio);
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
