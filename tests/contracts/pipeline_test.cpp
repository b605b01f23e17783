/// Contracts of libs/pipeline.

#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/draw_marks.h>
#include <ssphh/pipeline/exposure.h>
#include <ssphh/pipeline/live_method.h>
#include <ssphh/pipeline/relit.h>
#include <ssphh/pipeline/render_scene.h>
#include <ssphh/pipeline/scene_options.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/pipeline/surface_light.h>
#include <ssphh/trace/path_tracer.h>

#include "contract.h"
#include "probe_sets.h"
#include "spoilt_scenes.h"

namespace ssphh::test {
namespace {

using pipeline::BakeSettings;

/// As long as what refers to it.
const scene::Scene& the_scene() {
  static const scene::Scene scene = sound_scene();
  return scene;
}

trace::SharedGeometry the_geometry() {
  static const auto geometry = std::make_shared<const trace::SceneGeometry>(the_scene());
  return geometry;
}

/// Settings with which a bake takes milliseconds.
BakeSettings quick() {
  BakeSettings settings;
  settings.op = probes::LightOperator::surfel;
  settings.viz = probes::VizMethod::none;
  settings.degree = 2;
  settings.records = 0;
  settings.transport.transport = {.directions = 32, .surfel_size = 0.5f, .link_rays = 8, .samples = 2};
  return settings;
}

Contract refuses_bake(const std::string& given, std::function<void(BakeSettings&)> spoil,
                      std::vector<std::string> words) {
  return refuses(
      "BakeScene", given,
      [spoil] {
        BakeSettings settings = quick();
        spoil(settings);
        pipeline::bake_scene(the_geometry(), the_scene(), 0, {}, settings, {});
      },
      std::move(words));
}

Contract refuses_places(const std::string& given, std::function<void(pipeline::PlaceOptions&)> spoil,
                        std::vector<std::string> words) {
  return refuses(
      "PlaceFor", given,
      [spoil] {
        pipeline::PlaceOptions options;
        options.probes = "4";
        spoil(options);
        pipeline::place_for(the_geometry(), the_scene(), 0, options, "", {});
      },
      std::move(words));
}

std::vector<Contract> of_bakes() {
  return {
      gives("BakeScene", "AsItShouldBe",
            [] {
              EXPECT_EQ(
                  pipeline::bake_scene(the_geometry(), the_scene(), 0, {}, quick(), {}).set.probes.size(),
                  1u);
            }),
      refuses("BakeScene", "WithoutGeometry",
              [] { pipeline::bake_scene({}, the_scene(), 0, {}, quick(), {}); }, {"geometry"}),
      refuses("BakeScene", "AtNoTime",
              [] { pipeline::bake_scene(the_geometry(), the_scene(), nan, {}, quick(), {}); }, {"time"}),
      refuses("BakeScene", "WithTheGeometryOfAnother",
              [] {
                const scene::Scene other;
                pipeline::bake_scene(std::make_shared<const trace::SceneGeometry>(other), the_scene(), 0, {},
                                     quick(), {});
              },
              {"geometry"}),
      refuses_bake("OfDegreeMinusOne", [](BakeSettings& s) { s.degree = -1; }, {"degree"}),
      refuses_bake("OfDegreeEleven", [](BakeSettings& s) { s.degree = 11; }, {"degree"}),
      refuses_bake("OfMinusOneRecords", [](BakeSettings& s) { s.records = -1; }, {"records"}),
      refuses_bake("OfTooManyRecords", [](BakeSettings& s) { s.records = 1 << 17; }, {"records"}),
      refuses_bake("OfAnOperatorThatIsNone",
                   [](BakeSettings& s) { s.op = static_cast<probes::LightOperator>(9); }, {"operator"}),
      refuses_bake("OfAVizThatIsNone", [](BakeSettings& s) { s.viz = static_cast<probes::VizMethod>(9); },
                   {"VIZ method"}),
      refuses_bake("OfAVizSourceThatIsNone",
                   [](BakeSettings& s) {
                     s.viz = probes::VizMethod::links;
                     s.viz_source = static_cast<probes::VizSource>(9);
                   },
                   {"source"}),
      refuses_bake("OfNoMemory", [](BakeSettings& s) { s.max_memory = double(nan); }, {"memory"}),
      refuses_bake("OfNegativeMemory", [](BakeSettings& s) { s.max_memory = -1; }, {"memory"}),
      refuses_bake("OfAThresholdThatIsNone",
                   [](BakeSettings& s) {
                     s.viz = probes::VizMethod::links;
                     s.threshold = nan;
                   },
                   {"threshold"}),
      refuses_bake("OfANegativeThreshold",
                   [](BakeSettings& s) {
                     s.viz = probes::VizMethod::links;
                     s.threshold = -0.5f;
                   },
                   {"threshold"}),
      refuses_bake("OfMinusTwoNeighbors",
                   [](BakeSettings& s) {
                     s.viz = probes::VizMethod::links;
                     s.neighbors = -2;
                   },
                   {"neighbours"}),
      refuses_bake("OfPathsOfNoSamples",
                   [](BakeSettings& s) {
                     s.op = probes::LightOperator::path;
                     s.params.path.spp = 0;
                   },
                   {"spp"}),
      refuses_bake("OfVizOfMinusOnePasses",
                   [](BakeSettings& s) {
                     s.viz = probes::VizMethod::path;
                     s.viz_passes = -1;
                   },
                   {"passes"}),
      refuses(
          "BakeSurfaces", "OfAQualityThatIsNone",
          [] { pipeline::bake_surfaces(the_geometry(), the_scene(), 0, static_cast<bake::Quality>(9), 0); },
          {"quality"}),
      refuses_places("OfNoWord", [](auto& o) { o.probes = "many"; }, {"--probes", "many"}),
      refuses_places("OfNoSpacing", [](auto& o) { o.probes = "auto:nan"; }, {"--probes", "nan"}),
      refuses_places("OfAnEndlessSpacing", [](auto& o) { o.probes = "auto:inf"; }, {"inf"}),
      refuses_places("OfAClearanceThatIsNone", [](auto& o) { o.clearance = nan; }, {"clearance"}),
      refuses_places("OfMinusOneLevels", [](auto& o) { o.levels = -1; }, {"levels"}),
      refuses_places("OfNoProbes", [](auto& o) { o.max_probes = 0; }, {"probes"}),
      refuses("PlaceFor", "WithoutGeometry",
              [] { pipeline::place_for({}, the_scene(), 0, {.probes = "4"}, "", {}); }, {"geometry"}),
      refuses("PlaceFor", "AtNoTime",
              [] { pipeline::place_for(the_geometry(), the_scene(), nan, {.probes = "4"}, "", {}); },
              {"time"}),
  };
}

/// A small picture and what makes it.
struct Picture {
  trace::RenderParams params;
  trace::RenderState state;
  pipeline::LightFinder finder;
  probes::ProbeSet set = sound_set();

  Picture() {
    params.width = 4, params.height = 3;
    params.path.spp = 1;
    params.camera = scene::camera_pose(the_scene(), "");
  }
  void render(float time = 0) {
    pipeline::render_scene(the_geometry(), the_scene(), time, finder, params, state);
  }
};

Contract refuses_picture(const std::string& given, std::function<void(Picture&)> spoil,
                         std::vector<std::string> words) {
  return refuses(
      "RenderScene", given,
      [spoil] {
        Picture picture;
        spoil(picture);
        picture.render();
      },
      std::move(words));
}

std::vector<Contract> of_pictures() {
  return {
      gives("RenderScene", "AsItShouldBe",
            [] {
              Picture picture;
              picture.render();
              EXPECT_EQ(picture.state.passes_done, picture.params.path.passes);
            }),
      refuses("RenderScene", "WithoutGeometry",
              [] {
                Picture p;
                pipeline::render_scene({}, the_scene(), 0, p.finder, p.params, p.state);
              },
              {"geometry"}),
      refuses("RenderScene", "AtNoTime", [] { Picture().render(nan); }, {"time"}),
      refuses_picture("OfNoPixels", [](Picture& p) { p.params.width = 0; }, {"render size"}),
      refuses_picture("OfNoMethod", [](Picture& p) { p.finder.method = ""; }, {"method"}),
      refuses_picture("OfAParameterOfPaths", [](Picture& p) { p.finder.parameters = {"a=1"}; }, {"--param"}),
      refuses_picture("OfAParameterThatIsNone",
                      [](Picture& p) {
                        p.finder.method = "ambient";
                        p.finder.parameters = {"no parameter"};
                      },
                      {"no parameter"}),
      refuses_picture("LitByNoProbes",
                      [](Picture& p) {
                        p.set.probes.clear();
                        p.finder.method = "ssphh", p.finder.probes = &p.set;
                      },
                      {"probe"}),
      refuses_picture("LitByFittedProbesThatAreNone",
                      [](Picture& p) {
                        p.finder.method = "ssphh", p.finder.probes = &p.set;
                        p.finder.lookup.weights = probes::WeightMethod::fitted;
                      },
                      {"fitted"}),
      refuses_picture("ByALookupThatIsNone",
                      [](Picture& p) {
                        p.finder.method = "ssphh", p.finder.probes = &p.set;
                        p.finder.lookup.method = static_cast<probes::LookupMethod>(9);
                      },
                      {"lookup"}),
      refuses_picture("ByWeightsThatAreNone",
                      [](Picture& p) {
                        p.finder.method = "ssphh", p.finder.probes = &p.set;
                        p.finder.lookup.weights = static_cast<probes::WeightMethod>(99);
                      },
                      {"weights"}),
      refuses("RenderScene", "OnTopOfAnother",
              [] {
                Picture p;
                p.render();
                p.params.width = 5;
                p.render();
              },
              {"render"}),
      refuses("CameraOf", "ANameThatIsNot", [] { pipeline::camera_of(the_scene(), "back", 0); }, {"back"}),
      refuses("CameraOf", "NoTime", [] { pipeline::camera_of(the_scene(), "", nan); }, {"time"}),
      gives("ProjectionOf", "ANumberThatIsNone",
            [] {
              EXPECT_EQ(pipeline::projection_of(static_cast<pipeline::PictureProjection>(9), {}),
                        trace::Projection::pinhole);
            }),
      refuses("DrawMarks", "OverNoPicture",
              [] {
                image::Image none;
                pipeline::draw_marks(none, {}, the_geometry(), the_scene(), 0, Picture().params, 1);
              },
              {"picture", "size"}),
      refuses("DrawMarks", "OverAPictureOfAnotherSize",
              [] {
                image::Image picture(9, 9);
                pipeline::draw_marks(picture, {}, the_geometry(), the_scene(), 0, Picture().params, 1);
              },
              {"picture", "size"}),
      refuses("DrawMarks", "InNoWhite",
              [] {
                image::Image picture(4, 3);
                pipeline::draw_marks(picture, {}, the_geometry(), the_scene(), 0, Picture().params, nan);
              },
              {"white"}),
      refuses("DrawMarks", "WithoutGeometry",
              [] {
                image::Image picture(4, 3);
                pipeline::draw_marks(picture, {}, {}, the_scene(), 0, Picture().params, 1);
              },
              {"geometry"}),
      refuses("SuitableExposure", "OfNoPicture", [] { pipeline::suitable_exposure(image::Image()); },
              {"exposure", "empty"}),
      gives("SuitableExposure", "OfNoNumbers",
            [] {
              image::Image none(400, 300);
              std::ranges::fill(none.pixels, nan);
              EXPECT_TRUE(std::isfinite(pipeline::suitable_exposure(none)));
            }),
  };
}

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

std::vector<Contract> of_scenes() {
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
      refuses("Aimed", "Nowhere", [] { pipeline::aimed(mat4(1), vec3(0)); }, {"direction"}),
      refuses("Aimed", "AtNoNumber", [] { pipeline::aimed(mat4(1), vec3(nan)); }, {"direction"}),
      refuses("BakedSession", "OfOtherGroups",
              [] {
                const trace::TransportScene source(the_scene());
                pipeline::baked_session(session_of(source), the_scene(), {}, probes::LightOperator::surfel);
              },
              {"light group"}),
      refuses("BakedSession", "OfAnOperatorThatIsNone",
              [] {
                const trace::TransportScene source(the_scene());
                transport::RelightSession session = session_of(source);
                session.update(session.lighting());
                pipeline::baked_session(session, the_scene(), {"lamp"},
                                        static_cast<probes::LightOperator>(9));
              },
              {"operator"}),
      refuses("ReadProbesOf", "NoFile", [] { pipeline::read_probes_of(the_scene(), "", {}, false); },
              {"probe file"}),
      refuses("RequireSameScene", "OfAnother",
              [] { pipeline::require_same_scene("x.sphl", sound_set(), the_scene(), {}, {}, false); },
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
      refuses("LiveMethod", "OfNoName", [] { pipeline::LiveMethod("", {}, the_geometry(), the_scene(), {}); },
              {"method"}),
      refuses("LiveMethod", "WithoutGeometry",
              [] { pipeline::LiveMethod("ambient", {}, {}, the_scene(), {}); }, {"geometry"}),
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
              pipeline::LiveMethod live("ambient", {}, the_geometry(), the_scene(), {});
              scene::LightingState state;
              expect_refusal([&] { live.update(state, {}); }, {"light"});
              live.update(rays::lighting_at(live.source(), 0), {});
            }),
      refuses("SurfaceLight", "OfNoProbes",
              [] {
                const trace::TransportScene source(the_scene());
                const trace::PathTracer tracer(the_scene());
                pipeline::SurfaceLight(source, tracer, {}, {}, 0, 1);
              },
              {"probe"}),
      refuses("SurfaceLight", "OfMinusOneSamples",
              [] {
                const trace::TransportScene source(the_scene());
                const trace::PathTracer tracer(the_scene());
                pipeline::SurfaceLight(source, tracer, sound_set(), {}, 0, -1);
              },
              {"samples"}),
      refuses("SurfaceLight", "AtNoTime",
              [] {
                const trace::TransportScene source(the_scene());
                const trace::PathTracer tracer(the_scene());
                pipeline::SurfaceLight(source, tracer, sound_set(), {}, nan, 1);
              },
              {"time"}),
      gives("SurfaceLight", "ThatWasMoved",
            [] {
              const trace::TransportScene source(the_scene());
              const trace::PathTracer tracer(the_scene());
              pipeline::SurfaceLight first(source, tracer, sound_set(), {}, 0, 1);
              const vec3 lit = first.irradiance({});
              const pipeline::SurfaceLight second = std::move(first);
              expect_refusal([&] { first.irradiance({}); }, {"moved from"});
              EXPECT_EQ(second.irradiance({}), lit);
            }),
  };
}

SSPHH_CONTRACTS(PipelineBake, of_bakes());
SSPHH_CONTRACTS(PipelinePicture, of_pictures());
SSPHH_CONTRACTS(PipelineScene, of_scenes());
SSPHH_CONTRACTS(PipelineMethod, of_methods());

}  // namespace
}  // namespace ssphh::test
