/// What a killed bake leaves behind: nothing that was done is done again, and nothing that is not whole or is
/// another bake's is used.

#include "checkpoint.h"

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/probes/probe_file.h>

#include "bake_fields.h"
#include "fake_source.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh::bake {
namespace {

using test::FakeSource;
using test::TempDir;

CheckpointRecord record(BakeStage stage, std::uint32_t probe, std::size_t bytes) {
  CheckpointRecord r{stage, probe, 0.1 * probe + 1.0 / 3, (std::uint64_t{1} << 40) + probe, {}};
  for (std::size_t i = 0; i < bytes; ++i) r.payload.push_back(static_cast<std::byte>(7 * i + probe));
  return r;
}

/// Without write_file's sync, which takes longer than the rest of a test.
void put(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// GEN and VIZ; one record holds nothing.
const std::vector<CheckpointRecord> three = {record(BakeStage::gen, 4, 30), record(BakeStage::viz, 0, 0),
                                             record(BakeStage::viz, 65535, 21)};

void expect_equal(const std::vector<CheckpointRecord>& got, std::span<const CheckpointRecord> wanted,
                  const std::string& what) {
  ASSERT_EQ(got.size(), wanted.size()) << what;
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].stage, wanted[i].stage) << what << ", record " << i;
    EXPECT_EQ(got[i].probe, wanted[i].probe) << what << ", record " << i;
    EXPECT_EQ(got[i].seconds, wanted[i].seconds) << what << ", record " << i;
    EXPECT_EQ(got[i].rays, wanted[i].rays) << what << ", record " << i;
    EXPECT_EQ(got[i].payload, wanted[i].payload) << what << ", record " << i;
  }
}

/// A file of three records, and how long it was after each.
class CheckpointFile : public testing::Test {
 protected:
  CheckpointFile() {
    Checkpoint checkpoint(file, key);
    ends.push_back(std::filesystem::file_size(file));
    for (const CheckpointRecord& r : three) {
      checkpoint.append(r);
      ends.push_back(std::filesystem::file_size(file));
    }
    whole = read_file(file);
  }
  /// The file is `bytes`, of which the first `count` records are good: they are read, and what is appended
  /// then stands right behind them.
  void expect_good(std::span<const std::byte> bytes, std::size_t count, const std::string& what) {
    put(file, bytes);
    const CheckpointRecord next = record(BakeStage::gen, 17, 9);
    {
      Checkpoint checkpoint(file, key);
      expect_equal(checkpoint.records(), std::span(three).first(count), what);
      EXPECT_EQ(std::filesystem::file_size(file), ends[count]) << what << ": the torn end stays in the file";
      checkpoint.append(next);
    }
    std::vector<CheckpointRecord> wanted(three.begin(), three.begin() + static_cast<std::ptrdiff_t>(count));
    wanted.push_back(next);
    expect_equal(Checkpoint(file, key).records(), wanted, what + ", and one appended");
  }

  TempDir dir{test::memory_dir()};
  const std::filesystem::path file = dir / "checkpoint";
  const Hash128 key{0x0123456789abcdef, 0xfedcba9876543210};
  std::vector<std::size_t> ends;  ///< of the header, then of each record
  std::vector<std::byte> whole;
};

TEST_F(CheckpointFile, BeginsWithItsFormatsName) {
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(whole.data()), 8), "SPHLCKP1");
  EXPECT_EQ(ends[0], 8u + 16) << "and its key";
}

TEST_F(CheckpointFile, GivesBackWhatWasAppended) {
  expect_good(whole, 3, "whole");
}

TEST_F(CheckpointFile, CutAtAnyByteHoldsTheRecordsBeforeTheCut) {
  for (std::size_t size = ends[0]; size < whole.size(); ++size) {
    std::size_t count = 0;
    while (ends[count + 1] <= size) ++count;
    expect_good(std::span(whole).first(size), count, "cut at " + std::to_string(size));
  }
}

TEST_F(CheckpointFile, CutWithinItsHeaderHoldsNothing) {
  for (std::size_t size = 0; size < ends[0]; ++size)
    expect_good(std::span(whole).first(size), 0, "cut at " + std::to_string(size));
}

// A disk may have given the file its length before its bytes.
TEST_F(CheckpointFile, GarbageBehindTheLastRecordIsDropped) {
  for (const std::byte garbage : {std::byte{0}, std::byte{1}, std::byte{0xff}}) {
    for (std::size_t count = 0; count < 4; ++count) {
      for (const std::size_t length : {1, 8, 44, 45, 46, 200}) {
        std::vector<std::byte> bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(ends[count]));
        bytes.resize(bytes.size() + length, garbage);
        expect_good(bytes, count, std::to_string(count) + " records and garbage");
      }
    }
  }
}

TEST_F(CheckpointFile, ADamagedRecordEndsIt) {
  for (std::size_t i = ends[1]; i < ends[2]; ++i) {
    std::vector<std::byte> bytes = whole;
    bytes[i] ^= std::byte{4};
    expect_good(bytes, 1, "byte " + std::to_string(i) + " is damaged");
  }
}

TEST_F(CheckpointFile, OfAnotherKeyIsReplaced) {
  for (const Hash128& other : {Hash128{key.high ^ 1, key.low}, Hash128{key.high, key.low ^ 1}}) {
    put(file, whole);
    EXPECT_TRUE(Checkpoint(file, other).records().empty());
    EXPECT_EQ(std::filesystem::file_size(file), ends[0]);
    EXPECT_TRUE(Checkpoint(file, key).records().empty()) << "the file is the other bake's now";
  }
}

TEST_F(CheckpointFile, OfAnotherFormatIsReplaced) {
  std::vector<std::byte> other = whole;
  other[7] = std::byte{'2'};
  expect_good(other, 0, "version 2");
}

// --- resumed bakes

probes::ProbeSet some_places() {
  probes::ProbeSet set;
  set.degree = 1;
  set.generator.scene = "room";
  set.generator.scene_hash = {12, 34};
  for (const vec3& position : {vec3(0, 0.1f, 0.2f), vec3(0.9f, 0, 0.3f), vec3(0.2f, 0.8f, 0)})
    set.probes.push_back({"SPHL" + std::to_string(set.probes.size()),
                          position,
                          0.1f + 0.05f * static_cast<float>(set.probes.size()),
                          {},
                          {},
                          {},
                          {}});
  return set;
}

const std::vector<std::string> sun_and_lamp = {"sun", "lamp"};

void light(FakeSource& source) {
  source.groups = sun_and_lamp;
  source.reflected = {[](const vec3& p, const vec3& d) { return vec3(2 + glm::dot(p, d), 1 + p.x, 0.5f); },
                      [](const vec3& p, const vec3& d) { return vec3(0.3f, 2 + d.y * p.z, 1); }};
}

BakeParams small_bake() {
  BakeParams params;
  params.face_size = 4;
  params.path = {2, 1, 2, 11};
  return params;
}

/// The bake is stopped at the start of its cube `stop`, of three of GEN and three of VIZ; −1: it is not.
/// Returns how many cubes were traced.
int bake_until(int stop, const probes::ProbeSet& start, const std::filesystem::path& checkpoint,
               BakeReport& report, probes::ProbeSet& result) {
  FakeSource source;
  light(source);
  int cubes = 0;
  source.on_cube = [&] {
    if (cubes == stop) throw Cancelled();
    ++cubes;
  };
  try {
    result = bake(source, start, small_bake(), checkpoint, report);
  } catch (const Cancelled&) {
  }
  return cubes;
}

TEST(Checkpoint, ABakeThatIsKilledTwiceDoesEveryUnitOnceAndGivesTheSameBits) {
  const TempDir dir(test::memory_dir());
  BakeReport report;
  probes::ProbeSet set;
  bake_until(-1, some_places(), {}, report, set);
  const auto whole = probes::probes_to_binary(set);
  const std::uint64_t rays = report.rays;
  for (int first = 0; first <= 5; ++first) {
    for (int second = 0; first + second <= 5; ++second) {
      const auto file = dir / (std::to_string(first) + "-" + std::to_string(second));
      int cubes = bake_until(first, some_places(), file, report, set);
      cubes += bake_until(second, some_places(), file, report, set);
      cubes += bake_until(-1, some_places(), file, report, set);
      EXPECT_EQ(cubes, 6) << "every unit once, killed after " << first << " and " << second;
      EXPECT_EQ(report.resumed, static_cast<std::size_t>(first + second));
      EXPECT_EQ(report.rays, rays) << "those of the earlier parts included";
      EXPECT_EQ(probes::probes_to_binary(set), whole) << "killed after " << first << " and " << second;
    }
  }
}

TEST(Checkpoint, ARecordThatIsDamagedIsTracedAgain) {
  const TempDir dir(test::memory_dir());
  BakeReport report;
  probes::ProbeSet set;
  bake_until(-1, some_places(), {}, report, set);
  const auto whole = probes::probes_to_binary(set);
  bake_until(4, some_places(), dir / "good", report, set);
  const auto good = read_file(dir / "good");
  for (std::size_t i = 24; i < good.size(); i += 11) {
    auto bytes = good;
    bytes[i] ^= std::byte{0x10};
    put(dir / "damaged", bytes);
    const int cubes = bake_until(-1, some_places(), dir / "damaged", report, set);
    EXPECT_GE(cubes, 3) << "byte " << i;
    EXPECT_EQ(report.resumed, static_cast<std::size_t>(6 - cubes)) << "byte " << i;
    EXPECT_EQ(probes::probes_to_binary(set), whole) << "byte " << i;
  }
}

/// What a bake is asked for.
struct BakeRequest {
  BakeParams params = small_bake();
  int degree = 1;
  probes::GeneratorInfo generator;
  std::vector<std::string> groups;
  std::vector<std::string> names;
  std::vector<vec3> positions;
  std::vector<float> radii;
};

void fields(auto& visit, BakeRequest& r) {
  auto& [params, degree, generator, groups, names, positions, radii] = r;
  visit("params", params), visit("degree", degree), visit("generator", generator), visit("groups", groups);
  visit("names", names), visit("positions", positions), visit("radii", radii);
}

/// As many units as `request` takes from a checkpoint of some_places().
std::size_t resumed_by(const BakeRequest& request, const std::filesystem::path& checkpoint) {
  probes::ProbeSet set;
  set.degree = request.degree;
  set.generator = request.generator;
  for (std::size_t i = 0; i < request.positions.size() && i < request.radii.size(); ++i) {
    const std::string name = i < request.names.size() ? request.names[i] : "new";
    set.probes.push_back({name, request.positions[i], request.radii[i], {}, {}, {}, {}});
  }
  // Light that `keep_light` may keep.
  for (const std::string& group : request.groups) set.light_groups.push_back({group, vec3(1)});
  for (probes::Probe& probe : set.probes)
    probe.groups.assign(request.groups.size(), {{}, sh::RadianceSh(set.degree)});
  FakeSource source;
  light(source);
  source.groups = request.groups;
  BakeReport report;
  bake(source, set, request.params, checkpoint, report);
  return report.resumed;
}

TEST(Checkpoint, OfOtherParametersIsNotUsedWhicheverFieldItIs) {
  const TempDir dir(test::memory_dir());
  BakeReport report;
  probes::ProbeSet set;
  bake_until(2, some_places(), dir / "kept", report, set);
  BakeRequest request;
  request.generator = some_places().generator;
  request.groups = sun_and_lamp;
  for (const probes::Probe& probe : some_places().probes) {
    request.names.push_back(probe.name);
    request.positions.push_back(probe.position);
    request.radii.push_back(probe.radius);
  }
  const auto resumed = [&](const BakeRequest& asked) {
    std::filesystem::copy_file(dir / "kept", dir / "copy", std::filesystem::copy_options::overwrite_existing);
    return resumed_by(asked, dir / "copy");
  };
  ASSERT_EQ(resumed(request), 2u);
  const test::Undecisive undecisive = {
      {"params/only_groups/given", "a unit holds the light of all groups"},
      {"generator/op", "what the bake makes is of op path"},
      {"generator/viz", "likewise"},
      {"generator/viz_source", "likewise"},
      {"generator/viz_paths", "likewise"},
      {"generator/viz_max_depth", "likewise"},
      {"generator/viz_passes", "likewise"},
      {"generator/viz_spp", "likewise"},
      {"generator/gen", "the bake's parameters replace it"},
      {"generator/max_depth", "likewise"},
      {"generator/passes", "likewise"},
      {"generator/spp", "likewise"},
      {"generator/face_size", "likewise"},
      {"generator/seed", "likewise"},
      {"generator/directions", "of a transport network"},
      {"generator/surfel_size", "of a transport network"},
      {"generator/link_rays", "of a transport network"},
      {"generator/scene", "a name for people; generator/scene_hash is the scene"},
  };
  test::with_each_field_changed(request, [&](const std::string& field, const BakeRequest& changed) {
    if (field.ends_with("/size")) return;  // a list that is longer than its neighbours is none
    const bool decides = !undecisive.contains(field);
    EXPECT_EQ(resumed(changed), decides ? 0u : 2u) << field;
  });
}

}  // namespace
}  // namespace ssphh::bake
