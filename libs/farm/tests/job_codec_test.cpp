/// Every field of a job and of a result travels, in both encodings.

#include <functional>
#include <tuple>

#include <gmock/gmock.h>

#include <ssphh/core/json.h>
#include <ssphh/farm/job_codec.h>

#include "error_message.h"
#include "job_fields.h"
#include "random_set.h"

namespace ssphh::farm {
namespace {

using ssphh::test::expect_same_fields;

constexpr ContentType both_encodings[] = {ContentType::json, ContentType::binary};

template <class Data>
void expect_to_travel(const Data& job) {
  for (const ContentType type : both_encodings)
    expect_same_fields(std::get<Data>(decode_job(encode_job(job, type))), job);
}

template <class Data>
void expect_result_to_travel(const Data& data) {
  const JobStats stats{1.0 / 3, (std::uint64_t{1} << 40) + 5, "host:7"};
  for (const ContentType type : both_encodings) {
    const JobResult back = decode_result(encode_result({data, stats}, type));
    expect_same_fields(std::get<Data>(back.data), data);
    expect_same_fields(back.stats, stats);
  }
}

TEST(JobCodec, EveryFieldOfAProbeJobTravels) {
  expect_to_travel(test::some_probe_job(bake::BakeStage::gen));
  expect_to_travel(test::some_probe_job(bake::BakeStage::viz));
}

// As the fields of a tile job that stay at home have their defaults in the example, it is the same after the
// journey.
TEST(JobCodec, EveryFieldOfATileJobTravels) {
  TileJob job = test::some_tile_job();
  expect_to_travel(job);
  job.lighting.reset();
  for (const auto projection :
       {trace::Projection::pinhole, trace::Projection::orthographic, trace::Projection::equirect}) {
    job.params.projection = projection;
    expect_to_travel(job);
  }
  job.params.per_group = false, job.layers = {trace::RenderLayer::color};
  job.params.camera.camera.orthographic = false;
  expect_to_travel(job);
}

TEST(JobCodec, EveryFieldOfATransportJobTravels) {
  TransportJob job = test::some_transport_job();
  expect_to_travel(job);
  job.params.records.within = {};
  for (const ContentType type : both_encodings)
    EXPECT_EQ(std::get<TransportJob>(decode_job(encode_job(job, type))).params.records.within,
              probes::TileBox());
}

TEST(JobCodec, EveryFieldOfATransportResultTravels) {
  const probes::ProbeSet set = ssphh::test::random_set(5, 3, 2);
  TransportJobResult result;
  result.degree = 2;
  result.light_groups = {"lamp", "the \"sky\""};
  result.surfel_size = 1.0f / 3;
  for (const probes::Probe& probe : set.probes) {
    result.light.push_back(probe.groups);
    result.edges.push_back(probe.edges);
  }
  result.records = ssphh::test::random_records(9, 20, 2);
  result.records->direct = {{}, result.records->groups[0]};
  bake::TransportBakeReport& r = result.report;
  r.surfels = 11, r.links = 12, r.finest_surfel = 0.1f, r.coarsest_surfel = 0.7f, r.iterations = 13;
  r.contraction = 1.0 / 3, r.error = 1e-3f, r.lost = 1.0 / 7, r.records = 20, r.seconds = 0.1;
  r.viz_seconds = 0.2, r.record_seconds = 0.3, r.rays = std::uint64_t{1} << 40,
  r.warnings = {"mind", "the gap"};
  for (const ContentType type : both_encodings) {
    const JobResult back = decode_result(encode_result({result, {}}, type));
    const auto& b = std::get<TransportJobResult>(back.data);
    EXPECT_EQ(b.degree, 2);
    EXPECT_EQ(b.light_groups, result.light_groups);
    EXPECT_EQ(b.surfel_size, result.surfel_size);
    EXPECT_EQ(b.light, result.light);
    EXPECT_EQ(b.edges, result.edges);
    ASSERT_TRUE(b.records.has_value());
    EXPECT_EQ(*b.records, *result.records);
    const bake::TransportBakeReport& now = b.report;
    EXPECT_EQ(std::tie(now.surfels, now.links, now.finest_surfel, now.coarsest_surfel, now.iterations,
                       now.contraction, now.error, now.lost, now.records, now.rays, now.warnings),
              std::tie(r.surfels, r.links, r.finest_surfel, r.coarsest_surfel, r.iterations, r.contraction,
                       r.error, r.lost, r.records, r.rays, r.warnings));
    EXPECT_EQ(std::tie(now.seconds, now.viz_seconds, now.record_seconds),
              std::tie(r.seconds, r.viz_seconds, r.record_seconds));
  }
  result.records.reset(), result.light.clear();
  const JobResult back = decode_result(encode_result({result, {}}, ContentType::json));
  EXPECT_FALSE(std::get<TransportJobResult>(back.data).records.has_value());
}

TEST(JobCodec, RecordsOfAResultThatAreNotWholeAreRefused) {
  TransportJobResult result;
  result.records = ssphh::test::random_records(9, 2, 1);
  const std::string text = encode_result({result, {}}, ContentType::json);
  const auto problem = [&](const std::function<void(json::Value&)>& change) {
    json::Value document = json::parse(text, "test");
    change(document["records"]);
    return ssphh::test::message_of([&] { decode_result(json::print(document)); });
  };
  EXPECT_THAT(problem([](auto& r) { r["normals"].push_back(1.0); }), testing::HasSubstr("records.normals"));
  EXPECT_THAT(problem([](auto& r) { r["groups"][0]["values"].push_back(1.0); }),
              testing::HasSubstr("records.groups[0].values: must be nine"));
  EXPECT_THAT(problem([](auto& r) { r["groups"][0]["values"][3] = 32768.0; }),
              testing::HasSubstr("must lie in -32767..32767"));
  EXPECT_THAT(problem([](auto& r) {
                r["direct"] = json::Value::array({r["groups"][0], r["groups"][0]});
              }),
              testing::HasSubstr("records"));
}

// The words of a job are those of the tables; any others are refused when it is read.
TEST(JobCodec, WordsOfATileJobAreTheTables) {
  TileJob job = test::some_tile_job();
  job.lighting->lookup = {};
  const std::string text = encode_job(job, ContentType::json);
  const auto with = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return std::string(text).replace(at, from.size(), to);
  };
  const auto lookup = [](const std::string& body) {
    return std::get<TileJob>(decode_job(body)).lighting->lookup;
  };
  EXPECT_EQ(lookup(text), probes::LookupSpec());
  EXPECT_EQ(lookup(with(R"("weights":"")", R"("weights":"trilinear")")).weights,
            probes::WeightMethod::trilinear);
  EXPECT_EQ(lookup(with(R"("lookup":"irradiance")", R"("lookup":"light")")).method,
            probes::LookupMethod::light);
  EXPECT_EQ(lookup(with(R"("layer":"sum")", R"("layer":"self")")).layer, probes::ProbeLayer::self);
  const auto problem = [&](const std::string& from, const std::string& to) {
    return ssphh::test::message_of([&] { decode_job(with(from, to)); });
  };
  EXPECT_EQ(problem(R"("lookup":"irradiance")", R"("lookup":"")"),
            "job: lighting.lookup: \"\" is none of: light, irradiance");
  EXPECT_EQ(problem(R"("weights":"")", R"("weights":"idw")"),
            "job: lighting.weights: \"idw\" is none of: distance, trilinear, mls, fitted, surface");
  EXPECT_EQ(problem(R"("layer":"sum")", R"("layer":"all")"),
            "job: lighting.layer: \"all\" is none of: self, neighbor, sum");
  EXPECT_EQ(problem(R"("projection":"cube_strip")", R"("projection":"cube")"),
            "job: projection: \"cube\" is none of: pinhole, orthographic, equirect, cube_strip");
  EXPECT_EQ(problem(R"("layers":["direct")", R"("layers":["light")"),
            "job: layers[0]: \"light\" is none of: color, direct, indirect, albedo, normal, depth, coverage, "
            "groups");
  EXPECT_EQ(problem(R"("kind":"ref")", R"("kind":"tile")"),
            "job: kind: \"tile\" is none of: gen, viz, ref, transport");
}

/// Coefficients that are all different.
sh::RadianceSh some_function(int degree, float first) {
  sh::RadianceSh function(degree);
  for (vec3& v : function.values)
    for (int c = 0; c < 3; ++c) v[c] = first *= 1.01f;
  return function;
}

TEST(JobCodec, EveryFieldOfAGenResultTravels) {
  ProbeJobResult result{bake::BakeStage::gen, 2, {}};
  for (const std::uint32_t probe : {3u, 65535u}) {
    const auto x = static_cast<float>(probe);
    result.probes.push_back({{bake::BakeStage::gen, probe},
                             0.1 * probe,
                             (std::uint64_t{1} << 41) + probe,
                             {{some_function(2, x), some_function(2, -x)}, {{}, some_function(2, 0.1f * x)}},
                             {}});
  }
  expect_result_to_travel(result);
}

TEST(JobCodec, EveryFieldOfAVizResultTravels) {
  ProbeJobResult result{bake::BakeStage::viz, 2, {{{bake::BakeStage::viz, 5}, 0.7, 9, {}, {}}}};
  for (const int from : {2, 8}) {
    const float x = 0.1f * static_cast<float>(from);
    probes::Edge edge{from, x, some_function(2, x), sh::TransferMatrix(2, 2)};
    edge.matrix.values = some_function(8, x + 1).values;  // 9 × 9, as the matrix
    result.probes[0].edges.push_back(std::move(edge));
  }
  result.probes[0].edges.push_back({9, 1.0f / 3, some_function(2, 4), {}});
  expect_result_to_travel(result);
}

image::Image some_image(const trace::Tile& tile, int channels, float first) {
  image::Image image(tile.width, tile.height, channels);
  for (float& value : image.pixels) value = first *= 1.01f;
  return image;
}

// What probe files refuse is refused here as well: the codec is the same (gi/probe_codec.h).
TEST(JobCodec, EdgesOfAResultAreThoseOfAProbeSet) {
  const auto read = [](const std::string& edges) {
    return ssphh::test::message_of([&] {
      decode_result(R"({"format":"ssphh-result","version":2,"kind":"viz","degree":0,"probes":[)"
                    R"({"probe":5,"seconds":1,"rays":2,"edges":[)" +
                    edges + R"(]}],"stats":{"seconds":1,"rays":3,"worker":"w"}})");
    });
  };
  const auto edge = [](int from, const std::string& more) {
    return R"({"from":)" + std::to_string(from) + "," + more + "}";
  };
  const std::string sound = R"("transfer":0.5,"h":[1,2,3])", at = "result: probes[0].edges";
  EXPECT_EQ(read(edge(2, sound) + "," + edge(8, sound + R"(,"matrix":[1,2,3])")), "no error");
  for (const int second : {1, 2, 5})
    EXPECT_EQ(read(edge(2, sound) + "," + edge(second, sound)),
              at + "[1].from: must be another probe's index, in ascending order");
  EXPECT_NE(read(edge(65536, sound)), "no error");
  EXPECT_EQ(read(edge(2, R"("transfer":0.5,"h":[1,2])")), at + "[0].h: must be 3 numbers, not 2");
  EXPECT_EQ(read(edge(2, R"("transfer":0.5,"h":[])")), at + "[0].h: must be 3 numbers, not 0");
  EXPECT_EQ(read(edge(2, sound + R"(,"matrix":[])")), at + "[0].matrix: must be 3 numbers, not 0");
  EXPECT_EQ(read(edge(2, R"("transfer":1.5,"h":[1,2,3])")), "no error") << "an SPHL that is near";
  EXPECT_NE(read(edge(2, R"("transfer":-0.5,"h":[1,2,3])")), "no error");
  EXPECT_NE(read(edge(2, sound + R"(,"weight":1)")), "no error") << "of a later version";
}

TEST(JobCodec, EveryFieldOfATileResultTravels) {
  TileJobResult result;
  for (const trace::Tile& tile : {trace::Tile{7, 8, 3, 2}, trace::Tile{10, 8, 2, 4}}) {
    trace::RenderState state;
    state.passes_done = 3 + tile.x, state.paths = (std::uint64_t{1} << 42) + 5;
    state.rays = (std::uint64_t{1} << 43) + 6;
    float first = 0.3f;
    for (image::Image* i : {&state.color, &state.direct, &state.indirect, &state.albedo, &state.normal})
      *i = some_image(tile, 3, first += 1);
    state.depth = some_image(tile, 1, 9.1f), state.coverage = some_image(tile, 1, 0.01f);
    state.groups = {some_image(tile, 3, 11.1f), some_image(tile, 3, 13.1f)};
    result.tiles.push_back({tile, state});
  }
  expect_result_to_travel(result);

  // Images that were not asked for stay empty.
  result.tiles[1].state.albedo = {}, result.tiles[1].state.groups.clear();
  result.tiles[0].state.color = {}, result.tiles[0].state.depth = {};
  expect_result_to_travel(result);
}

}  // namespace
}  // namespace ssphh::farm
