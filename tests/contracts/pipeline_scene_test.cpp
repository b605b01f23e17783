/// Contracts of libs/pipeline: scenes, their light, and methods made for them.

#include <ssphh/pipeline/live_method.h>
#include <ssphh/pipeline/relit.h>
#include <ssphh/pipeline/scene_options.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/pipeline/surface_light.h>
#include <ssphh/trace/path_tracer.h>

#include "contract.h"
#include "kept_scene.h"
#include "probe_sets.h"
#include "spoilt_scenes.h"

namespace ssphh::test {
namespace {

Contract refuses_scene(const std::string& given, std::function<void(pipeline::SceneOptions&)> spoil,
                       std::vector<std::string> words) {
  return refuses(
      "LoadScene", given,
      [spoil] {
        pipeline::SceneOptions options;
        options.source = "builtin:cornell";
        spoil(options);
        pipeline::load_lit_scene(options);
      },
      std::move(words));
}

Contract refuses_sky(const std::string& given, std::function<void(pipeline::SkyOptions&)> spoil,
                     std::vector<std::string> words) {
  return refuses_scene(
      given,
      [spoil](pipeline::SceneOptions& options) {
        options.sky.model = scene::SkyModel::preetham;
        spoil(options.sky);
      },
      std::move(words));
}

transport::RelightSession session_of(const trace::TransportScene& source) {
  transport::RelightParams params;
  params.transport = {.directions = 32, .surfel_size = 0.5f, .link_rays = 8, .samples = 2};
  params.degree = 2;
  return transport::RelightSession(source, std::vector<scene::ProbePlace>{{"a", vec3(0, 1, 0)}}, params, 0);
}

std::vector<Contract> of_loaded_scenes() {
  return {
      refuses_scene("OfNoFile", [](auto& o) { o.source = ""; }, {"cannot open"}),
      refuses_scene("ThatIsNotBuiltIn", [](auto& o) { o.source = "builtin:"; }, {"builtin"}),
      refuses_scene("OfModesThatAreNone", [](auto& o) { o.light_modes = {"="}; }, {"--light-mode"}),
      refuses_scene("AtNoTime", [](auto& o) { o.time = nan; }, {"time"}),
      refuses_scene("OfALengthThatIsNone", [](auto& o) { o.unit = "ell"; }, {"ell"}),
      refuses_sky("UnderASunNowhere", [](auto& sky) { sky.elevation = nan; }, {"sun"}),
      refuses_sky("UnderASunAllRound", [](auto& sky) { sky.azimuth = infinity; }, {"sun"}),
      refuses_sky("InHazeThatIsNone", [](auto& sky) { sky.turbidity = nan; }, {"turbidity"}),
      refuses_sky("UnderASkyThatIsNone", [](auto& sky) { sky.model = static_cast<scene::SkyModel>(9); },
                  {"sky"}),
      refuses_sky("WithNorthNowhere",
                  [](auto& sky) {
                    sky.model.reset();
                    sky.date = "2026-06-21", sky.time_of_day = "12:00", sky.place = "48.1,11.6";
                    sky.north = nan;
                  },
                  {"north"}),
      refuses_sky("WithClocksThatAreNone",
                  [](auto& sky) {
                    sky.model.reset();
                    sky.date = "2026-06-21", sky.time_of_day = "12:00", sky.place = "48.1,11.6";
                    sky.utc_offset = nan;
                  },
                  {"UTC offset"}),
      refuses("ReadLightMode", "OfNoText", [] { pipeline::read_light_mode(""); }, {"GROUP=MODE"}),
      refuses("Aimed", "Nowhere", [] { pipeline::aimed(scene::LightType::spot, mat4(1), vec3(0)); },
              {"direction"}),
      refuses("Aimed", "AtNoNumber", [] { pipeline::aimed(scene::LightType::disc, mat4(1), vec3(nan)); },
              {"direction"}),
      refuses("BakedSession", "OfOtherGroups",
              [] {
                const trace::TransportScene source(kept_scene());
                pipeline::baked_session(session_of(source), kept_scene(), {}, probes::LightOperator::surfel);
              },
              {"light group"}),
      refuses("BakedSession", "OfAnOperatorThatIsNone",
              [] {
                const trace::TransportScene source(kept_scene());
                transport::RelightSession session = session_of(source);
                session.update(session.lighting());
                pipeline::baked_session(session, kept_scene(), {"lamp"},
                                        static_cast<probes::LightOperator>(9));
              },
              {"operator"}),
      refuses("ReadProbesOf", "NoFile", [] { pipeline::read_probes_of(kept_scene(), "", {}, false); },
              {"probe file"}),
      refuses("RequireSameScene", "OfAnother",
              [] { pipeline::require_same_scene("x.sphl", sound_set(), kept_scene(), {}, {}, false); },
              {"x.sphl", "another scene"}),
      gives("Viewpoints", "OfNothing",
            [] {
              static const scene::Scene empty;
              const trace::TransportScene source(empty);
              EXPECT_EQ(pipeline::viewpoints(empty, source, {}, 0).size(), 1u);
            }),
  };
}

std::vector<Contract> of_methods() {
  return {
      refuses("LiveMethod", "OfNoName",
              [] { pipeline::LiveMethod("", {}, kept_geometry(), kept_scene(), {}); }, {"method"}),
      refuses("LiveMethod", "WithoutGeometry",
              [] { pipeline::LiveMethod("ambient", {}, {}, kept_scene(), {}); }, {"geometry"}),
      gives("LiveMethod", "ThatIsCopiedOrMoved",
            [] {
              EXPECT_FALSE(std::is_move_constructible_v<pipeline::LiveMethod>)
                  << "its method looks at its source where it stands";
              EXPECT_FALSE(
                  (std::is_constructible_v<pipeline::LiveMethod, std::string, std::vector<std::string>,
                                           trace::SharedGeometry, const scene::Scene, Control>))
                  << "the scene would be gone";
            }),
      gives("LiveMethod", "ALightingOfAnotherScene",
            [] {
              pipeline::LiveMethod live("ambient", {}, kept_geometry(), kept_scene(), {});
              scene::LightingState state;
              expect_refusal([&] { live.update(state, {}); }, {"light"});
              live.update(rays::lighting_at(live.source(), 0), {});
            }),
      refuses("SurfaceLight", "OfNoProbes",
              [] {
                const trace::TransportScene source(kept_scene());
                const trace::PathTracer tracer(kept_scene());
                pipeline::SurfaceLight(source, tracer, {}, {}, 0);
              },
              {"probe"}),
      refuses("SurfaceLight", "OfNoSamples",
              [] {
                const trace::TransportScene source(kept_scene());
                const trace::PathTracer tracer(kept_scene());
                pipeline::SurfaceLight(source, tracer, sound_set(), {}, 0).direct({}, 0);
              },
              {"1 sample"}),
      refuses("SurfaceLight", "AtNoTime",
              [] {
                const trace::TransportScene source(kept_scene());
                const trace::PathTracer tracer(kept_scene());
                pipeline::SurfaceLight(source, tracer, sound_set(), {}, nan);
              },
              {"time"}),
      gives("SurfaceLight", "ThatWasMoved",
            [] {
              const trace::TransportScene source(kept_scene());
              const trace::PathTracer tracer(kept_scene());
              pipeline::SurfaceLight first(source, tracer, sound_set(), {}, 0);
              const vec3 lit = first.held({});
              const pipeline::SurfaceLight second = std::move(first);
              expect_refusal([&] { first.held({}); }, {"moved from"});
              EXPECT_EQ(second.held({}), lit);
            }),
  };
}

SSPHH_CONTRACTS(PipelineScene, of_loaded_scenes());
SSPHH_CONTRACTS(PipelineMethod, of_methods());

}  // namespace
}  // namespace ssphh::test
