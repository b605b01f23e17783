/// Contracts of libs/pipeline: bakes and pictures.

#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/draw_marks.h>
#include <ssphh/pipeline/exposure.h>
#include <ssphh/pipeline/render_scene.h>

#include "contract.h"
#include "kept_scene.h"
#include "probe_sets.h"
#include "spoilt_scenes.h"

namespace ssphh::test {
namespace {

using pipeline::BakeSettings;

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

Contract refuses_scene_bake(const std::string& given, std::function<void(BakeSettings&)> spoil,
                            std::vector<std::string> words) {
  return refuses(
      "BakeScene", given,
      [spoil] {
        BakeSettings settings = quick();
        spoil(settings);
        pipeline::bake_scene(kept_geometry(), kept_scene(), 0, {}, settings, {});
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
        pipeline::place_for(kept_geometry(), kept_scene(), 0, options, "", {});
      },
      std::move(words));
}

std::vector<Contract> of_scene_bakes() {
  return {
      gives("BakeScene", "AsItShouldBe",
            [] {
              EXPECT_EQ(
                  pipeline::bake_scene(kept_geometry(), kept_scene(), 0, {}, quick(), {}).set.probes.size(),
                  1u);
            }),
      refuses("BakeScene", "WithoutGeometry",
              [] { pipeline::bake_scene({}, kept_scene(), 0, {}, quick(), {}); }, {"geometry"}),
      refuses("BakeScene", "AtNoTime",
              [] { pipeline::bake_scene(kept_geometry(), kept_scene(), nan, {}, quick(), {}); }, {"time"}),
      refuses("BakeScene", "WithTheGeometryOfAnother",
              [] {
                const scene::Scene other;
                pipeline::bake_scene(std::make_shared<const trace::SceneGeometry>(other), kept_scene(), 0, {},
                                     quick(), {});
              },
              {"geometry"}),
      refuses_scene_bake("OfDegreeMinusOne", [](BakeSettings& s) { s.degree = -1; }, {"degree"}),
      refuses_scene_bake("OfDegreeEleven", [](BakeSettings& s) { s.degree = 11; }, {"degree"}),
      refuses_scene_bake("OfMinusOneRecords", [](BakeSettings& s) { s.records = -1; }, {"records"}),
      refuses_scene_bake("OfTooManyRecords", [](BakeSettings& s) { s.records = 1 << 17; }, {"records"}),
      refuses_scene_bake("OfAnOperatorThatIsNone",
                         [](BakeSettings& s) { s.op = static_cast<probes::LightOperator>(9); }, {"operator"}),
      refuses_scene_bake("OfAVizThatIsNone",
                         [](BakeSettings& s) { s.viz = static_cast<probes::VizMethod>(9); }, {"VIZ method"}),
      refuses_scene_bake("OfAVizSourceThatIsNone",
                         [](BakeSettings& s) {
                           s.viz = probes::VizMethod::links;
                           s.viz_source = static_cast<probes::VizSource>(9);
                         },
                         {"source"}),
      refuses_scene_bake("OfNoMemory", [](BakeSettings& s) { s.max_memory = double(nan); }, {"memory"}),
      refuses_scene_bake("OfNegativeMemory", [](BakeSettings& s) { s.max_memory = -1; }, {"memory"}),
      refuses_scene_bake("OfAThresholdThatIsNone",
                         [](BakeSettings& s) {
                           s.viz = probes::VizMethod::links;
                           s.threshold = nan;
                         },
                         {"threshold"}),
      refuses_scene_bake("OfANegativeThreshold",
                         [](BakeSettings& s) {
                           s.viz = probes::VizMethod::links;
                           s.threshold = -0.5f;
                         },
                         {"threshold"}),
      refuses_scene_bake("OfMinusTwoNeighbors",
                         [](BakeSettings& s) {
                           s.viz = probes::VizMethod::links;
                           s.neighbors = -2;
                         },
                         {"neighbours"}),
      refuses_scene_bake("OfPathsOfNoSamples",
                         [](BakeSettings& s) {
                           s.op = probes::LightOperator::path;
                           s.params.path.spp = 0;
                         },
                         {"spp"}),
      refuses_scene_bake("OfVizOfMinusOnePasses",
                         [](BakeSettings& s) {
                           s.viz = probes::VizMethod::path;
                           s.viz_passes = -1;
                         },
                         {"passes"}),
      refuses(
          "BakeSurfaces", "OfAQualityThatIsNone",
          [] { pipeline::bake_surfaces(kept_geometry(), kept_scene(), 0, static_cast<bake::Quality>(9), 0); },
          {"quality"}),
      refuses_places("OfNoWord", [](auto& o) { o.probes = "many"; }, {"--probes", "many"}),
      refuses_places("OfNoSpacing", [](auto& o) { o.probes = "auto:nan"; }, {"--probes", "nan"}),
      refuses_places("OfAnEndlessSpacing", [](auto& o) { o.probes = "auto:inf"; }, {"inf"}),
      refuses_places("OfAClearanceThatIsNone", [](auto& o) { o.clearance = nan; }, {"clearance"}),
      refuses_places("OfMinusOneLevels", [](auto& o) { o.levels = -1; }, {"levels"}),
      refuses_places("OfNoProbes", [](auto& o) { o.max_probes = 0; }, {"probes"}),
      refuses("PlaceFor", "WithoutGeometry",
              [] { pipeline::place_for({}, kept_scene(), 0, {.probes = "4"}, "", {}); }, {"geometry"}),
      refuses("PlaceFor", "AtNoTime",
              [] { pipeline::place_for(kept_geometry(), kept_scene(), nan, {.probes = "4"}, "", {}); },
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
    params.camera = scene::camera_pose(kept_scene(), "");
  }
  void render(float time = 0) {
    pipeline::render_scene(kept_geometry(), kept_scene(), time, finder, params, state);
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
                pipeline::render_scene({}, kept_scene(), 0, p.finder, p.params, p.state);
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
      refuses("CameraOf", "ANameThatIsNot", [] { pipeline::camera_of(kept_scene(), "back", 0); }, {"back"}),
      refuses("CameraOf", "NoTime", [] { pipeline::camera_of(kept_scene(), "", nan); }, {"time"}),
      gives("ProjectionOf", "ANumberThatIsNone",
            [] {
              EXPECT_EQ(pipeline::projection_of(static_cast<pipeline::PictureProjection>(9), {}),
                        trace::Projection::pinhole);
            }),
      refuses("DrawMarks", "OverNoPicture",
              [] {
                image::Image none;
                pipeline::draw_marks(none, {}, kept_geometry(), kept_scene(), 0, Picture().params, 1);
              },
              {"picture", "size"}),
      refuses("DrawMarks", "OverAPictureOfAnotherSize",
              [] {
                image::Image picture(9, 9);
                pipeline::draw_marks(picture, {}, kept_geometry(), kept_scene(), 0, Picture().params, 1);
              },
              {"picture", "size"}),
      refuses("DrawMarks", "InNoWhite",
              [] {
                image::Image picture(4, 3);
                pipeline::draw_marks(picture, {}, kept_geometry(), kept_scene(), 0, Picture().params, nan);
              },
              {"white"}),
      refuses("DrawMarks", "WithoutGeometry",
              [] {
                image::Image picture(4, 3);
                pipeline::draw_marks(picture, {}, {}, kept_scene(), 0, Picture().params, 1);
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

SSPHH_CONTRACTS(PipelineBake, of_scene_bakes());
SSPHH_CONTRACTS(PipelinePicture, of_pictures());

}  // namespace
}  // namespace ssphh::test
