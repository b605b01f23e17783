/// Methods that keep no light in probes: the drawn picture is what the method itself finds at the middle of
/// every pixel, where nothing has noise.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/core/parallel.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/shading/bsdf.h>
#include <ssphh/trace/transport_scene.h>

#include "count_allocations.h"
#include "gl_context.h"
#include "pictures.h"

namespace ssphh {
namespace {

using test::PictureSize;
using Settings = std::vector<std::string>;
using testing::HasSubstr;

constexpr PictureSize method_size{96, 54};
/// Small maps, to be quick.
const realtime::RendererParams quick{.virtual_light_map_bytes = std::size_t{16} << 20};

/// A method in a scene, lit for one time.
struct Subject {
  Subject(scene::Scene given, const std::string& name, const Settings& settings, float at = 0)
      : scene(std::move(given)), source(scene), time(at) {
    const methods::MethodEntry& entry = methods::find_method(name);
    method = entry.make({scene, source}, methods::MethodParameters(name, entry.parameters, settings), {});
    method->update(rays::lighting_at(source, time), {});
  }
  Subject(const std::string& builtin, const std::string& name, const Settings& settings, float at = 0)
      : Subject(scene::make_builtin(builtin), name, settings, at) {}

  /// Moved a little aside, so that no edge of these scenes passes through the middle of pixels.
  scene::CameraPose camera(const std::string& name) const {
    scene::CameraPose pose = scene::camera_pose(scene, name, time);
    pose.world[3] += vec4(0.013f, 0.007f, 0, 0);
    return pose;
  }

  scene::Scene scene;
  trace::TransportScene source;
  float time;
  std::unique_ptr<methods::Method> method;
};

struct Picture {
  image::Image radiance, normal;
};

/// What the surfaces reflect of the method's own lookups: ρ E/π, or as trace does where all have one glossy
/// material.
Picture looked_up(const Subject& subject, const std::string& camera,
                  const shading::BsdfParams* glossy = nullptr) {
  const std::vector<rays::RayQuery> rays = test::pixel_rays(subject.camera(camera), method_size);
  std::vector<rays::RayHit> hits(rays.size());
  rays::PosedWorld(subject.source, subject.time).intersect(rays, hits);
  Picture picture{{method_size.width, method_size.height, 3}, {method_size.width, method_size.height, 3}};
  parallel_for(rays.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (hits[i].escaped()) continue;
      const int x = static_cast<int>(i) % method_size.width, y = static_cast<int>(i) / method_size.width;
      const vec3 at = rays[i].origin + hits[i].distance * rays[i].direction;
      const rays::SurfacePoint point{at, hits[i].normal};
      const vec3 irradiance = subject.method->light().irradiance(point);
      vec3 radiance = hits[i].albedo / pi * irradiance;
      if (glossy) {
        const vec3 wo = -glm::normalize(rays[i].direction), mirror = glm::reflect(-wo, point.normal);
        const vec3 e = shading::directional_albedo({vec3(0), glossy->f0, 0, glossy->specular_roughness},
                                                   glm::dot(wo, point.normal));
        radiance = glossy->diffuse * (vec3(1) - e) / pi * irradiance +
                   e * subject.method->light().glossy(point, mirror, glossy->specular_roughness);
      }
      picture.radiance.set_rgb(x, y, radiance);
      picture.normal.set_rgb(x, y, hits[i].normal);
    }
  });
  return picture;
}

/// Of luminance, relative to the truth, its mean / 10 added in squares.
struct LightDifference {
  double relmse = 0;
  double largest = 0;  ///< of the means of blocks of 6 × 6
  double ratio = 0;    ///< of the pictures' means
};

/// Leaves out pixels that show different surfaces: edges that pass through their very middle.
LightDifference difference(const Picture& picture, const Picture& truth) {
  constexpr int block = 6;
  const auto counts = [&](int x, int y) {
    return glm::dot(picture.normal.rgb(x, y), truth.normal.rgb(x, y)) > 0.99f;
  };
  const auto value = [&](const Picture& p, int x, int y) {
    return counts(x, y) ? static_cast<double>(luminance(p.radiance.rgb(x, y))) : 0;
  };
  double mean = 0, of_picture = 0;
  for (int y = 0; y < method_size.height; ++y) {
    for (int x = 0; x < method_size.width; ++x)
      mean += value(truth, x, y), of_picture += value(picture, x, y);
  }
  LightDifference d{0, 0, of_picture / mean};
  constexpr double pixels = method_size.width * method_size.height;
  const double least = 0.1 * mean / pixels;
  for (int by = 0; by < method_size.height / block; ++by) {
    for (int bx = 0; bx < method_size.width / block; ++bx) {
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
      stats_ = renderer.draw(subject.camera(camera), settings,
                             {.width = method_size.width, .height = method_size.height});
      return renderer.read_back();
    };
    Picture picture{{}, view(realtime::View::normal)};
    for (float& v : picture.normal.pixels) v = 2 * v - 1;
    picture.radiance = view(realtime::View::indirect);
    return picture;
  }
  Picture draw(const Subject& subject, const std::string& camera,
               const realtime::RendererParams& params = quick) {
    realtime::Renderer renderer(gl(), subject.scene, params, subject.time);
    renderer.set_method_light(subject.method->light_data());
    return draw(renderer, subject, camera);
  }

  realtime::FrameStats stats_;
};

double number(const realtime::Renderer& renderer, const std::string& name) {
  for (const auto& [key, value] : renderer.method_numbers())
    if (key == name) return value;
  ADD_FAILURE() << name;
  return 0;
}

struct MethodView {
  std::string scene, camera;
  float time;
};
void PrintTo(const MethodView& view, std::ostream* out) {
  *out << view.scene << " " << view.camera << " " << view.time;
}

class MethodPicture : public MethodLight, public testing::WithParamInterface<MethodView> {};

/// The same arithmetic on the same voxels. What differs: voxels are halves (2⁻¹¹), normals have 16 bits; and
/// where a rounding decides whether a surface is still being crossed, one of 16 cones goes on with another
/// size of voxels: it may err by half of what it sees, 1/32 of the whole.
TEST_P(MethodPicture, OfConesThroughVoxelsIsTheCpus) {
  const MethodView& view = GetParam();
  const bool dense = view.time > 0;  // both ways to keep voxels give the same ones
  const Subject subject(view.scene, "vct",
                        {"resolution=32", "bounces=2", dense ? "storage=dense" : "storage=sparse"},
                        view.time);
  const LightDifference d = difference(draw(subject, view.camera), looked_up(subject, view.camera));
  EXPECT_LT(d.relmse, 4e-5);
  EXPECT_LT(d.largest, 1.0 / 32);
  EXPECT_NEAR(d.ratio, 1, 5e-4);
}

/// Edges of shadows move by up to 1.5 texels: with 126 on 2 d at distance d, 0.024 d, which is 0.4 of a block
/// where the picture is d wide. Of some 75 lights none gives more than a quarter of a block's light.
TEST_P(MethodPicture, OfVirtualLightsIsTheCpusUpToTexelsOfTheirMaps) {
  const MethodView& view = GetParam();
  for (const char* kind : {"kind=point", "kind=sphere"}) {
    const Subject subject(view.scene, "vpl", {"photons=48", "check_points=0", kind}, view.time);
    const Picture truth = looked_up(subject, view.camera);
    const LightDifference coarse =
        difference(draw(subject, view.camera, {.virtual_light_map_bytes = std::size_t{4} << 20}), truth);
    const LightDifference fine =
        difference(draw(subject, view.camera, {.virtual_light_map_bytes = std::size_t{64} << 20}), truth);
    EXPECT_LT(fine.relmse, 0.01) << kind;
    EXPECT_LT(fine.largest, 0.08) << kind;
    EXPECT_NEAR(fine.ratio, 1, 0.002) << kind;
    // A quarter of the texel, at most a quarter of the moved area
    EXPECT_LT(fine.relmse, 0.5 * coarse.relmse) << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(Builtin, MethodPicture,
                         testing::Values(MethodView{"cornell", "", 0}, MethodView{"two-rooms", "room-b", 1}),
                         [](const auto& given) {
                           std::string name = given.param.scene + given.param.camera;
                           std::erase(name, '-');
                           return name;
                         });

/// F0 has 10 bits and the lobes' albedo a table of 32² entries; sharp lobes show the edges of single maps.
TEST_F(MethodLight, IsReflectedByGlossySurfacesAsTheTracerDoes) {
  for (const float roughness : {0.45f, 0.9f}) {
    scene::Scene scene = scene::make_builtin("cornell");
    for (scene::Material& material : scene.materials) {
      material.base_color = vec3(0.5f);
      material.metallic = 0.5f, material.specular = 1;
      material.specular_roughness = roughness;
    }
    const shading::BsdfParams bsdf{vec3(0.25f), vec3(0.27f), 0, roughness};
    const Subject cones(scene, "vct", {"resolution=16", "bounces=1"});
    const LightDifference by_cones = difference(draw(cones, ""), looked_up(cones, "", &bsdf));
    EXPECT_LT(by_cones.largest, 0.01) << roughness;
    EXPECT_NEAR(by_cones.ratio, 1, 0.002) << roughness;
    const Subject lights(scene, "vpl", {"photons=32", "check_points=0"});
    const LightDifference by_lights = difference(draw(lights, ""), looked_up(lights, "", &bsdf));
    EXPECT_LT(by_lights.largest, 0.06) << roughness;
    EXPECT_NEAR(by_lights.ratio, 1, 0.002) << roughness;
  }
}

TEST_F(MethodLight, BehindAShutDoorIsDark) {
  const Subject lights("two-rooms", "vpl", {"photons=64", "check_points=0"});
  const realtime::RendererParams fine{.virtual_light_map_bytes = std::size_t{64} << 20};
  const double lit = test::mean_luminance(draw(lights, "room-a", fine).radiance);
  const double dark = test::mean_luminance(draw(lights, "room-b", fine).radiance);
  ASSERT_EQ(test::mean_luminance(looked_up(lights, "room-b").radiance), 0);
  // The door is 4 cm thick; what stands within 1.5 texels behind it, 7 cm at 1.5 m, may be lit
  EXPECT_LT(dark, 2e-3 * lit);

  // Voxels leak, as much as on the CPU
  const Subject cones("two-rooms", "vct", {"resolution=32", "bounces=1"});
  const LightDifference d = difference(draw(cones, "room-b"), looked_up(cones, "room-b"));
  EXPECT_NEAR(d.ratio, 1, 0.005);
}

TEST_F(MethodLight, KeepsToTheMemoryItIsGiven) {
  const Subject cones("cornell", "vct", {"resolution=32", "bounces=1"});
  realtime::RendererParams params;
  params.voxel_bytes = std::size_t{1} << 20;
  realtime::Renderer small(gl(), cones.scene, params);
  try {
    small.set_method_light(cones.method->light_data());
    ADD_FAILURE() << "there is no room";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("GB in OpenGL"));
    EXPECT_THAT(e.what(), HasSubstr("lower resolution"));
  }
  EXPECT_TRUE(small.method_numbers().empty());

  const Subject lights("cornell", "vpl", {"photons=512", "check_points=0"});
  params.virtual_light_map_bytes = std::size_t{4} << 20;
  realtime::Renderer renderer(gl(), lights.scene, params);
  const std::size_t before = renderer.memory_bytes();
  renderer.set_method_light(lights.method->light_data());
  EXPECT_EQ(number(renderer, "gl_lights"), 170) << "of 838: what 4 MiB hold of six maps of 32 x 32 floats";
  EXPECT_EQ(number(renderer, "gl_map_size"), 32);
  const std::size_t added = renderer.memory_bytes() - before;
  EXPECT_EQ(number(renderer, "gl_bytes"), static_cast<double>(added));
  EXPECT_LE(added, params.virtual_light_map_bytes + 170 * 48);
  const LightDifference d = difference(draw(renderer, lights, ""), looked_up(lights, ""));
  EXPECT_NEAR(d.ratio, 1, 0.05)
      << "the same power; the means of 170 random lights of some size differ by 1/√170";
  renderer.clear_method_light();
  EXPECT_TRUE(renderer.method_numbers().empty());
  EXPECT_EQ(test::mean_luminance(draw(renderer, lights, "").radiance), 0);

  params.virtual_light_map_bytes = 1000;
  realtime::Renderer none(gl(), lights.scene, params);
  EXPECT_THROW(none.set_method_light(lights.method->light_data()), Error);
  EXPECT_THROW(none.set_method_light({}), Error);
}

TEST_F(MethodLight, FollowsLampsAndKeepsMapsThatHold) {
  Subject lights("two-rooms", "vpl", {"photons=64", "check_points=0"});
  realtime::Renderer renderer(gl(), lights.scene, quick);
  renderer.set_method_light(lights.method->light_data());
  const scene::CameraPose camera = lights.camera("room-a");
  const realtime::Target target{.width = method_size.width, .height = method_size.height};
  EXPECT_GT(renderer.draw(camera, {}, target).shadow_maps_drawn, number(renderer, "gl_lights"))
      << "some faces of each light's cube, beside the lamp's";
  const double once = test::mean_luminance(draw(renderer, lights, "room-a").radiance);
  scene::LightingState state = rays::lighting_at(lights.source, 0);
  for (vec3& scale : state.group_scales) scale = vec3(2);
  lights.method->update(state, {});
  renderer.set_method_light(lights.method->light_data());
  EXPECT_EQ(renderer.draw(camera, {}, target).shadow_maps_drawn, 0);
  EXPECT_NEAR(test::mean_luminance(draw(renderer, lights, "room-a").radiance) / once, 2, 1e-4);

  state.lights[0].world[3].x += 0.5f;
  lights.method->update(state, {});
  renderer.set_method_light(lights.method->light_data());
  const Picture moved = draw(renderer, lights, "room-a");
  EXPECT_LT(difference(moved, looked_up(lights, "room-a")).relmse, 0.01);
  // Voxels in the place of the lights
  Subject cones("two-rooms", "vct", {"resolution=32", "bounces=1"});
  renderer.set_method_light(cones.method->light_data());
  for (int again = 0; again < 2; ++again) {
    EXPECT_LT(difference(draw(renderer, cones, "room-a"), looked_up(cones, "room-a")).relmse, 1e-4);
    EXPECT_EQ(stats_.shadow_maps_drawn, 0) << "voxels have none";
    cones.method->update(state, {});
    renderer.set_method_light(cones.method->light_data());
  }
}

TEST_F(MethodLight, ByImagesIsTheSameLight) {
  const std::vector<std::pair<std::string, Settings>> methods = {{"vct", {"resolution=16", "bounces=1"}},
                                                                 {"vpl", {"photons=64", "check_points=0"}}};
  for (const auto& [name, settings] : methods) {
    const Subject subject("two-rooms", name, settings);
    realtime::Renderer renderer(gl(), subject.scene, quick);
    renderer.set_method_light(subject.method->light_data());
    const double every = test::mean_luminance(draw(renderer, subject, "room-a").radiance);
    realtime::FrameSettings frame;
    frame.indirect_scale = 2;
    EXPECT_NEAR(test::mean_luminance(draw(renderer, subject, "room-a", frame).radiance) / every, 1, 0.005);
    frame.ambient_occlusion = true;
    EXPECT_LT(test::mean_luminance(draw(renderer, subject, "room-a", frame).radiance), 0.99 * every);
    frame.indirect = false;
    EXPECT_EQ(test::mean_luminance(draw(renderer, subject, "room-a", frame).radiance), 0);
  }
}

TEST_F(MethodLight, FramesInSteadyStateAllocateNothing) {
  for (const char* name : {"vct", "vpl"}) {
    const Subject subject("two-rooms", name,
                          name == std::string("vct") ? Settings{"resolution=8", "bounces=1"}
                                                     : Settings{"photons=8", "check_points=0"});
    realtime::Renderer renderer(gl(), subject.scene, quick);
    renderer.set_method_light(subject.method->light_data());
    const scene::CameraPose camera = subject.camera("");
    const realtime::Target target{.width = 16, .height = 9};
    for (int i = 0; i < 3; ++i) renderer.draw(camera, {}, target);
    const long before = test::allocations();
    for (int i = 0; i < 10; ++i) renderer.draw(camera, {}, target);
    EXPECT_EQ(test::allocations() - before, 0) << name;
  }
}

}  // namespace
}  // namespace ssphh
