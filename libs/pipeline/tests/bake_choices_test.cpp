// What a bake decides by itself, case by case: what it was made with, what it keeps, what it says and what it
// refuses.

#include <functional>

#include <gtest/gtest.h>

#include <ssphh/core/memory.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>

#include "bake_fields.h"
#include "error_message.h"
#include "expected_text.h"
#include "logged.h"

namespace ssphh::pipeline {
namespace {

using probes::LightOperator;
using probes::VizMethod;
using test::fields;

/// Takes the stages of a bake and does none of them: it tells what was asked of it.
class CrewThatTells : public bake::BakeCrew {
 public:
  void run(const probes::ProbeSet&, const bake::BakeParams& params, std::span<const bake::ProbeStage> stages,
           const std::function<void(bake::ProbeStageResult)>&, const Control&) override {
    told = fmt::format("  {} stages\n", stages.size());
    for (const auto& [field, text] : test::field_texts(params))
      if (!field.starts_with("/only")) told += fmt::format("  {} {}\n", field, text);
    throw Cancelled();
  }
  std::string told;
};

/// Bakes of the glowing box, with as many probes in it as a case asks for, as cheap as a bake can be.
class BakeChoices : public testing::Test {
 protected:
  using Change = std::function<void(BakeSettings&)>;

  static scene::Scene box_with(int probes) {
    scene::Scene scene = scene::make_builtin("box");
    scene.sphls.clear();
    for (int i = 0; i < probes; ++i) {
      scene::Node& node = scene.nodes.emplace_back();
      node.local.translation = 0.2f * vec3(i % 8, i / 8 % 8, i / 64) - 0.75f;
      scene.sphls.push_back({fmt::format("p{}", i), static_cast<int>(scene.nodes.size()) - 1, 0.05f});
    }
    return scene;
  }
  static BakeSettings cheap() {
    BakeSettings settings;
    settings.degree = 0;
    settings.params.path = {.max_depth = 2, .passes = 1, .spp = 1, .seed = 77};
    settings.params.face_size = 1;
    settings.usual_records = 24;
    settings.transport.records.rays = 16;
    settings.transport.fit_params = {.probes = 2, .training_lights = 2, .gather_rays = 16};
    transport::TransportParams& network = settings.transport.transport;
    network.directions = 8, network.link_rays = 4, network.samples = 1, network.surfel_size = 0.5f;
    return settings;
  }

  void add(const std::string& name, const scene::Scene& scene, const BakeSettings& settings, float time = 0,
           const PlaceOptions& places = {.probes = "scene"}, bake::BakeCrew* crew = nullptr) {
    const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
    test::Logged logged;
    std::string told;
    const std::string error = test::message_of(
        [&] { told = text_of(bake_scene(geometry, scene, time, places, settings, {}, {}, crew)); });
    text_ += name + "\n" + told;
    if (error != "no error") text_ += "  " + error + "\n";
    for (const std::string& line : test::lines_of(logged.take())) text_ += "  " + line + "\n";
  }
  void add(const std::string& name, int probes, const Change& change, bake::BakeCrew* crew = nullptr) {
    BakeSettings settings = cheap();
    change(settings);
    add(name, box_with(probes), settings, 0, {.probes = "scene"}, crew);
  }
  /// What a farm would have been asked for.
  void add_told(const std::string& name, int probes, const Change& change) {
    CrewThatTells crew;
    BakeSettings settings = cheap();
    change(settings);
    const scene::Scene scene = box_with(probes);
    const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
    try {
      bake_scene(geometry, scene, 0, {.probes = "scene"}, settings, {}, {}, &crew);
    } catch (const Cancelled&) {
    }
    text_ += name + "\n" + crew.told;
  }

  /// Whether settings are refused; else it is stopped when they are resolved.
  void add_refused_or_begun(const std::string& name, int probes, const Change& change) {
    const scene::Scene scene = box_with(probes);
    const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
    BakeSettings settings = cheap();
    change(settings);
    CancelToken stop;
    stop.request();
    std::string said;
    test::Logged logged;
    try {
      said = test::message_of([&] {
        bake_scene(geometry, scene, 0, {.probes = "scene"}, settings, {}, {nullptr, &stop});
      });
    } catch (const Cancelled&) {
      said = "begins";
    }
    text_ += fmt::format("{}\n  {}\n", name, said);
    for (const std::string& line : test::lines_of(logged.take())) text_ += "  " + line + "\n";
  }

  static std::string text_of(const SceneBake& baked) {
    const probes::ProbeSet& set = baked.set;
    std::string text = fmt::format("  {} probes of degree {}, viz {}, {} edges, {} records, fitted {}{}\n",
                                   set.probes.size(), set.degree, name_of(baked.viz), probes::edge_count(set),
                                   set.surface ? set.surface->points.size() : 0, set.fitted.has_value(),
                                   baked.place ? ", placed" : "");
    probes::GeneratorInfo generator = set.generator;
    generator.scene_hash = {};
    const auto usual = test::field_texts(probes::GeneratorInfo());
    for (const auto& [field, value] : test::field_texts(generator))
      if (value != usual.at(field)) text += fmt::format("  {} {}\n", field, value);
    if (const auto& b = set.baseline)
      text += fmt::format("  baseline {} {:g} {} {}, {} items, {} trials\n", b->viz_neighbors,
                          b->viz_threshold, b->records, b->most_surfels, b->items.size(), b->trials.size());
    for (const probes::LightGroup& group : set.light_groups)
      text += fmt::format("  {} {}\n", group.name, name_of(group.mode));
    return text + fmt::format("  paths {}, surfels {}\n", baked.paths.rays > 0, baked.transport.surfels > 0);
  }

  std::string text_;
};

TEST_F(BakeChoices, FollowTheNumberOfProbesAndWhatIsGiven) {
  const Change nothing = [](BakeSettings&) {};
  add("64 probes", 64, nothing);
  add("65 probes", 65, nothing);
  add_refused_or_begun("65 probes, an option of paths", 65, [](BakeSettings& s) { s.of_paths = {"--spp"}; });
  add_refused_or_begun("65 probes, local", 65,
                       [](BakeSettings& s) { s.params.gen = probes::GenMode::local; });
  const Change of_viz = [](BakeSettings& s) { s.of_viz = {"--neighbors"}; };
  add_refused_or_begun("512 probes, an option of VIZ", 512, of_viz);
  add_refused_or_begun("513 probes, an option of VIZ", 513, of_viz);
  add_refused_or_begun("513 probes", 513, nothing);
  add("bounce", 3, [](BakeSettings& s) { s.op = LightOperator::bounce, s.neighbors = 1; });
  add("surfel, VIZ by paths", 3, [](BakeSettings& s) {
    s.op = LightOperator::surfel, s.viz = VizMethod::path, s.of_paths = {"--spp"}, s.of_viz = {"--a"};
    s.of_viz_paths = {"--b"}, s.threshold = 0.25f, s.viz_spp = 2;
  });
  add("path, VIZ by links", 3, [](BakeSettings& s) {
    s.viz = VizMethod::links, s.of_transport = {"--directions"}, s.viz_source = probes::VizSource::radiance;
    s.threshold = 1e-4f, s.neighbors = 1;
  });
  add("path, fitted", 3, [](BakeSettings& s) {
    s.viz = VizMethod::none, s.transport.fit = true, s.of_transport = {"--fit"}, s.seed = 5;
  });
  add("nothing but light", 3, [](BakeSettings& s) { s.viz = VizMethod::none; });
  test::expect_text_of("libs/pipeline/tests/expected/bake-by-count.txt", text_);
}

TEST_F(BakeChoices, KeepRecordsWhereLightHasEveryBounce) {
  add("every bounce", 2, [](BakeSettings& s) { s.params.path.max_depth = rays::usual_max_depth; });
  add("one less", 2, [](BakeSettings& s) { s.params.path.max_depth = rays::usual_max_depth - 1; });
  add("every bounce, local", 2, [](BakeSettings& s) {
    s.params.path.max_depth = rays::usual_max_depth, s.params.gen = probes::GenMode::local;
  });
  add("surfel", 2, [](BakeSettings& s) { s.op = LightOperator::surfel, s.viz = VizMethod::none; });
  for (const int probes : {150, 225, 400})
    add(fmt::format("surfel, {} probes", probes), probes,
        [](BakeSettings& s) { s.op = LightOperator::surfel, s.viz = VizMethod::none; });
  add("bounce", 2, [](BakeSettings& s) { s.op = LightOperator::bounce, s.viz = VizMethod::none; });
  add("as many as asked for", 2, [](BakeSettings& s) { s.records = 7, s.of_transport = {"--records"}; });
  for (const scene::LightMode mode : {scene::LightMode::baked, scene::LightMode::mixed}) {
    scene::Scene scene = box_with(2);
    scene.light_modes = {{"walls", mode}};
    add(fmt::format("asked to be {}", name_of(mode)), scene, cheap());
    BakeSettings none = cheap();
    none.records = 0;
    add(fmt::format("asked to be {}, without records", name_of(mode)), scene, none);
  }
  test::expect_text_of("libs/pipeline/tests/expected/bake-records.txt", text_);
}

TEST_F(BakeChoices, AreHandedToWhoTraces) {
  add_told("as usual", 2, [](BakeSettings& s) { s.params.path.passes = 3, s.params.path.spp = 5; });
  add_told("as told", 2, [](BakeSettings& s) {
    s.neighbors = 6, s.threshold = 0.5f, s.viz_source = probes::VizSource::radiance, s.seed = 9;
    s.viz_max_depth = 4, s.viz_passes = 2, s.viz_spp = 7;
  });
  add_told("VIZ alone", 2,
           [](BakeSettings& s) { s.op = LightOperator::surfel, s.viz = VizMethod::path, s.records = 0; });
  add_told("no VIZ", 2, [](BakeSettings& s) { s.viz = VizMethod::none; });
  add_told("many", 65, [](BakeSettings& s) { s.viz = VizMethod::none; });
  add_told("with transfer, many", 65, [](BakeSettings& s) { s.params.viz_params.matrix = true; });
  test::expect_text_of("libs/pipeline/tests/expected/bake-handed-on.txt", text_);
}

TEST_F(BakeChoices, ThatExcludeEachOtherAreRefused) {
  add("transfer without paths", 1,
      [](BakeSettings& s) { s.params.viz_params.matrix = true, s.viz = VizMethod::links; });
  add("local light of surfels", 1,
      [](BakeSettings& s) { s.op = LightOperator::surfel, s.params.gen = probes::GenMode::local; });
  add("paths for nothing", 1,
      [](BakeSettings& s) { s.op = LightOperator::surfel, s.viz = VizMethod::none, s.of_paths = {"--spp"}; });
  add("transport for nothing", 1, [](BakeSettings& s) { s.of_transport = {"--directions"}; });
  add("VIZ for nothing", 1, [](BakeSettings& s) { s.viz = VizMethod::none, s.of_viz = {"--neighbors"}; });
  add("paths of VIZ for nothing", 1,
      [](BakeSettings& s) { s.viz = VizMethod::links, s.of_viz_paths = {"--viz-spp"}; });
  CrewThatTells crew;
  add(
      "a farm for nothing", 1,
      [](BakeSettings& s) { s.op = LightOperator::surfel, s.viz = VizMethod::links; }, &crew);
  add("less than no memory", 1, [](BakeSettings& s) { s.max_memory = -1; });
  add("memory without end", 1, [](BakeSettings& s) { s.max_memory = HUGE_VAL; });
  add("less than no records", 1, [](BakeSettings& s) { s.records = -1; });
  add("less than no usual records", 1, [](BakeSettings& s) { s.usual_records = -1; });
  test::expect_text_of("libs/pipeline/tests/expected/bake-refused.txt", text_);
}

TEST_F(BakeChoices, StayWithinMemory) {
  const auto coarse = [](double gigabytes) {
    return [gigabytes](BakeSettings& s) {
      s.op = LightOperator::surfel, s.viz = VizMethod::none, s.records = 0, s.max_memory = gigabytes;
      s.transport.transport.surfel_size = 0.07f;  // some 4,900 of them
    };
  };
  // 64 MB for all else, 2 kB and four rays of 45 bytes a surfel (bake/effort.h).
  const double thousand = 64e-3 + 1000 * 2.18e-6;
  add("a thousand surfels", 1, coarse(thousand));
  add("three thousand", 1, coarse(thousand + 2000 * 2.18e-6));
  add("as many as there are", 1, coarse(thousand + 99100 * 2.18e-6));
  add("half of the machine's", 1, coarse(0));
  test::expect_text_of("libs/pipeline/tests/expected/bake-memory.txt", text_);
}

TEST_F(BakeChoices, TakeHalfOfTheMachinesMemoryUnlessToldOtherwise) {
  // With so many rays of a surfel that no machine holds as many surfels as are asked for
  BakeSettings settings = cheap();
  settings.op = LightOperator::surfel, settings.viz = VizMethod::none, settings.records = 0;
  settings.transport.transport.link_rays = 4096, settings.transport.transport.most_surfels = 1 << 24;
  const scene::Scene scene = box_with(1);
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const auto most_with = [&](double gigabytes) {
    settings.max_memory = gigabytes;
    const test::Logged logged;
    return bake_scene(geometry, scene, 0, {.probes = "scene"}, settings, {}).set.baseline->most_surfels;
  };
  const int by_itself = most_with(0);
  EXPECT_EQ(by_itself, bake::surfels_within(memory_of_machine() / 2, 4096));
  EXPECT_LT(by_itself, 1 << 24);
  EXPECT_EQ(most_with(3), bake::surfels_within(3'000'000'000, 4096));
}

TEST_F(BakeChoices, ArePosedAndPlacedAsAsked) {
  const scene::Scene rooms = scene::make_builtin("two-rooms");
  BakeSettings settings = cheap();
  settings.viz = VizMethod::none;
  add("two-rooms at half a second", rooms, settings, 0.5f);
  add("seven of them", rooms, settings, 0, {.probes = "7"});
  add("too many", rooms, settings, 0, {.probes = "auto:0.5", .max_probes = 9});
  add("not finite", rooms, settings, NAN, {.probes = "7"});
  add("none asked for", box_with(2), settings, 0, {});
  scene::Scene empty = scene::make_builtin("box");
  empty.sphls.clear();
  settings.op = LightOperator::surfel;
  add("none there", empty, settings, 0, {});
  test::expect_text_of("libs/pipeline/tests/expected/bake-places.txt", text_);
}

TEST(Effort, ReachesWhatABakeIsToldWhole) {
  std::string text;
  for (const bake::Quality quality : {bake::Quality::draft, bake::Quality::good, bake::Quality::best}) {
    BakeSettings s;
    set_effort(s, quality);
    const transport::TransportParams& t = s.transport.transport;
    const bake::Effort set = {.spp = s.params.path.spp,
                              .directions = t.directions,
                              .link_rays = t.link_rays,
                              .surfels_per_radius = t.surfels_per_radius,
                              .most_surfels = t.most_surfels,
                              .records = s.usual_records};
    EXPECT_EQ(set, bake::effort_of(quality)) << name_of(quality);
  }
  const BakeSettings usual;
  EXPECT_EQ(usual.params.path.spp, bake::effort_of(bake::Quality::good).spp);
  EXPECT_EQ(usual.degree, 9);
  EXPECT_EQ(usual.threshold, 0);
}

}  // namespace
}  // namespace ssphh::pipeline
