/// Bakes in tiles: the same light as of one network, the same bits however often they were stopped, and a
/// folder where memory would not do.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/bake/update.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "fields.h"
#include "logged.h"
#include "temp_dir.h"

namespace ssphh::pipeline {
namespace {

using testing::HasSubstr;

/// Stops once so many stages have begun.
class StopAt : public Progress {
 public:
  explicit StopAt(const std::string& stage) : stage_(stage) {}
  void begin(const std::string& stage, std::uint64_t, const std::string&) override {
    stages.push_back(stage);
    if (stage.starts_with(stage_)) token.request();
  }
  void advance(std::uint64_t) override {}
  void end() override {}

  CancelToken token;
  std::vector<std::string> stages;

 private:
  std::string stage_;
};

/// The Cornell box with 36 probes in it, in tiles of 12 at most.
class TiledBake : public testing::Test {
 protected:
  static scene::Scene box() {
    scene::Scene scene = scene::make_builtin("cornell");
    scene.sphls.clear();
    for (int i = 0; i < 36; ++i) {
      scene::Node& node = scene.nodes.emplace_back();
      const vec3 at(i % 3, i / 3 % 3, i / 9);
      node.local.translation = vec3(-0.84f, 0.2f, -0.86f) + vec3(0.84f, 0.8f, 0.57f) * at;
      scene.sphls.push_back({fmt::format("p{}", i), static_cast<int>(scene.nodes.size()) - 1, 0.05f});
    }
    return scene;
  }
  static BakeSettings settings(std::size_t most_probes) {
    BakeSettings s;
    s.degree = 2;
    s.op = probes::LightOperator::surfel;
    s.viz = probes::VizMethod::none;
    s.records = 150;
    s.most_probes_in_tile = most_probes;
    s.transport.records.rays = 64;
    s.transport.transport.directions = 64;
    s.transport.transport.link_rays = 32;
    s.transport.transport.surfel_size = 0.2f;
    return s;
  }
  SceneBake bake(const BakeSettings& s, const std::filesystem::path& checkpoint = {},
                 const Control& control = {}) const {
    return bake_scene(geometry_, scene_, 0, {.probes = "scene"}, s, checkpoint, control);
  }

  static std::vector<probes::Tile> tiles_of(probes::ProbeSet set) { return bake::make_tiles(set, 12); }

  scene::Scene scene_ = box();
  trace::SharedGeometry geometry_ = std::make_shared<const trace::SceneGeometry>(scene_);
  test::TempDir dir_;
  test::Logged log_;
};

double mean_of(const probes::ProbeSet& set, const vec3& at) {
  for (const probes::Probe& probe : set.probes)
    if (probe.position == at) return static_cast<double>(luminance(sh::mean(probe.reflected)));
  ADD_FAILURE();
  return 0;
}

TEST_F(TiledBake, HasTheLightOfOneNetworkOfAll) {
  const SceneBake one = bake(settings(36)), tiled = bake(settings(12));
  EXPECT_EQ(one.transport.tiles, 1u);
  EXPECT_EQ(tiled.transport.tiles, tiles_of(tiled.set).size());
  EXPECT_GE(tiled.transport.tiles, 3u);
  EXPECT_EQ(tiled.transport.records, tiled.set.surface->points.size());
  ASSERT_EQ(tiled.set.probes.size(), 36u);
  double sum = 0;
  int lit = 0;  // some stand in the boxes
  for (const probes::Probe& probe : one.set.probes) {
    const double before = mean_of(one.set, probe.position), now = mean_of(tiled.set, probe.position);
    if (before == 0) continue;
    ++lit;
    EXPECT_NEAR(now / before, 1, 0.12) << probe.name;
    sum += now / before;
  }
  EXPECT_GT(lit, 25);
  EXPECT_NEAR(sum / lit, 1, 0.01);
  // As dense as one network's: each tile may have as many
  EXPECT_GT(tiled.set.surface->points.size(), one.set.surface->points.size());
}

TEST_F(TiledBake, KeepsRecordsOfEachTileInItsBoxAlone) {
  SceneBake tiled = bake(settings(12));
  const std::vector<probes::Tile> tiles = tiles_of(tiled.set);
  std::size_t p = 0;
  for (const probes::Tile& tile : tiles) {
    const std::size_t first = p;
    while (p < tiled.set.surface->points.size() && tile.box.contains(tiled.set.surface->points[p].position))
      ++p;
    EXPECT_GT(p - first, 20u);
  }
  EXPECT_EQ(p, tiled.set.surface->points.size());
}

TEST_F(TiledBake, GoesOnWhereItWasStoppedWithTheSameBits) {
  const probes::ProbeSet whole = bake(settings(12)).set;
  const std::filesystem::path checkpoint = dir_ / "a.sphl.checkpoint";
  StopAt stop("tile 3 of ");
  EXPECT_THROW(bake(settings(12), checkpoint, {&stop, &stop.token}), Cancelled);
  EXPECT_TRUE(std::filesystem::exists(dir_ / "a.sphl.checkpoint.tiles"));
  StopAt see("never");
  const SceneBake rest = bake(settings(12), checkpoint, {&see, nullptr});
  EXPECT_EQ(rest.transport.resumed, 2u);
  for (const std::string& stage : see.stages)
    EXPECT_FALSE(stage.starts_with("tile 1") || stage.starts_with("tile 2")) << stage;
  EXPECT_EQ(rest.set, whole);
  remove_checkpoint(checkpoint);
  EXPECT_FALSE(std::filesystem::exists(dir_ / "a.sphl.checkpoint.tiles"));
}

TEST_F(TiledBake, IntoAFolderHasTheSameTiles) {
  const probes::ProbeSet whole = bake(settings(12)).set;
  BakeSettings s = settings(12);
  s.tiles = dir_ / "box.tiles";
  const SceneBake baked = bake(s);
  EXPECT_FALSE(baked.set.surface.has_value());
  EXPECT_EQ(baked.set.light_groups, whole.light_groups);
  probes::ProbeSet read = read_probes_of(scene_, s.tiles, 0, false);
  read.baseline = whole.baseline;
  EXPECT_EQ(read, whole);
  EXPECT_EQ(bake(s).transport.resumed, baked.transport.tiles);
  s.degree = 1;
  EXPECT_EQ(bake(s).transport.resumed, 0u);
}

TEST_F(TiledBake, FindsEdgesAcrossItsBorders) {
  BakeSettings s = settings(12);
  s.viz = probes::VizMethod::links;
  s.records = 0;
  s.neighbors = -1;
  probes::ProbeSet set = bake(s).set;
  const std::vector<probes::Tile> tiles = tiles_of(set);
  std::size_t across = 0;
  for (const probes::Tile& tile : tiles) {
    for (std::uint32_t i = tile.first; i < tile.first + tile.own; ++i) {
      if (sh::mean(set.probes[i].reflected) == vec3(0)) continue;  // it stands in a box
      EXPECT_GE(set.probes[i].edges.size(), tile.own / 2);
      for (const probes::Edge& edge : set.probes[i].edges) {
        const auto from = static_cast<std::uint32_t>(edge.from);
        across += from < tile.first || from >= tile.first + tile.own;
        // Of what is near: the intensity that both see
        EXPECT_GT(edge.transfer, 0);
      }
    }
  }
  EXPECT_GT(across, 36u);
  EXPECT_NO_THROW(probes::validate(set, "test"));
}

TEST_F(TiledBake, RefusesFoldersOfWhatOneNetworkMustFind) {
  BakeSettings s = settings(12);
  s.tiles = dir_ / "box.tiles";
  s.op = probes::LightOperator::path;
  s.records = {};
  EXPECT_THAT(test::message_of([&] { bake(s); }), HasSubstr("light by operator path"));
  s.op = probes::LightOperator::surfel;
  s.transport.fit = true;
  EXPECT_THAT(test::message_of([&] { bake(s); }), HasSubstr("weights are not fitted in tiles"));
  s.tiles.clear();
  s.records = 0;
  EXPECT_EQ(bake(s).transport.tiles, 1u);  // so are they in one
}

TEST_F(TiledBake, IsUpdatedTileByTile) {
  probes::ProbeSet set = bake(settings(12)).set;
  const trace::TransportScene source(geometry_, scene_);
  const bake::TransportBakeParams params = bake::transport_params_of(set);
  const std::vector<probes::Tile> tiles = tiles_of(set);
  const probes::Tile& second = tiles[1];

  probes::ProbeSet scoped = set;
  bake::TransportBakeReport report;
  const bake::TransportUpdate found = bake::update_in_tiles(
      source, scoped, params, 12, {.probes = {{second.first}}, .groups = {}}, 0.05f, report);
  EXPECT_EQ(report.tiles, tiles.size());
  EXPECT_EQ(found.changed.size(), 36u);
  for (const std::uint32_t i : found.probes) EXPECT_EQ(i, second.first);
  std::size_t other = 0;
  for (std::size_t p = 0; p < set.surface->points.size(); ++p) {
    if (second.box.contains(set.surface->points[p].position)) continue;
    while (other < scoped.surface->points.size() &&
           scoped.surface->points[other].position != set.surface->points[p].position)
      ++other;
    ASSERT_LT(other, scoped.surface->points.size());
    EXPECT_EQ(scoped.surface->groups[0][other], set.surface->groups[0][p]);
  }

  // What was darkened in the file comes back, in each tile
  probes::ProbeSet dark = set;
  for (probes::Probe& probe : dark.probes)
    for (probes::GroupLight& group : probe.groups)
      for (vec3& value : group.reflected.values) value *= 0.5f;
  const bake::TransportUpdate all = bake::update_in_tiles(source, dark, params, 12, {}, 0.05f, report);
  EXPECT_GT(all.probes.size(), 25u);
  for (std::size_t i = 0; i < 36; ++i) {
    if (sh::mean(set.probes[i].reflected) == vec3(0)) continue;
    EXPECT_GT(all.changed[i], 0.01f);
    EXPECT_NEAR(luminance(sh::mean(dark.probes[i].reflected)) / luminance(sh::mean(set.probes[i].reflected)),
                1, 1e-3);
  }
}

TEST_F(TiledBake, KeyChangesWithAllThatATileHangsOn) {
  const trace::TransportScene source(geometry_, scene_);
  probes::ProbeSet set = bake(settings(36)).set;
  const std::vector<probes::Tile> tiles = bake::make_tiles(set, 12);
  const bake::TiledParams params{settings(12).transport};
  const Hash128 key = bake::tiled_key(source, set, tiles, params);
  EXPECT_EQ(bake::tiled_key(source, set, tiles, params), key);
  using Change = std::function<void(probes::ProbeSet&, std::vector<probes::Tile>&, bake::TiledParams&)>;
  const std::pair<const char*, Change> changes[] = {
      {"degree", [](auto& s, auto&, auto&) { s.degree = 3; }},
      {"scene", [](auto& s, auto&, auto&) { s.generator.scene_hash.low ^= 1; }},
      {"time", [](auto& s, auto&, auto&) { s.generator.time = 1; }},
      {"place", [](auto& s, auto&, auto&) { s.probes[35].position.z += 1e-3f; }},
      {"radius", [](auto& s, auto&, auto&) { s.probes[5].radius *= 2; }},
      {"name", [](auto& s, auto&, auto&) { s.probes[5].name = "other"; }},
      {"tiles", [](auto&, auto& t, auto&) { t[0].halo.pop_back(); }},
      {"known light", [](auto&, auto&, auto& p) { p.light_known = true; }},
      {"operator", [](auto&, auto&, auto& p) { p.transport.op = probes::LightOperator::bounce; }},
      {"directions", [](auto&, auto&, auto& p) { ++p.transport.transport.directions; }},
      {"surfel size", [](auto&, auto&, auto& p) { p.transport.transport.surfel_size *= 2; }},
      {"link rays", [](auto&, auto&, auto& p) { ++p.transport.transport.link_rays; }},
      {"samples", [](auto&, auto&, auto& p) { ++p.transport.transport.samples; }},
      {"per radius", [](auto&, auto&, auto& p) { ++p.transport.transport.surfels_per_radius; }},
      {"most surfels", [](auto&, auto&, auto& p) { ++p.transport.transport.most_surfels; }},
      {"tolerance", [](auto&, auto&, auto& p) { p.transport.solve.tolerance *= 2; }},
      {"iterations", [](auto&, auto&, auto& p) { ++p.transport.solve.max_iterations; }},
      {"settle", [](auto&, auto&, auto& p) { p.transport.solve.settle ^= true; }},
      {"viz", [](auto&, auto&, auto& p) { p.transport.viz ^= true; }},
      {"neighbors", [](auto&, auto&, auto& p) { ++p.transport.viz_params.neighbors; }},
      {"threshold", [](auto&, auto&, auto& p) { p.transport.viz_params.threshold += 1; }},
      {"source", [](auto&, auto&, auto& p) { p.transport.viz_params.source = probes::VizSource::radiance; }},
      {"viz tolerance", [](auto&, auto&, auto& p) { p.transport.viz_params.solve.tolerance *= 2; }},
      {"records", [](auto&, auto&, auto& p) { ++p.transport.records.points; }},
      {"record rays", [](auto&, auto&, auto& p) { ++p.transport.records.rays; }},
      {"baked groups", [](auto&, auto&, auto& p) { p.transport.records.baked.push_back(0); }}};
  for (const auto& [name, change] : changes) {
    probes::ProbeSet other = set;
    std::vector<probes::Tile> other_tiles = tiles;
    bake::TiledParams other_params = params;
    change(other, other_tiles, other_params);
    EXPECT_NE(bake::tiled_key(source, other, other_tiles, other_params), key) << name;
  }
}

}  // namespace
}  // namespace ssphh::pipeline
