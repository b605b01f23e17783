/// What each method says of the light in a room where nothing is alike, of its memory and its figures: number
/// by number, as it was, with parameters none of which is the default.

#include <gtest/gtest.h>

#include <ssphh/methods/method_list.h>

#include "number_list.h"
#include "open_room.h"

namespace ssphh::methods {
namespace {

/// On each wall, the pillar and both sides of the shelf; and on the block, which moves.
std::vector<rays::SurfacePoint> places(const scene::Scene& room, float time) {
  const vec3 block = glm::mix(vec3(3.1f, 0.45f, 2.2f), vec3(2.2f, 0.75f, 2.9f), time);
  const vec3 shelf = glm::normalize(glm::cross(vec3(0.9f, 0.1f, 0), vec3(0, 0.08f, 0.8f)));
  std::vector<rays::SurfacePoint> all{{{0.83f, 0, 2.61f}, {0, 1, 0}},
                                      {{2.27f, 0, 0.58f}, {0, 1, 0}},
                                      {{1.41f, 1.32f, 0}, {0, 0, 1}},
                                      {{3.07f, 1.86f, 3.7f}, {0, 0, -1}},
                                      {{0, 0.71f, 1.13f}, {1, 0, 0}},
                                      {{4.3f, 0.44f, 2.87f}, {-1, 0, 0}},
                                      {{1.52f, 2.6f, 2.19f}, {0, -1, 0}},
                                      {{1.62f, 0.93f, 1.47f}, {1, 0, 0}},
                                      {{1.37f, 1.73f, 1.59f}, {0, 1, 0}},
                                      {{3.35f, 1.19f, 0.47f}, shelf},
                                      {{3.35f, 1.19f, 0.47f}, -shelf},
                                      {block + vec3(-0.31f, 0.02f, 0.05f), {-1, 0, 0}, true},
                                      {block + vec3(0.1f, 0.36f, -0.07f), {0, 1, 0}, true},
                                      {block + vec3(0.33f, 0.11f, 0.13f), {1, 0, 0}, true}};
  const quat& turn = room.nodes[0].local.rotation;
  for (rays::SurfacePoint& p : all) p.position = turn * p.position, p.normal = turn * p.normal;
  return all;
}

struct Listed {
  const char* name;
  std::vector<std::string> settings;
  bool steps = false;   ///< the block first, and then all else
  bool nobody = false;  ///< to look from: the scene says neither of SPHLs nor of lamps
};

/// Appends what the method says of the room as it is, and with one lamp moved, both dimmed, the sky turned
/// and the block on its way: at once, or step by step.
void add(ssphh::test::NumberList& list, const test::OpenRoom& room, const Listed& listed) {
  const MethodEntry& entry = find_method(listed.name);
  scene::Scene scene = room.scene();
  if (listed.nobody) scene.sphls.clear(), scene.lights.clear();
  const auto method =
      entry.make({scene, room}, MethodParameters(listed.name, entry.parameters, listed.settings), {});
  std::string name = listed.name;
  for (const std::string& setting : listed.settings) name += " " + setting;
  scene::LightingState state = rays::lighting_at(room);
  for (int frame = 0; frame < 3; ++frame) {
    if (frame > 0) state.time = 0.6f;
    if (frame == 1 && !listed.steps) continue;
    if (frame == 2) {
      state.lights[0].world[3] += vec4(0.3f, -0.4f, 0.2f, 0), state.lights[1].intensity = 1.7f;
      state.group_scales = {{0.8f, 0.5f, 0.7f}, {1.5f, 0.9f, 1.2f}, {0.4f, 0.6f, 0.3f}};
      state.environment_rotation = 0.9f;
    }
    method->update(state, {});
    list.add(name, frame, method->memory().lookup, method->memory().update);
    for (const auto& [figure, value] : method->numbers()) list.add(" " + figure, value);
    for (const rays::SurfacePoint& p : places(room.scene(), state.time)) {
      const vec3 r = glm::normalize(p.normal + vec3(0.3f, 0.2f, -0.4f));
      list.add(" at", method->light().irradiance(p), method->light().glossy(p, r, 0.45f));
    }
  }
}

void expect(const std::string& file, const std::vector<Listed>& all,
            const test::OpenRoom& room = test::OpenRoom()) {
  ssphh::test::NumberList list;
  for (const Listed& listed : all) add(list, room, listed);
  list.expect("libs/methods/tests/expected/" + file);
}

TEST(MethodList, OfTheAmbientTermIsWhatItWas) {
  expect("ambient.txt",
         {{"ambient", {"points=64", "factor=1.7"}}, {"ambient", {"points=16"}, false, true}, {"direct", {}}});
}

TEST(MethodList, OfProbesIsWhatItWas) {
  expect("probes.txt",
         {{"ssphh",
           {"places=scene", "degree=3", "weights=mls", "surfel_size=0.7", "directions=48", "warm_start=0"}},
          {"ssphh", {"probes=6", "degree=2", "weights=distance", "surfel_size=0.8", "directions=32"}},
          {"irradiance-volume", {"places=scene", "degree=3", "surfel_size=0.7", "directions=48"}},
          {"irradiance-volume",
           {"places=grid", "probes=18", "interpolation=trilinear", "degree=2", "surfel_size=0.8",
            "directions=32"}}});
}

TEST(MethodList, OfTransferIsWhatItWas) {
  const std::vector<std::string> small{"places=scene", "surfel_size=0.8", "directions=32", "rays=20"};
  std::vector<std::string> near = small, open = small;
  near.insert(near.end(), {"degree=3", "interreflect=2", "self_shadow=0.6", "edge=1.35"});
  open.insert(open.end(), {"degree=2", "environment=probes", "self_shadow=0", "edge=1.7"});
  expect("transfer.txt", {{"prt", near}, {"prt", open}});
}

TEST(MethodList, OfProbeFieldsIsWhatItWas) {
  expect(
      "ddgi.txt",
      {{"ddgi",
        {"spacing=1.2", "rays=24", "warmup=3", "hysteresis=0.8", "change=0.3", "bias=0.4", "gamma=2",
         "seed=5"}},
       {"ddgi",
        {"probes=20", "rays=16", "warmup=2", "hysteresis=0.6", "change=0", "visibility=0", "relocate=0"}}});
}

TEST(MethodList, OfVirtualLightsIsWhatItWas) {
  expect("vpl.txt",
         {{"vpl", {"photons=24", "depth=6", "clamp=0.1", "check_points=16", "seed=3"}},
          {"vpl", {"photons=30", "depth=4", "clamp=0.07", "cluster_error=0.05", "check_points=12", "seed=4"}},
          {"vpl",
           {"photons=20", "depth=5", "kind=sphere", "radius=0.7", "cluster_error=0.03", "check_points=10"}}});
}

TEST(MethodList, OfVoxelsIsWhatItWas) {
  // No wall along an axis: there the sign of a rounding decides about cells and about frames around normals.
  const test::OpenRoom room(glm::angleAxis(0.23f, glm::normalize(vec3(1, 0.7f, -0.4f))));
  expect("vct.txt",
         {{"vct",
           {"resolution=16", "bounces=3", "cones=12", "bounce_cones=6", "offset=0.8", "step=0.4",
            "opacity=1.5", "samples=3"}},
          {"vct",
           {"resolution=8", "storage=dense", "bounces=2", "cones=7", "bounce_cones=5", "samples=2"},
           true}},
         room);
}

}  // namespace
}  // namespace ssphh::methods
