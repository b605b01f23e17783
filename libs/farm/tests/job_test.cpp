#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/farm/engine.h>
#include <ssphh/farm/job_codec.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>

#include "farm_fixtures.h"
#include "json_schema.h"
#include "places.h"

namespace ssphh::farm {
namespace {

using ssphh::test::TempDir;
using test::PackedScene;

constexpr ContentType both[] = {ContentType::json, ContentType::binary};

/// What a worker far away would do with the job's bytes.
JobResult far_away(const PackedScene& packed, const Job& job, ContentType type) {
  const TempDir dir;
  DiskCache cache(dir.path(), 1 << 28);
  SceneStore scenes(cache);
  const JobResult result = run_job(decode_job(encode_job(job, type)), scenes, packed.fetch());
  return decode_result(encode_result(result, type));
}

probes::ProbeSet set_for(const PackedScene& packed, const ProbeJob& job) {
  probes::ProbeSet set = place::init_from_scene(packed.scene, job.degree);
  bake::set_path(set.generator, job.stage, job.path);
  set.generator.face_size = job.face_size;
  return set;
}

TEST(Job, GenAndVizGiveTheBitsOfALocalBake) {
  const PackedScene packed("gallery1");
  const trace::PathTracer tracer(packed.scene);
  for (ProbeJob job : {test::gen_job(packed), test::viz_job(packed)}) {
    job.viz_params.matrix = job.stage == bake::BakeStage::viz;
    const probes::ProbeSet set = set_for(packed, job);
    for (const ContentType type : both) {
      const auto got = std::get<ProbeJobResult>(far_away(packed, job, type).data);
      ASSERT_EQ(got.probes.size(), job.probes.size());
      for (std::size_t i = 0; i < job.probes.size(); ++i) {
        const auto want = bake::bake_stage(tracer, set, job.viz_params, {job.stage, job.probes[i]});
        EXPECT_EQ(got.probes[i].done, want.done);
        EXPECT_EQ(got.probes[i].groups, want.groups);
        EXPECT_EQ(got.probes[i].edges, want.edges);
        EXPECT_EQ(got.probes[i].rays, want.rays);
      }
    }
  }
}

TEST(Job, TilesGiveTheBitsOfALocalRender) {
  const PackedScene packed("gallery1");
  const trace::PathTracer tracer(packed.scene);
  const TileJob job = test::tile_job(packed);
  for (const ContentType type : both) {
    const auto got = std::get<TileJobResult>(far_away(packed, job, type).data);
    ASSERT_EQ(got.tiles.size(), job.tiles.size());
    for (std::size_t i = 0; i < job.tiles.size(); ++i) {
      trace::RenderParams params = job.params;
      params.tile = job.tiles[i];
      trace::RenderState want;
      tracer.render(params, want);
      EXPECT_EQ(got.tiles[i].tile, job.tiles[i]);
      EXPECT_EQ(got.tiles[i].state.color.pixels, want.color.pixels);
      EXPECT_EQ(got.tiles[i].state.depth.pixels, want.depth.pixels);
      ASSERT_EQ(got.tiles[i].state.groups.size(), want.groups.size());
      EXPECT_EQ(got.tiles[i].state.groups.back().pixels, want.groups.back().pixels);
    }
  }
}

TEST(Job, GBufferTilesHoldWhatIsSeenAndNothingElse) {
  const PackedScene packed("gallery1");
  TileJob job = test::tile_job(packed);
  job.params.path.max_depth = 0;
  job.params.per_group = false;
  job.layers = {trace::RenderLayer::albedo, trace::RenderLayer::normal, trace::RenderLayer::depth,
                trace::RenderLayer::coverage};
  const auto got = std::get<TileJobResult>(far_away(packed, job, ContentType::binary).data);
  trace::RenderParams params = job.params;
  params.path.max_depth = 3;
  params.tile = job.tiles[1];
  trace::RenderState want;
  trace::PathTracer(packed.scene).render(params, want);
  EXPECT_EQ(got.tiles[1].state.normal.pixels, want.normal.pixels) << "as in a render with light";
  EXPECT_EQ(got.tiles[1].state.depth.pixels, want.depth.pixels);
  EXPECT_TRUE(got.tiles[1].state.color.empty());
}

TEST(Job, TilesLitByProbesGiveTheBitsOfALocalRender) {
  PackedScene packed("gallery1");
  const trace::PathTracer tracer(packed.scene);
  bake::BakeReport report;
  bake::BakeParams bake;
  bake.face_size = 8;
  const probes::ProbeSet set = bake::bake(tracer, place::init_from_scene(packed.scene, 4), bake, {}, report);
  Blob blob{{}, probes::probes_to_binary(set)};
  blob.hash = content_hash(blob.bytes);
  packed.more.push_back(blob);
  TileJob job = test::tile_job(packed);
  for (const probes::LookupMethod lookup : {probes::LookupMethod::irradiance, probes::LookupMethod::light}) {
    job.lighting = {blob.hash, blob.bytes.size(), {lookup, {}, probes::ProbeLayer::self}};
    const auto got = std::get<TileJobResult>(far_away(packed, job, ContentType::binary).data);
    probes::LookupParams params;
    params.layer = probes::ProbeLayer::self;
    const auto light = probes::make_lookup(lookup, set, tracer, params);
    trace::RenderParams render = job.params;
    render.tile = job.tiles[0];
    trace::RenderState want;
    tracer.render_with(*light, render, want);
    EXPECT_EQ(got.tiles[0].state.color.pixels, want.color.pixels) << name_of(lookup);
  }
}

TEST(Job, RaysAreCountedOfThisJobAlone) {
  const PackedScene packed("gallery1");
  const TempDir dir;
  DiskCache cache(dir.path(), 1 << 28);
  SceneStore scenes(cache);
  for (int i = 0; i < 2; ++i) {
    const JobResult result = run_job(test::gen_job(packed), scenes, packed.fetch());
    std::uint64_t rays = 0;
    for (const bake::ProbeStageResult& probe : std::get<ProbeJobResult>(result.data).probes)
      rays += probe.rays;
    EXPECT_GT(rays, 0u);
    EXPECT_EQ(result.stats.rays, rays);
    EXPECT_GT(result.stats.seconds, 0);
  }
}

TEST(Job, AnotherSceneThanTheJobNamesIsRefused) {
  const PackedScene packed("cornell");
  ProbeJob job = test::gen_job(PackedScene("gallery1"));
  job.scene = packed.ref();
  job.scene.light.low ^= 1;
  EXPECT_THROW(far_away(packed, job, ContentType::json), Error);
}

TEST(Job, SceneTravelsOnce) {
  const PackedScene packed("gallery1");
  const TempDir dir;
  DiskCache cache(dir.path(), 1 << 28);
  {
    SceneStore scenes(cache);
    run_job(test::gen_job(packed), scenes, packed.fetch());
    const std::uint64_t first = packed.fetched;
    run_job(test::viz_job(packed), scenes, packed.fetch());
    EXPECT_EQ(packed.fetched, first);
  }
  const std::uint64_t before = packed.fetched;
  SceneStore restarted(cache);
  run_job(test::gen_job(packed), restarted, packed.fetch());
  EXPECT_EQ(packed.fetched, before) << "from the disk after a restart";
}

TEST(Job, CodecsKeepEveryBitOfAFloat) {
  const PackedScene packed("cornell");
  ProbeJob job = test::viz_job(PackedScene("gallery1"));
  std::uint32_t bits = 12345;
  for (ProbeSphere& place : job.places) {
    for (int c = 0; c < 3; ++c) {
      do bits = bits * 1664525u + 1013904223u;
      while ((bits & 0x7f800000u) == 0x7f800000u);
      place.position[c] = std::bit_cast<float>(bits);
    }
  }
  job.places[0].position = {-0.0f, 1.17549421e-38f, 3.40282347e38f};
  for (const ContentType type : both) {
    const auto back = std::get<ProbeJob>(decode_job(encode_job(job, type)));
    for (std::size_t i = 0; i < job.places.size(); ++i) {
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(std::bit_cast<std::uint32_t>(back.places[i].position[c]),
                  std::bit_cast<std::uint32_t>(job.places[i].position[c]));
    }
    EXPECT_EQ(encode_job(back, type), encode_job(job, type));
  }
}

std::vector<std::string> schema_errors(const std::string& schema, const std::string& document) {
  return ssphh::test::schema_errors(ssphh::test::source_dir() / "schemas" / schema, document);
}

TEST(Job, MessagesAgreeWithTheirSchemas) {
  const PackedScene packed("gallery1");
  for (const Job& job :
       std::initializer_list<Job>{test::gen_job(packed), test::viz_job(packed), test::tile_job(packed)}) {
    const std::string text = encode_job(job, ContentType::json);
    EXPECT_EQ(schema_errors("farm-job.schema.json", text), std::vector<std::string>()) << text.substr(0, 400);
    const std::string result = encode_result(far_away(packed, job, ContentType::json), ContentType::json);
    EXPECT_EQ(schema_errors("farm-result.schema.json", result), std::vector<std::string>())
        << result.substr(0, 400);
  }
}

TEST(Job, BrokenMessagesAreErrors) {
  const PackedScene packed("gallery1");
  const std::string job = encode_job(test::viz_job(packed), ContentType::binary);
  for (std::size_t cut = 0; cut < job.size(); cut += 5) EXPECT_THROW(decode_job(job.substr(0, cut)), Error);
  for (const char* bad : {"", "{}", "[]", "null", "SSPHHMSG", R"({"format":"ssphh-job","version":2})",
                          R"({"format":"ssphh-job","version":2,"kind":"rm"})"}) {
    EXPECT_THROW(decode_job(bad), Error) << bad;
    EXPECT_THROW(decode_result(bad), Error) << bad;
  }
  EXPECT_THROW(decode_job(std::string(1 << 20, '[')), Error) << "deep";
  ProbeJob far = test::gen_job(packed);
  far.probes = {3, 1};
  EXPECT_THROW(encode_job(far, ContentType::json), Error);
}

TEST(Job, FloatsBehindADocumentAreReadOnce) {
  const auto message = [](const std::string& second) {
    std::string text = R"({"format":"ssphh-result","version":2,"kind":"ref","tiles":[{"tile":[0,0,2,1],)"
                       R"("passes":1,"paths":2,"rays":3,"layers":{"color":{"f32":[0,6]},"direct":)" +
                       second + R"(}}],"stats":{"seconds":1,"rays":3,"worker":"w"}})";
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto size = static_cast<std::uint32_t>(text.size());
    std::string body = "SSPHHMSG" + std::string(reinterpret_cast<const char*>(&size), 4) + text;
    return body + std::string(12 * sizeof(float), '\0');
  };
  EXPECT_NO_THROW(decode_result(message(R"({"f32":[6,6]})")));
  EXPECT_NO_THROW(decode_result(message("[1,2,3,4,5,6]")));
  EXPECT_THROW(decode_result(message(R"({"f32":[7,6]})")), Error) << "beyond the end";
  EXPECT_THROW(decode_result(message(R"({"f32":[6,5]})")), Error) << "of another size";
  // More floats than there are, by reading some twice.
  std::string doubled = message(R"({"f32":[0,6]},"albedo":{"f32":[0,6]})");
  EXPECT_THROW(decode_result(doubled), Error);
}

TEST(Engine, IsTheSameAtEveryCall) {
  EXPECT_EQ(engine_id().size(), 16u);
  EXPECT_EQ(engine_id(), engine_id());
  EXPECT_TRUE(job_service().starts_with("ssphh.jobs."));
}

}  // namespace
}  // namespace ssphh::farm
