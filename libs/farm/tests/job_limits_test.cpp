/// What no client may send: each limit at its edge, and one beyond.

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "job_fields.h"

namespace ssphh::farm {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

template <class T>
struct Case {
  const char* what;
  std::function<void(T&)> change;
};

template <class T>
void expect_allowed(const T& job, const std::vector<Case<T>>& cases) {
  for (const Case<T>& c : cases) {
    T changed = job;
    c.change(changed);
    EXPECT_NO_THROW(validate(changed)) << c.what;
  }
}

template <class T>
void expect_refused(const T& job, const std::vector<Case<T>>& cases) {
  ASSERT_NO_THROW(validate(job));
  for (const Case<T>& c : cases) {
    T changed = job;
    c.change(changed);
    EXPECT_THROW(validate(changed), Error) << c.what;
  }
}

/// As many probes as places, all alike.
void set_probes(ProbeJob& job, std::size_t count) {
  job.probes.resize(count);
  std::iota(job.probes.begin(), job.probes.end(), 0u);
  job.places.assign(count, {{1, 2, 3}, 1});
}

TEST(JobLimits, OfProbeJobs) {
  for (const bake::BakeStage stage : {bake::BakeStage::gen, bake::BakeStage::viz}) {
    const ProbeJob job = test::some_probe_job(stage);
    expect_allowed<ProbeJob>(job, {{"depth", [](auto& j) { j.path.max_depth = 65535; }},
                                   {"no depth", [](auto& j) { j.path.max_depth = 0; }},
                                   {"degree", [](auto& j) { j.degree = sh::max_degree; }},
                                   {"no degree", [](auto& j) { j.degree = 0; }},
                                   {"face", [](auto& j) { j.face_size = 4096; }},
                                   {"one texel", [](auto& j) { j.face_size = 1; }},
                                   {"probes", [](auto& j) { set_probes(j, 4096); }}});
    expect_refused<ProbeJob>(job, {{"time", [](auto& j) { j.scene.time = infinite; }},
                                   {"depth", [](auto& j) { j.path.max_depth = 65536; }},
                                   {"negative depth", [](auto& j) { j.path.max_depth = -1; }},
                                   {"passes", [](auto& j) { j.path.passes = 0; }},
                                   {"samples", [](auto& j) { j.path.spp = 0; }},
                                   {"degree", [](auto& j) { j.degree = sh::max_degree + 1; }},
                                   {"negative degree", [](auto& j) { j.degree = -1; }},
                                   {"face", [](auto& j) { j.face_size = 4097; }},
                                   {"no face", [](auto& j) { j.face_size = 0; }},
                                   {"no probes", [](auto& j) { j.probes.clear(); }},
                                   {"probes", [](auto& j) { set_probes(j, 4097); }},
                                   {"equal probes", [](auto& j) { j.probes[1] = j.probes[0]; }},
                                   {"falling probes", [](auto& j) { std::swap(j.probes[0], j.probes[1]); }},
                                   {"place", [](auto& j) { j.places[1].position.y = not_a_number; }},
                                   {"radius", [](auto& j) { j.places[2].radius = 0; }},
                                   {"endless radius", [](auto& j) { j.places[2].radius = infinite; }}});
  }
}

TEST(JobLimits, OfTransportJobs) {
  const TransportJob job = test::some_transport_job();
  const auto place = [](TransportJob& j, std::size_t count) { j.places.assign(count, {{1, 2, 3}, 1}); };
  expect_allowed<TransportJob>(job, {{"places", [&](auto& j) { place(j, job_limits::tile_places); }},
                                     {"one place", [&](auto& j) { place(j, 1), j.params.own_probes = 1; }},
                                     {"all own", [](auto& j) { j.params.own_probes = 3; }},
                                     {"degree", [](auto& j) { j.degree = sh::max_degree; }},
                                     {"directions", [](auto& j) { j.params.transport.directions = 8; }},
                                     {"surfel size", [](auto& j) { j.params.transport.surfel_size = 0; }},
                                     {"samples", [](auto& j) { j.params.transport.samples = 32; }},
                                     {"no records", [](auto& j) { j.params.records.points = 0; }},
                                     {"records", [](auto& j) { j.params.records.points = 65536; }}});
  expect_refused<TransportJob>(
      job, {{"time", [](auto& j) { j.scene.time = infinite; }},
            {"degree", [](auto& j) { j.degree = sh::max_degree + 1; }},
            {"places", [&](auto& j) { place(j, job_limits::tile_places + 1); }},
            {"no places", [&](auto& j) { place(j, 0); }},
            {"none own", [](auto& j) { j.params.own_probes = 0; }},
            {"too many own", [](auto& j) { j.params.own_probes = 4; }},
            {"place", [](auto& j) { j.places[1].position.y = not_a_number; }},
            {"radius", [](auto& j) { j.places[2].radius = 0; }},
            {"bounce", [](auto& j) { j.params.op = probes::LightOperator::bounce; }},
            {"fit", [](auto& j) { j.params.fit = true; }},
            {"directions", [](auto& j) { j.params.transport.directions = 7; }},
            {"link rays", [](auto& j) { j.params.transport.link_rays = 3; }},
            {"samples", [](auto& j) { j.params.transport.samples = 33; }},
            {"surfel size", [](auto& j) { j.params.transport.surfel_size = not_a_number; }},
            {"per radius", [](auto& j) { j.params.transport.surfels_per_radius = 0; }},
            {"surfels", [](auto& j) { j.params.transport.most_surfels = 0; }},
            {"records", [](auto& j) { j.params.records.points = 65537; }},
            {"record rays", [](auto& j) { j.params.records.rays = 3; }},
            {"groups", [](auto& j) { j.params.records.baked.assign(257, 0); }}});
}

// GEN has the places of its probes and any index of a set; VIZ has the set's places, and its probes among
// them.
TEST(JobLimits, OfPlacesOfAStage) {
  const ProbeJob gen = test::some_probe_job(bake::BakeStage::gen),
                 viz = test::some_probe_job(bake::BakeStage::viz);
  expect_allowed<ProbeJob>(gen, {{"index", [](auto& j) { j.probes = {7, 9, 65535}; }}});
  expect_refused<ProbeJob>(gen, {{"index",
                                  [](auto& j) {
                                    j.probes = {7, 9, 65536};
                                  }},
                                 {"a place more", [](auto& j) { j.places.push_back(j.places[0]); }}});
  expect_allowed<ProbeJob>(viz, {{"last place", [](auto& j) { j.probes = {2}; }},
                                 {"places", [](auto& j) { j.places.resize(65536, j.places[0]); }}});
  expect_refused<ProbeJob>(viz, {{"no such place", [](auto& j) { j.probes = {3}; }},
                                 {"places", [](auto& j) { j.places.resize(65537, j.places[0]); }}});
}

TEST(JobLimits, OfTileJobs) {
  const TileJob job = test::some_tile_job();
  const auto picture = [](TileJob& j, int width, int height, const trace::Tile& tile) {
    j.params.width = width, j.params.height = height;
    j.tiles = {tile};
  };
  expect_allowed<TileJob>(
      job, {{"picture",
             [&](auto& j) {
               picture(j, 65536, 65536, {65535, 65535, 1, 1});
             }},
            {"tile",
             [&](auto& j) {
               picture(j, 2000, 2000, {976, 976, 1024, 1024});
             }},
            {"tiles",
             [](auto& j) {
               j.tiles.assign(4096, {0, 0, 32, 32});
             }},
            {"sum", [](auto& j) { j.lighting->lookup.layer = probes::ProbeLayer::sum; }},
            {"irradiance", [](auto& j) { j.lighting->lookup.method = probes::LookupMethod::irradiance; }}});
  expect_refused<TileJob>(
      job, {{"time", [](auto& j) { j.scene.time = not_a_number; }},
            {"width",
             [&](auto& j) {
               picture(j, 65537, 10, {0, 0, 1, 1});
             }},
            {"height",
             [&](auto& j) {
               picture(j, 10, 65537, {0, 0, 1, 1});
             }},
            {"no width",
             [&](auto& j) {
               picture(j, 0, 10, {0, 0, 1, 1});
             }},
            {"wide tile",
             [&](auto& j) {
               picture(j, 2000, 2000, {0, 0, 1025, 1});
             }},
            {"high tile",
             [&](auto& j) {
               picture(j, 2000, 2000, {0, 0, 1, 1025});
             }},
            {"no tiles", [](auto& j) { j.tiles.clear(); }},
            {"tiles",
             [](auto& j) {
               j.tiles.assign(4097, {0, 0, 1, 1});
             }},
            {"tile without width", [](auto& j) { j.tiles[1].width = 0; }},
            {"tile without height", [](auto& j) { j.tiles[1].height = 0; }},
            {"left of it", [](auto& j) { j.tiles[1].x = -1; }},
            {"above it", [](auto& j) { j.tiles[1].y = -1; }},
            {"right of it", [](auto& j) { j.tiles[1].x = j.params.width - j.tiles[1].width + 1; }},
            {"below it", [](auto& j) { j.tiles[1].y = j.params.height - j.tiles[1].height + 1; }},
            {"no layers", [](auto& j) { j.layers.clear(), j.params.per_group = false; }},
            {"layers out of order", [](auto& j) { std::swap(j.layers[0], j.layers[1]); }},
            {"doubled layer", [](auto& j) { j.layers[1] = j.layers[0]; }},
            {"groups without per_group", [](auto& j) { j.params.per_group = false; }},
            {"per_group without groups", [](auto& j) { j.layers.pop_back(); }},
            {"layer", [](auto& j) { j.lighting->lookup.layer = probes::ProbeLayer::neighbor; }}});
}

// 2^40 paths, 2^32 samples of a pixel, 2^22 pixels.
TEST(JobLimits, OfTheWorkOfOneJob) {
  ProbeJob probes = test::some_probe_job(bake::BakeStage::gen);
  probes.probes = {0}, probes.places.resize(1);
  probes.face_size = 1;
  TileJob tiles = test::some_tile_job();
  const std::int64_t most = std::int64_t{1} << 40;
  for (const int edge : {111, 128, 4000}) {
    const std::int64_t texels = 6 * edge * edge, samples = most / texels;
    probes.face_size = edge;
    probes.path.passes = 1, probes.path.spp = static_cast<int>(samples);
    EXPECT_NO_THROW(validate(probes)) << edge;
    ++probes.path.spp;
    EXPECT_THROW(validate(probes), Error) << edge;
  }
  probes.face_size = 1;
  probes.path.passes = 1 << 16, probes.path.spp = (1 << 16) - 1;
  EXPECT_NO_THROW(validate(probes));
  ++probes.path.spp;
  EXPECT_THROW(validate(probes), Error) << "2^32 samples";
  probes.path = {1, (1 << 24) + 1, 1, 0};
  EXPECT_THROW(validate(probes), Error) << "passes";
  probes.path = {1, 1, (1 << 24) + 1, 0};
  EXPECT_THROW(validate(probes), Error) << "samples";

  tiles.params.width = tiles.params.height = 4096;
  tiles.tiles.assign(4, {0, 0, 1024, 1024});
  tiles.params.path.passes = 1 << 9, tiles.params.path.spp = 1 << 9;
  EXPECT_NO_THROW(validate(tiles)) << "2^22 pixels of 2^18 samples";
  ++tiles.params.path.spp;
  EXPECT_THROW(validate(tiles), Error) << "paths";
  tiles.params.path.spp = 1;
  EXPECT_NO_THROW(validate(tiles));
  tiles.tiles.push_back({0, 0, 1, 1});
  EXPECT_THROW(validate(tiles), Error) << "pixels";
}

}  // namespace
}  // namespace ssphh::farm
