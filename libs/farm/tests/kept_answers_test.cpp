/// Results that lie in the cache under the right key and yet do not answer: each is taken for none by the one
/// thing that is wrong with it.

#include <gtest/gtest.h>

#include <ssphh/farm/farm_bake.h>
#include <ssphh/farm/farm_render.h>

#include "broker_thread.h"
#include "farm_fixtures.h"
#include "memory_dir.h"
#include "result_cache.h"
#include "unit_key.h"

namespace ssphh::farm {
namespace {

using bake::BakeStage;
using ssphh::test::memory_dir;
using ssphh::test::TempDir;
using test::PackedScene;

/// Whoever has no answer ends at once: a stop was asked for.
class KeptAnswers : public testing::Test {
 protected:
  KeptAnswers() {
    options_.results = &results_;
    options_.broker = broker_.address();
    stop_.request();
    tracer_ = std::make_unique<trace::PathTracer>(packed_.scene);
  }

  const test::Quiet quiet_;
  test::BrokerThread broker_;
  const PackedScene packed_{"gallery1"};
  const TempDir dir_{memory_dir()};
  DiskCache results_{dir_ / "results", 64 << 20};
  FarmOptions options_;
  CancelToken stop_;
  std::unique_ptr<trace::PathTracer> tracer_;
};

class KeptProbes : public KeptAnswers {
 protected:
  KeptProbes() {
    set_.generator.face_size = 4, set_.generator.spp = 1, set_.generator.passes = 1;
    set_.generator.max_depth = 2;
    for (const std::string& name : scene::light_groups(packed_.scene))
      set_.light_groups.push_back({name, vec3(1)});
  }
  ProbeJobResult computed(BakeStage stage) const {
    return {stage, set_.degree, {bake::bake_stage(*tracer_, set_, viz_, {stage, 1})}};
  }
  bool is_taken(BakeStage stage, const ProbeJobResult& result) {
    keep_result(&results_, unit_key(job_of_set(set_, viz_, stage, packed_.ref()), 1), {result, {}});
    FarmCrew crew(options_, packed_.scene, 0);
    bake::BakeParams params;
    params.viz_params = viz_;
    std::uint64_t done = 0;
    const bake::ProbeStage asked[] = {{stage, 1}};
    try {
      crew.run(set_, params, asked, [&](bake::ProbeStageResult) { ++done; }, {nullptr, &stop_});
    } catch (const Cancelled&) {
    }
    EXPECT_EQ(crew.report().units, 1u);
    EXPECT_EQ(crew.report().cached, done);
    return done == 1;
  }

  probes::ProbeSet set_ = place::init_from_scene(packed_.scene, 3);
  bake::VizParams viz_;
};

TEST_F(KeptProbes, OfGenAreThoseOfTheProbeTheDegreeAndTheGroups) {
  const ProbeJobResult right = computed(BakeStage::gen);
  EXPECT_TRUE(is_taken(BakeStage::gen, right));
  const auto with = [&](auto change) {
    ProbeJobResult other = right;
    change(other);
    return is_taken(BakeStage::gen, other);
  };
  EXPECT_FALSE(with([&](auto& r) { r = computed(BakeStage::viz); }));
  EXPECT_FALSE(with([](auto& r) { r.degree = 4; })) << "its functions are shorter than that";
  EXPECT_FALSE(with([](auto& r) { r.probes.clear(); }));
  EXPECT_FALSE(with([](auto& r) { r.probes.push_back(r.probes[0]); }));
  EXPECT_FALSE(with([](auto& r) { r.probes[0].done.probe = 2; }));
  EXPECT_FALSE(with([](auto& r) { r.probes[0].groups.pop_back(); }));
  EXPECT_FALSE(with([](auto& r) { r.probes[0].groups.push_back(r.probes[0].groups[0]); }));
  // As the whole result would be of another degree
  set_.degree = 4;
  ProbeJobResult higher = computed(BakeStage::gen);
  set_.degree = 3;
  EXPECT_FALSE(is_taken(BakeStage::gen, higher));
}

TEST_F(KeptProbes, OfVizHaveMatricesIfAskedForAndEdgesOfTheSet) {
  const auto last = static_cast<int>(set_.probes.size()) - 1;
  for (const bool matrix : {false, true}) {
    viz_.matrix = matrix;
    ProbeJobResult right = computed(BakeStage::viz);
    std::vector<probes::Edge>& edges = right.probes[0].edges;
    ASSERT_FALSE(edges.empty());
    EXPECT_TRUE(is_taken(BakeStage::viz, right));
    edges.back().from = last;
    EXPECT_TRUE(is_taken(BakeStage::viz, right));
    edges.back().from = last + 1;
    EXPECT_FALSE(is_taken(BakeStage::viz, right)) << "there is no such probe";
    edges.back().from = last;
    if (matrix) {
      edges.back().matrix = {};
    } else {
      edges.back().matrix = sh::TransferMatrix(3, 3);
    }
    EXPECT_FALSE(is_taken(BakeStage::viz, right)) << matrix;
    edges.clear();
    EXPECT_TRUE(is_taken(BakeStage::viz, right)) << "a probe that sees none";
  }
}

TEST_F(KeptProbes, AreAtMostAsManyAsAJobHasPlacesFor) {
  const bake::ProbeStage asked[] = {{BakeStage::gen, 0}};
  for (const std::size_t count : {job_limits::places, job_limits::places + 1}) {
    set_.probes.resize(count);
    FarmCrew crew(options_, packed_.scene, 0);
    try {
      crew.run(set_, {}, asked, [](bake::ProbeStageResult) {}, {nullptr, &stop_});
      FAIL() << "it was asked to stop";
    } catch (const Cancelled&) {
      EXPECT_EQ(count, job_limits::places);
    } catch (const Error& e) {
      EXPECT_EQ(count, job_limits::places + 1);
      EXPECT_STREQ(e.what(), "the farm: bakes at most 65536 probes");
    }
  }
}

class KeptTiles : public KeptAnswers {
 protected:
  KeptTiles() {
    params_.width = 7, params_.height = 5;
    params_.camera = scene::camera_pose(packed_.scene, "", 0);
    params_.path = {2, 3, 1, 5};
    params_.per_group = true;
  }
  TileResult computed() const {
    TileResult result{tile_, {}};
    trace::RenderParams params = params_;
    params.tile = tile_;
    tracer_->render(params, result.state);
    result.state.albedo = result.state.coverage = result.state.indirect = {};
    return result;
  }
  std::optional<trace::RenderState> taken(const std::vector<TileResult>& tiles) {
    TileJob job;
    job.scene = packed_.ref(), job.params = params_, job.layers = layers_;
    keep_result(&results_, unit_key(job, tile_), {TileJobResult{tiles}, {}});
    FarmReport report;
    try {
      return render(options_, packed_.scene, 0, params_, std::nullopt, layers_, report, {nullptr, &stop_});
    } catch (const Cancelled&) {
      EXPECT_EQ(report.cached, 0u);
      return std::nullopt;
    }
  }
  bool is_taken(auto change) {
    TileResult other = computed();
    change(other);
    return taken({other}).has_value();
  }

  trace::RenderParams params_;
  trace::Tile tile_{0, 0, 7, 5};
  std::vector<trace::RenderLayer> layers_ = {trace::RenderLayer::color, trace::RenderLayer::direct,
                                             trace::RenderLayer::normal, trace::RenderLayer::depth,
                                             trace::RenderLayer::groups};
};

TEST_F(KeptTiles, AreOfTheTileThePassesAndTheLayersThatWereAskedFor) {
  const TileResult right = computed();
  const auto picture = taken({right});
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->direct.pixels, right.state.direct.pixels);
  EXPECT_EQ(picture->depth.pixels, right.state.depth.pixels);
  EXPECT_EQ(picture->indirect.pixels, std::vector<float>(7 * 5 * 3)) << "was not asked for";
  ASSERT_EQ(picture->groups.size(), right.state.groups.size());
  EXPECT_EQ(picture->groups[0].pixels, right.state.groups[0].pixels);
  EXPECT_EQ(picture->passes_done, 3);
  EXPECT_EQ(picture->paths, right.state.paths);
  EXPECT_EQ(picture->rays, right.state.rays);

  EXPECT_FALSE(taken({}));
  EXPECT_FALSE(taken({right, right}));
  EXPECT_FALSE(is_taken([](auto& r) { r.tile.x = 1; }));
  EXPECT_FALSE(is_taken([](auto& r) { r.tile.y = 1; }));
  for (const int passes : {2, 4}) EXPECT_FALSE(is_taken([&](auto& r) { r.state.passes_done = passes; }));
  for (image::Image trace::RenderState::*layer : {&trace::RenderState::color, &trace::RenderState::direct,
                                                  &trace::RenderState::normal, &trace::RenderState::depth})
    EXPECT_FALSE(is_taken([&](auto& r) { (r.state.*layer) = {}; }));
  for (image::Image trace::RenderState::*layer :
       {&trace::RenderState::indirect, &trace::RenderState::albedo, &trace::RenderState::coverage}) {
    const int channels = layer == &trace::RenderState::coverage ? 1 : 3;
    EXPECT_FALSE(is_taken([&](auto& r) { (r.state.*layer) = image::Image(7, 5, channels); }));
  }
  EXPECT_FALSE(is_taken([](auto& r) { r.state.groups.pop_back(); }));
  EXPECT_FALSE(is_taken([](auto& r) { r.state.groups.push_back(r.state.groups[0]); }));
}

}  // namespace
}  // namespace ssphh::farm
