/// Contracts of libs/shading and libs/trace.

#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/shading/lights.h>
#include <ssphh/shading/mesh_view.h>
#include <ssphh/study/default_view.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "contract.h"
#include "spoilt_scenes.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

using trace::RenderState;

const scene::Scene& the_scene() {
  static const scene::Scene scene = sound_scene();
  return scene;
}

/// A traced scene.
struct Traced {
  trace::PathTracer tracer{the_scene()};
  trace::TransportScene transport{the_scene()};
  std::vector<mat4> poses() const {
    std::vector<mat4> poses;
    for (int part = 0; part < transport.part_count(); ++part) poses.push_back(transport.part_pose(part, 0));
    return poses;
  }
  std::unique_ptr<rays::DirectLight> light() const {
    return transport.direct_light(transport.lights(0), poses());
  }
};

std::unique_ptr<Traced> traced() {
  return std::make_unique<Traced>();
}

/// It still sees the floor.
void sees(Traced& t) {
  EXPECT_FALSE(t.tracer.visible({0.1f, 1, 0.2f}, {0.1f, -1, 0.2f}));
}

Contract refuses_tracing(const std::string& entry, const std::string& given,
                         std::function<void(Traced&)> call, std::vector<std::string> words) {
  return refuses(entry, given, traced, std::move(call), std::move(words), sees);
}

trace::RenderParams small_picture() {
  trace::RenderParams params;
  params.width = 4, params.height = 3;
  params.path.spp = 1;
  params.camera = scene::camera_pose(the_scene(), "");
  return params;
}

void render(Traced& t, const std::function<void(trace::RenderParams&)>& spoil) {
  trace::RenderParams params = small_picture();
  spoil(params);
  RenderState state;
  t.tracer.render(params, state);
}

std::vector<Contract> of_light_sets() {
  const auto set = [] {
    return std::make_unique<shading::LightSet>(the_scene(), scene::world_matrices(the_scene()));
  };
  const auto has_lamp = [](shading::LightSet& lights) { EXPECT_EQ(lights.emitter(0).group, 0); };
  const auto with = [&](const std::string& given, std::function<void(shading::LightSet&)> call,
                        std::vector<std::string> words) {
    return refuses("LightSet", given, set, std::move(call), std::move(words), has_lamp);
  };
  return {
      with("EmitterThatIsNotThere", [](auto& l) { l.emitter(1); }, {"light set", "emitter"}),
      with("EmitterMinusOne", [](auto& l) { l.emitter(-1); }, {"emitter"}),
      with("SampleOfNoEmitter", [](auto& l) { l.sample_emitter(7, vec3(0), vec2(0.5f)); }, {"emitter"}),
      with("FluxOfNoEmitter", [](auto& l) { l.flux(7, 1); }, {"emitter"}),
      with("PhotonOfNoEmitter", [](auto& l) { l.emit(7, vec2(0), vec2(0), vec3(0), 1); }, {"emitter"}),
      with("ViewOfNoEmitter", [](auto& l) { l.view_mesh(7, vec3(0), vec3(0, 1, 0)); }, {"emitter"}),
      with("DistantRadianceOfALamp", [](auto& l) { l.distant_radiance(0, vec3(0, 1, 0)); }, {"not distant"}),
      with("GroupOfNoInstance", [](auto& l) { l.instance_group(1); }, {"instance"}),
      with("DensityOfNoInstance", [](auto& l) { l.pdf_triangle(vec3(0), -1, 0, 1, 1); }, {"instance"}),
      with("WithOtherLights", [](auto& l) { shading::LightSet(l, scene::world_matrices(the_scene()), {}); },
           {"each light"}),
      with("WithoutMatrices", [](auto& l) { shading::LightSet(l, {}, std::vector<scene::LightState>(1)); },
           {"each node"}),
      refuses("LightSet", "OfASceneWithoutMatrices", [] { shading::LightSet(the_scene(), {}); },
              {"each node"}),
      refuses("MeshView", "OfTooManyTriangles",
              [] {
                shading::MeshView view(vec3(0), vec3(0, 1, 0), vec3(1), 0);
                for (std::size_t i = 0; i < 2 * shading::MeshView::max_triangles; ++i)
                  view.add({0, 1, 0}, {0, 1, 1}, {1, 1, 0});
              },
              {"too many triangles"}),
  };
}

std::vector<Contract> of_tracers() {
  std::vector<Contract> rows = {
      refuses_tracing("Render", "WithoutPixels", [](Traced& t) { render(t, [](auto& p) { p.width = 0; }); },
                      {"render size"}),
      refuses_tracing("Render", "OfATileOutside",
                      [](Traced& t) { render(t, [](auto& p) {
                                        p.tile = {3, 0, 2, 1};
                                      }); }, {"tile"}),
      refuses_tracing("Render", "WithoutSamples",
                      [](Traced& t) { render(t, [](auto& p) { p.path.spp = 0; }); }, {"spp"}),
      refuses_tracing("Render", "OfANegativeDepth",
                      [](Traced& t) { render(t, [](auto& p) { p.path.max_depth = -1; }); }, {"depth"}),
      refuses_tracing("Render", "IntoAStateOfAnotherSize",
                      [](Traced& t) {
                        RenderState state = trace::empty_state(small_picture(), 1);
                        state.depth = image::Image(1, 1, 1);
                        t.tracer.render(small_picture(), state);
                      },
                      {"render state"}),
      refuses_tracing("IncidentRadiance", "OfNoFaces",
                      [](Traced& t) {
                        t.tracer.incident_radiance({vec3(0), 0, {}}, {});
                      },
                      {"face size"}),
      refuses_tracing("IncidentRadiance", "AtNoPlace",
                      [](Traced& t) {
                        t.tracer.incident_radiance({vec3(nan), 2, {}}, {});
                      },
                      {"position"}),
      refuses_tracing("GhostRadiance", "OfASphereThatIsNone",
                      [](Traced& t) {
                        const rays::GhostSphere ghost{vec3(0), nan};
                        t.tracer.ghost_radiance({vec3(0), 2, {}}, {&ghost, 1}, nullptr, {});
                      },
                      {"ghost sphere"}),
      refuses_tracing("SurfaceIrradiance", "WithoutSamples",
                      [](Traced& t) { t.tracer.surface_irradiance({}, {.spp = 0}, {}); }, {"spp"}),
      refuses_tracing("PartName", "OfNoPart", [](Traced& t) { t.transport.part_name(99); }, {"part"}),
      refuses_tracing("PartBounds", "OfPartMinusOne", [](Traced& t) { t.transport.part_bounds(-1); },
                      {"part"}),
      refuses_tracing("PartPose", "OfNoPart", [](Traced& t) { t.transport.part_pose(99, 0); }, {"part"}),
      refuses_tracing("SamplePart", "OfNoPart", [](Traced& t) { t.transport.sample_part(99, 1); }, {"part"}),
      refuses_tracing("SamplePart", "AtADensityThatIsNoNumber",
                      [](Traced& t) { t.transport.sample_part(1, double(nan)); },
                      {"points per square metre"}),
      refuses_tracing("Intersect", "WithOtherHits",
                      [](Traced& t) {
                        std::vector<rays::RayHit> hits(1);
                        t.transport.intersect(0, std::vector<rays::RayQuery>(2), hits);
                      },
                      {"rays", "each"}),
      refuses_tracing("Occluded", "OfNoPart", [](Traced& t) { t.transport.occluded(99, {}, {}); }, {"part"}),
      refuses_tracing("Occluded", "WithOtherAnswers",
                      [](Traced& t) { t.transport.occluded(0, std::vector<rays::RayQuery>(2), {}); },
                      {"rays", "each"}),
      refuses_tracing("LightGroupOf", "NoLight", [](Traced& t) { t.transport.light_group_of(1); }, {"light"}),
      refuses_tracing("GroupEmitsFrom", "NoPart", [](Traced& t) { t.transport.group_emits_from(0, 99); },
                      {"part"}),
      gives("GroupEmitsFrom", "NoGroup", [] { EXPECT_FALSE(traced()->transport.group_emits_from(9, 0)); }),
      refuses_tracing("DirectLight", "OfOtherLights",
                      [](Traced& t) { t.transport.direct_light({}, t.poses()); }, {"each light"}),
      refuses_tracing("DirectLight", "OfOtherPoses",
                      [](Traced& t) { t.transport.direct_light(t.transport.lights(0), {}); }, {"each part"}),
      refuses_tracing("DirectIrradiance", "OfNoGroup", [](Traced& t) { t.light()->irradiance(9, {}, {}); },
                      {"light group"}),
      refuses_tracing("DirectIrradiance", "IntoOtherValues",
                      [](Traced& t) { t.light()->irradiance(0, std::vector<rays::SurfacePoint>(2), {}); },
                      {"each point"}),
      refuses_tracing("DirectFlux", "OfNoGroup", [](Traced& t) { t.light()->flux(-1); }, {"light group"}),
      gives("DirectEmitted", "OfNoGroup", [] { EXPECT_EQ(traced()->light()->emitted(9, {}, 1), vec3(0)); }),
      refuses_tracing("DirectMayShadow", "OfNoGroup",
                      [](Traced& t) {
                        t.light()->may_shadow(9, {}, {vec3(-1), vec3(1)});
                      },
                      {"light group"}),
      refuses("PathTracer", "OfNoGeometry", [] { trace::PathTracer(nullptr, the_scene()); },
              {"scene geometry", "none"}),
      refuses("PathTracer", "OfAnotherScenesGeometry",
              [] { trace::PathTracer(trace::geometry_of(std::make_shared<scene::Scene>()), the_scene()); },
              {"scene geometry", "other surfaces"}),
      refuses("TransportScene", "OfNoGeometry", [] { trace::TransportScene(nullptr, the_scene()); },
              {"scene geometry", "none"}),
      refuses(
          "TransportScene", "OfAnotherScenesGeometry",
          [] { trace::TransportScene(trace::geometry_of(std::make_shared<scene::Scene>()), the_scene()); },
          {"scene geometry", "other surfaces"}),
      refuses("GeometryOf", "NoScene", [] { trace::geometry_of(nullptr); }, {"scene geometry", "no scene"}),
      refuses_tracing("DefaultView", "OfAMeshThatIsNotThere",
                      [](Traced& t) {
                        scene::Scene scene = sound_scene();
                        scene.instances[0].mesh = 9;
                        study::default_view(scene, t.transport);
                      },
                      {"instance 0", "mesh 9"}),
      refuses_tracing("PosedWorld", "OfTooFewPoses",
                      [](Traced& t) { rays::PosedWorld(t.transport, std::vector<mat4>{}); },
                      {"posed world", "each part"}),
      refuses("PathTracer", "AtNoTime", [] { trace::PathTracer(the_scene(), nan); }, {"time"}),
      refuses("TransportScene", "OfOptionsThatAreNone",
              [] { trace::TransportScene(the_scene(), {.light_samples = 0}); }, {"light"}),
      refuses("Paste", "OfATileOutside",
              [] {
                RenderState whole = trace::empty_state(small_picture(), 1);
                trace::RenderParams params = small_picture();
                params.tile = {0, 0, 2, 2};
                trace::paste(whole, trace::empty_state(params, 1), {3, 0, 2, 2});
              },
              {"tile", "inside"}),
      refuses("Paste", "OfATileOfAnotherSize",
              [] {
                RenderState whole = trace::empty_state(small_picture(), 1);
                trace::paste(whole, trace::empty_state(small_picture(), 1), {0, 0, 2, 2});
              },
              {"tile", "size"}),
      refuses("Paste", "OfOtherImages",
              [] {
                RenderState whole = trace::empty_state(small_picture(), 1), part = whole;
                part.groups.emplace_back(4, 3);
                trace::paste(whole, part, {0, 0, 4, 3});
              },
              {"different images"}),
      refuses("SaveState", "OfUnevenImages",
              [] {
                const TempDir dir;
                RenderState state = trace::empty_state(small_picture(), 1);
                state.normal = image::Image(1, 1);
                trace::save_state(state, dir.path() / "x.state");
              },
              {"render state"}),
      gives("PathTracer", "AskedOfNoPlace",
            [] {
              const trace::PathTracer tracer(the_scene());
              EXPECT_EQ(tracer.backface_fraction(vec3(nan)), 0);
              EXPECT_EQ(tracer.backface_fraction(vec3(1e30f, 0, 0)), 0);
              EXPECT_TRUE(tracer.visible(vec3(0, -1, 0), vec3(nan)));
            }),
      refuses("LoadState", "ThatIsNotThere", [] { trace::load_state("/nowhere/x.state", {}); }, {"/nowhere"}),
  };
  for (const SpoiltScene& s : spoilt_scenes()) {
    const auto refuses_scene = [&](const char* entry, std::function<void(const scene::Scene&)> make) {
      rows.push_back({entry, s.name, [=] {
                        const scene::Scene scene = s.make();
                        expect_refusal([&] { make(scene); }, s.words);
                      }});
    };
    refuses_scene("SceneGeometry", [](const scene::Scene& scene) { trace::SceneGeometry geometry(scene); });
    refuses_scene("PathTracer", [](const scene::Scene& scene) { trace::PathTracer tracer(scene); });
    refuses_scene("TransportScene", [](const scene::Scene& scene) { trace::TransportScene source(scene); });
  }
  return rows;
}

SSPHH_CONTRACTS(LightSet, of_light_sets());
SSPHH_CONTRACTS(Tracer, of_tracers());

}  // namespace
}  // namespace ssphh::test
