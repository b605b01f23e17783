/// Contracts of libs/lightmap, libs/place and libs/probe_export.

#include <ssphh/lightmap/encode.h>
#include <ssphh/lightmap/light.h>
#include <ssphh/lightmap/lit_scene.h>
#include <ssphh/lightmap/pack.h>
#include <ssphh/place/lattice.h>
#include <ssphh/place/site.h>
#include <ssphh/probe_export/light_grid.h>
#include <ssphh/trace/transport_scene.h>

#include "contract.h"
#include "probe_sets.h"
#include "spoilt_scenes.h"

namespace ssphh::test {
namespace {

/// As long as what refers to it.
const scene::Scene& scene_of_maps() {
  static const scene::Scene scene = sound_scene();
  return scene;
}

using lightmap::Chart, lightmap::Layout, lightmap::Texels;

std::vector<Chart> charts() {
  return lightmap::make_charts(sound_scene(), 0).charts;
}
Layout layout() {
  return lightmap::lay_out(charts(), {.size = 64});
}

/// Charts and a layout of which `spoil` makes something that is not of the scene.
std::vector<Contract> refuses_atlas(const std::string& given,
                                    std::function<void(std::vector<Chart>&, Layout&)> spoil,
                                    const std::vector<std::string>& words) {
  const auto spoilt = [spoil](const auto& use) {
    std::vector<Chart> of_scene = charts();
    Layout placed = layout();
    spoil(of_scene, placed);
    use(of_scene, placed);
  };
  return {
      refuses(
          "MakeTexels", given,
          [=] { spoilt([](auto& c, auto& l) { lightmap::make_texels(sound_scene(), 0, c, l); }); }, words),
      refuses(
          "WithLightmap", given,
          [=] { spoilt([](auto& c, auto& l) { lightmap::with_lightmap(sound_scene(), c, l); }); }, words)};
}

/// Texels that are spoilt after their places were found.
Contract refuses_texels(std::string given, std::function<void(Texels&)> spoil) {
  return refuses("LightTexels", std::move(given),
                 [spoil] {
                   const trace::TransportScene source(scene_of_maps());
                   Texels texels = lightmap::make_texels(sound_scene(), 0, charts(), layout());
                   const lightmap::Places places = lightmap::find_places(texels, rays::PosedWorld(source, 0));
                   spoil(texels);
                   lightmap::light_texels(texels, places, [](const auto&) { return vec3(1); });
                 },
                 {"lightmap texels"});
}

std::vector<Contract> of_lightmaps() {
  const std::vector<Chart> of_nan(1, {0, {}, vec2(nan)}), of_light_years(1, {0, {}, vec2(1e30f)});
  std::vector<Contract> rows = {
      refuses("DecodeRgbm", "BesideThePicture",
              [] { lightmap::decode_rgbm(lightmap::encode_rgbm(image::Image(2, 2)), 2, 0); }, {"RGBM"}),
      refuses("DecodeRgbm", "OfNoPicture", [] { lightmap::decode_rgbm({}, 0, 0); }, {"RGBM"}),
      refuses("SampleAtlas", "OfAnEmptyImage", [] { lightmap::sample({}, vec2(0.5f)); }, {"lightmap"}),
      refuses("SampleAtlas", "OfTwoChannels", [] { lightmap::sample(image::Image(2, 2, 2), vec2(0.5f)); },
              {"lightmap"}),
      refuses("LayOut", "OfAChartThatIsNoNumber", [=] { lightmap::lay_out(of_nan); }, {"size of a chart"}),
      refuses("LayOut", "OfAChartOfLightYears", [=] { lightmap::lay_out(of_light_years); },
              {"size of a chart"}),
      refuses("LayOut", "OfAChartOfFinerTexels",
              [] {
                lightmap::lay_out(std::vector<Chart>(1, {0, {}, vec2(1), -1}));
              },
              {"as wide"}),
      refuses("MakeCharts", "OfOtherInstances",
              [] { lightmap::make_charts(scene_of_maps(), 0, {}, lightmap::Halvings(99)); },
              {"each instance"}),
      refuses("MakeCharts", "OfOtherTriangles",
              [] {
                const scene::Scene scene = scene_of_maps();
                lightmap::make_charts(scene, 0, {}, lightmap::Halvings(scene.instances.size(), {1}));
              },
              {"each triangle"}),
      refuses("PlaceWithin", "BesideThose",
              [] {
                const Texels texels = lightmap::make_texels(sound_scene(), 0, charts(), layout());
                lightmap::place_within(texels, texels.texels[0], 4);
              },
              {"no such place"}),
      refuses("PackRectangles", "OfNoSize",
              [] {
                lightmap::pack(std::vector<glm::ivec2>{{0, 3}}, 9, 9);
              },
              {"over 0"}),
      refuses("LightTexels", "ByNobody",
              [] {
                const trace::TransportScene source(scene_of_maps());
                const Texels texels = lightmap::make_texels(sound_scene(), 0, charts(), layout());
                lightmap::light_texels(texels, lightmap::find_places(texels, rays::PosedWorld(source, 0)),
                                       {});
              },
              {"nothing tells"}),
      refuses("FindPlaces", "OfNoFace",
              [] {
                const trace::TransportScene source(scene_of_maps());
                Texels texels = lightmap::make_texels(sound_scene(), 0, charts(), layout());
                texels.texels[0].face = 99;
                lightmap::find_places(texels, rays::PosedWorld(source, 0));
              },
              {"face"}),
      refuses_texels("OfNoFace", [](Texels& t) { t.texels[0].face = 99; }),
      refuses_texels("OutsideOfTheAtlas", [](Texels& t) { t.texels[0].index = 64 * 64; }),
      refuses_texels("OfNoCharts", [](Texels& t) { t.first.clear(); }),
      refuses_texels("OfAPlaceOutside", [](Texels& t) { t.places[0].first.x = -9; }),
  };
  for (const auto& of_both :
       {refuses_atlas("OfNoInstance", [](auto&c, auto&) { c[0].instance = 9; }, {"another scene"}),
        refuses_atlas("OfNoTriangle", [](auto&c, auto&) { c[0].triangles[0].triangle = 99; },
                      {"another scene"}),
        refuses_atlas("OfNoPlaces", [](auto&, auto&l) { l.places.clear(); }, {"other charts"}),
        refuses_atlas("OfNoSize", [](auto&, auto&l) { l.width = 0; }, {"size"}),
        refuses_atlas("OfAPlaceOutside",
                      [](auto&, auto&l) {
                        l.places[0].first = {-9, 2};
                      },
                      {"outside"}),
        refuses_atlas("OfAPlaceThatIsTooLarge",
                      [](auto&, auto&l) {
                        l.places[0].count = {1 << 30, 1 << 30};
                      },
                      {"outside"}),
        refuses_atlas("OfAScaleThatIsNoNumber", [](auto&, auto&l) { l.places[0].scale.x = nan; }, {"scale"})})
    rows.insert(rows.end(), of_both.begin(), of_both.end());
  for (const SpoiltScene& s : spoilt_scenes())
    rows.push_back(refuses(
        "MakeCharts", s.name, [s] { lightmap::make_charts(s.make(), 0); }, s.words));
  return rows;
}

std::vector<Contract> of_places() {
  scene::Bounds box;
  box.add(vec3(0)), box.add(vec3(1));
  const auto grid = [](std::string given, const glm::ivec3& size) {
    return refuses("Resample", std::move(given),
                   [size] {
                     const trace::TransportScene source(scene_of_maps());
                     const probe_export::FreeLight light(sound_set(), source, probes::ProbeLight::all);
                     probe_export::resample(sound_set(), light, source, {.size = size});
                   },
                   {"grid"});
  };
  return {
      refuses("LookAround", "WithoutRays",
              [] { place::look_around(trace::TransportScene(scene_of_maps()), vec3(0), 0); }, {"1 to 128"}),
      refuses("LookAround", "WithMinusOneRays",
              [] { place::look_around(trace::TransportScene(scene_of_maps()), vec3(0), -1); }, {"1 to 128"}),
      refuses("MakeLattice", "OfNoSpacing", [=] { place::make_lattice(box, 0, vec3(0)); }, {"spacing"}),
      refuses("MakeLattice", "OfASpacingThatIsNoNumber", [=] { place::make_lattice(box, nan, vec3(0)); },
              {"spacing"}),
      refuses("MakeLattice", "OfTooManyPlaces", [=] { place::make_lattice(box, 1e-9f, vec3(0)); }, {"2^28"}),
      grid("WithoutPoints", {2, 0, 2}),
      grid("OfANegativeSize", {-1, 2, 2}),
      grid("OfTooManyPoints", {1 << 20, 1 << 20, 1 << 20}),
  };
}

SSPHH_CONTRACTS(Lightmap, of_lightmaps());
SSPHH_CONTRACTS(Places, of_places());

}  // namespace
}  // namespace ssphh::test
