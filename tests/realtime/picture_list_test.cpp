/// Every pixel of small pictures of one of everything, as they were: what formulas and traced pictures
/// elsewhere bound loosely, and which of two variants of a shader a pass takes.

#include <gmock/gmock.h>

#include <ssphh/methods/method_list.h>
#include <ssphh/trace/transport_scene.h>

#include "busy_scene.h"
#include "change_lighting.h"
#include "expected_text.h"
#include "gl_context.h"
#include "listed_pictures.h"
#include "opengl_state.h"
#include "pictures.h"

namespace ssphh::test {
namespace {

using probes::LookupMethod;
using probes::WeightMethod;
using realtime::FrameSettings;
using realtime::Renderer;
using realtime::View;

const realtime::RendererParams quick{.light_map_size = 128,
                                     .area_map_size = 48,
                                     .sun_map_size = 96,
                                     .environment_map_size = 96,
                                     .probe_map_bytes = std::size_t{2} << 20,
                                     .virtual_light_map_bytes = std::size_t{4} << 20,
                                     .area_samples = 4,
                                     .sun_samples = 4,
                                     .environment_samples = 5};

class PictureList : public WithGl {
 protected:
  void SetUp() override {
    WithGl::SetUp();
    if (IsSkipped()) return;
    if (!gl().info().software) GTEST_SKIP() << "filters of other hardware have other bits";
    renderer_.emplace(gl(), scene_, quick);
  }
  void draw(const std::string& name, const FrameSettings& settings,
            double slack = ListedPictures::of_drivers) {
    renderer_->draw(scene::camera_pose(scene_, ""), settings, {.width = 16, .height = 12});
    pictures_.add(name, renderer_->read_back(), slack);
  }

  /// Blocks of frame, distant lights, emitters, materials, instances and cones, and what `units` hold.
  void list_state(const std::string& name, GLuint first_unit, GLuint end_unit, bool all = false) {
    constexpr std::pair<std::size_t, std::size_t> none;
    state_ += name + "\n" +
              uniform_blocks({{208, 208},
                              all ? std::pair<std::size_t, std::size_t>{16384, 8592} : none,
                              all ? std::pair<std::size_t, std::size_t>{5120, 5104} : none,
                              all ? std::pair<std::size_t, std::size_t>{256, 192} : none,
                              all ? std::pair<std::size_t, std::size_t>{256, 128} : none,
                              {3000, 3000}}) +
              bound_textures(first_unit, end_unit);
  }

  scene::Scene scene_ = busy_scene();
  std::optional<Renderer> renderer_;
  ListedPictures pictures_;
  std::string state_;
};

TEST_F(PictureList, OfDirectLightIsWhatItWas) {
  const std::vector<std::string> groups = scene::light_groups(scene_);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    change_lighting(*renderer_, [&](auto& state) {
      state.group_scales.assign(groups.size(), vec3(0));
      state.group_scales[g] = vec3(1);
    });
    draw(groups[g], {.view = View::direct});
  }
  change_lighting(*renderer_, [&](auto& state) {
    state.group_scales.assign(groups.size(), vec3(1, 0.5f, 0.8f));
    state.time = 0.5f, state.environment_rotation = 0.9f;
  });
  for (const auto& [name, view] : {std::pair("lit", View::lit), std::pair("shadow", View::shadow),
                                   std::pair("albedo", View::albedo), std::pair("normal", View::normal)})
    draw(name, {.view = view});
  draw("samples", {.supersample = 2, .sky = realtime::Sky::black});
  scene_.cameras[0].orthographic = true, scene_.cameras[0].yheight = 3.5f;
  draw("orthographic", {.view = View::direct});
  list_state("all", 2, 16, true);
  // The image's seam and its upper pole
  scene_.cameras[0].orthographic = false;
  scene_.nodes[scene_.cameras[0].node].local.rotation =
      glm::quatLookAt(glm::normalize(vec3(-0.2f, 0.8f, 1)), vec3(0, 1, 0));
  draw("sky", {.view = View::direct});
  pictures_.expect("tests/realtime/expected/direct.txt");
  expect_text_of("tests/realtime/expected/direct-state.txt", state_);
}

TEST_F(PictureList, OfLookedUpLightIsWhatItWas) {
  probes::ProbeSet probes = made_up_probes(busy_places());
  for (probes::Probe& probe : probes.probes) probe.radius = 0.2f;
  const trace::PathTracer tracer(scene_);
  const probes::FittedPoints fitted = made_up_fit(scene_, probes, 120);
  renderer_->set_probes(probes);
  for (const auto& [name, weights] :
       {std::pair("distance", WeightMethod::distance), std::pair("trilinear", WeightMethod::trilinear),
        std::pair("mls", WeightMethod::mls)})
    draw(name, {.weights = weights, .view = View::indirect});
  list_state("probes", 12, 15);
  draw("as lamps", {.lookup = LookupMethod::light, .view = View::indirect});
  draw("chosen", {.weights = WeightMethod::distance, .view = View::chosen_sphl});
  renderer_->set_fitted(prepared(scene_, fitted, tracer));
  draw("fitted", {.view = View::indirect});
  list_state("fitted", 10, 11);  // the lists before it hang on rays that graze, as vct's voxels do
  draw("interpolated",
       {.indirect_scale = 3, .ambient_occlusion = true, .occlusion_radius = 0.8f, .view = View::indirect});
  change_lighting(*renderer_, [&](auto& state) {
    state.group_scales.assign(state.group_scales.size(), vec3(0));
    state.emission = {{2, probes.probes[1].self}, {4, probes.probes[3].self}};
  });
  draw("emission", {.view = View::direct});
  pictures_.expect("tests/realtime/expected/looked-up.txt");
  list_state("emission", 8, 11, true);
  expect_text_of("tests/realtime/expected/looked-up-state.txt", state_);
}

TEST_F(PictureList, OfOtherMethodsIsWhatItWas) {
  const trace::TransportScene source(scene_);
  // Embree divides by approximate reciprocals, whose last bits differ between makers of processors: a ray
  // that grazes an edge passes on one and ends on the other, and voxels are lit by rays.
  constexpr double of_processors = 5e-3;
  const std::array<std::pair<std::string, std::vector<std::string>>, 3> methods = {
      {{"vct", {"resolution=16", "bounces=1"}},
       {"vpl", {"photons=12", "check_points=0", "kind=point"}},
       {"vpl", {"photons=12", "check_points=0", "kind=sphere"}}}};
  for (const auto& [name, settings] : methods) {
    const methods::MethodEntry& entry = methods::find_method(name);
    const auto method =
        entry.make({scene_, source}, methods::MethodParameters(name, entry.parameters, settings), {});
    method->update(rays::lighting_at(source), {});
    renderer_->set_method_light(method->light_data());
    const bool voxels = name == "vct";
    const double slack = voxels ? of_processors : ListedPictures::of_drivers;
    draw(settings.back(), {.view = View::indirect}, slack);
    list_state(settings.back(), voxels ? 5 : 4, 5);
    draw(settings.back() + ", interpolated", {.indirect_scale = 2, .view = View::indirect}, slack);
  }
  pictures_.expect("tests/realtime/expected/methods.txt");
  expect_text_of("tests/realtime/expected/methods-state.txt", state_);
}

}  // namespace
}  // namespace ssphh::test
