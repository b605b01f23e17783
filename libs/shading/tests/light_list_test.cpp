/// What the emitters of one of everything answer, number by number, as it was: which constants and branches
/// stand behind them is told by closed forms and integrals elsewhere, and bounded there more loosely.

#include <gtest/gtest.h>

#include <ssphh/shading/lights.h>
#include <ssphh/shading/mesh_view.h>

#include "busy_scene.h"
#include "number_list.h"

namespace ssphh::shading {
namespace {

using ssphh::test::NumberList;

/// Before, behind and beside the lamps; within the ball; on the way of the spot; below the panel; far off.
const std::vector<vec3> places{{-1.1f, 0.4f, 1.3f}, {1.9f, 3.3f, -0.8f}, {-0.3f, 2.2f, 0.95f},
                               {0.1f, 0.3f, 0.6f},  {0.7f, 2.7f, -0.3f}, {14, 5, -22}};
const std::vector<vec2> numbers{{0.13f, 0.71f}, {0.52f, 0.24f}, {0.87f, 0.93f}, {0.34f, 0.08f}};

void add(NumberList& list, const std::string& name, const std::optional<LightSample>& s) {
  if (!s) return list.add(name, "none");
  list.add(name, s->wi, s->distance, s->radiance, s->pdf, s->delta, s->group);
}
void add(NumberList& list, const std::string& name, const EmitterHit& hit) {
  list.add(name, hit.distance, hit.radiance, hit.pdf, hit.group);
}
void add(NumberList& list, const std::string& name, const std::optional<EmittedPhoton>& p) {
  if (!p) return list.add(name, "none");
  list.add(name, p->photon.origin, p->photon.direction, p->photon.power, p->photon.range, p->normal);
}

/// sample(), and the densities of what rays from a place find.
void add_choices(NumberList& list, const scene::Scene& scene, const LightSet& lights) {
  for (const vec3& x : places) {
    for (int i = 0; i < lights.sample_count(); ++i) {
      for (const float choice : {0.03f, 0.17f, 0.31f, 0.44f, 0.58f, 0.69f, 0.77f, 0.86f, 0.98f})
        add(list, "sample", lights.sample(i, x, choice, numbers[1]));
    }
    for (int i = 0; i < static_cast<int>(scene.instances.size()); ++i) {
      for (const std::uint32_t triangle : {0u, 1u}) {
        const float pdf = lights.pdf_triangle(x, i, triangle, 1.7f, 0.6f);
        if (pdf > 0) list.add("triangle", i, triangle, pdf);
      }
    }
    for (const vec3& aim : {vec3(-0.4f, 2.3f, 0.9f), vec3(-0.3f, 2.45f, 1)})
      lights.intersect_lamps(x, glm::normalize(aim - x), 9,
                             [&](const EmitterHit& h) { add(list, "ball", h); });
  }
}

void add_emitters(NumberList& list, const LightSet& lights) {
  for (int i = 0; i < lights.emitter_count(); ++i) {
    const Emitter e = lights.emitter(i);
    list.add("emitter", e.kind, e.group, e.extent.min, e.extent.max, e.delta(), e.distant(),
             lights.flux(i, 2.5f));
    for (const vec2& u : numbers) {
      for (std::size_t p = 0; p < 4; ++p) add(list, " sample", lights.sample_emitter(i, places[p], u));
      add(list, " photon", lights.emit(i, u, {u.y, 1 - u.x}, {0.2f, 1, -0.3f}, 2.5f));
    }
    for (const vec3& d :
         {vec3(0.5f, 0.8f, 0.7f), vec3(-0.6f, 0.9f, 0.4f), vec3(-0.15f, 0.9f, 0.57f), vec3(1, -2, 0.3f)}) {
      if (!e.distant()) continue;
      const auto hit = lights.distant_radiance(i, glm::normalize(d));
      hit ? add(list, " along", *hit) : list.add(" along", "none");
    }
    for (std::size_t p = 0; p < 4; ++p) {
      const auto view = lights.view_mesh(i, places[p], glm::normalize(vec3(0.2f, 1, -0.4f)));
      if (!view) continue;
      list.add(" view", view->irradiance());
      for (const vec2& u : numbers) add(list, "  sample", view->sample(u));
    }
  }
}

TEST(LightList, OfOneOfEverythingIsWhatItWas) {
  const scene::Scene scene = ssphh::test::busy_scene();
  const LightSet lights(scene, scene::world_matrices(scene));
  NumberList list;
  for (int i = 0; i < static_cast<int>(scene.instances.size()); ++i)
    list.add("instance", lights.instance_group(i));
  add_emitters(list, lights);
  add_choices(list, scene, lights);
  lights.escaped(glm::normalize(vec3(-0.6f, 0.9f, 0.4f)),
                 [&](const EmitterHit& h) { add(list, "escaped", h); });
  list.expect("libs/shading/tests/expected/lights.txt");
}

TEST(LightList, OfLampsThatWereChangedMovedAndTurnedIsWhatItWas) {
  scene::Scene scene = ssphh::test::busy_scene();
  scene.nodes[scene.instances[4].node].movable = true;
  const LightSet before(scene, scene::world_matrices(scene));
  std::vector<mat4> world = scene::world_matrices(scene);
  world[scene.instances[4].node][3] += vec4(0.3f, -0.2f, 0.5f, 0);
  std::vector<scene::LightState> states = scene::lighting_at(scene).lights;
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].world[3] += vec4(0.1f * static_cast<float>(i), 0.2f, -0.1f, 0);
    states[i].color = {0.5f, 0.2f + 0.1f * static_cast<float>(i), 0.8f}, states[i].intensity *= 1.5f;
  }
  states[0].intensity = 0;
  const LightSet lights(before, world, states, 1.3f);
  NumberList list;
  add_emitters(list, lights);
  add_choices(list, scene, lights);
  list.expect("libs/shading/tests/expected/lights-changed.txt");
}

TEST(LightList, OfMoreLampsThanAreWeighedAtEachPointIsWhatItWas) {
  scene::Scene scene = ssphh::test::busy_scene();
  scene.environment.reset();
  for (int i = 0; i < 14; ++i) {
    const auto at = static_cast<float>(i);
    ssphh::test::add_busy_lamp(scene, fmt::format("more {}", i).c_str(),
                               i % 3 == 0 ? scene::LightType::sphere : scene::LightType::point,
                               {0.3f * at - 2, 2.5f, 0.1f * at}, {0, -1, 0}, {1, 0.1f * at, 0.5f}, 1 + at);
    scene.lights.back().radius = 0.05f + 0.01f * at;
  }
  const LightSet lights(scene, scene::world_matrices(scene));
  NumberList list;
  add_choices(list, scene, lights);
  list.expect("libs/shading/tests/expected/lights-many.txt");
}

}  // namespace
}  // namespace ssphh::shading
