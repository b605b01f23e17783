#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <ssphh/probes/probe_file.h>

#include "bake_helpers.h"
#include "temp_dir.h"

namespace ssphh::bake {
namespace {

using test::constant;
using test::FakeSource;

TEST(Bake, ResumedAfterAStopAtAnyProbeGivesTheSameBits) {
  const test::TempDir dir;
  FakeSource source;
  source.reflected = {[](const vec3& p, const vec3& d) { return vec3(2 + glm::dot(p, d), 1, 0.5f); }};
  const probes::ProbeSet start = test::places(test::four_places, 0.2f, 3);
  const auto whole = probes::probes_to_binary(test::bake_now(source, start, test::small()));
  const auto checkpoint = dir / "out.checkpoint";
  for (int stop = 0; stop < 8; ++stop) {
    // The work ends at cube `stop` (four of GEN, then four of VIZ), as after a kill.
    int cubes = 0;
    source.on_cube = [&] {
      if (cubes++ == stop) throw Cancelled();
    };
    BakeReport report;
    EXPECT_THROW(bake(source, start, test::small(), checkpoint, report), Cancelled);
    ASSERT_TRUE(std::filesystem::exists(checkpoint));
    source.on_cube = [&] { ++cubes; };
    cubes = 0;
    const probes::ProbeSet resumed = bake(source, start, test::small(), checkpoint, report);
    EXPECT_EQ(cubes, 8 - stop) << "finished cubes are not traced again";
    EXPECT_EQ(report.resumed, static_cast<std::size_t>(stop));
    EXPECT_EQ(probes::probes_to_binary(resumed), whole);
    std::filesystem::remove(checkpoint);
  }
}

TEST(Bake, ACheckpointCutOffAnywhereOrOfAnotherBakeIsNotTrusted) {
  const test::TempDir dir;
  const auto checkpoint = dir / "out.checkpoint";
  FakeSource source;
  source.reflected = {constant(vec3(1, 2, 3))};
  const probes::ProbeSet start =
      test::places({test::four_places.begin(), test::four_places.begin() + 2}, 0.2f, 0);
  const auto whole = probes::probes_to_binary(test::bake_now(source, start, test::small(4, 1)));
  int cubes = 0;
  const auto stop_at = [&](int stop) {
    cubes = 0;
    source.on_cube = [&cubes, stop] {
      if (cubes++ == stop) throw Cancelled();
    };
  };
  BakeReport report;
  stop_at(3);
  EXPECT_THROW(bake(source, start, test::small(4, 1), checkpoint, report), Cancelled);
  stop_at(-1);
  std::ifstream in(checkpoint, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  ASSERT_GT(bytes.size(), 100u);
  for (std::size_t size = 0; size < bytes.size(); size += 5) {
    std::ofstream(checkpoint, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(size));
    EXPECT_EQ(probes::probes_to_binary(bake(source, start, test::small(4, 1), checkpoint, report)), whole)
        << size;
  }
  // Other parameters: nothing is taken over.
  std::ofstream(checkpoint, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bake(source, start, test::small(4, 2), checkpoint, report);
  EXPECT_EQ(report.resumed, 0u);
}

TEST(Bake, ACheckpointThatCannotBeWrittenIsAnError) {
  const FakeSource source;
  BakeReport report;
  EXPECT_THROW(bake(source, test::places(test::four_places, 0.2f, 1), test::small(4, 1),
                    "/nonexistent/folder/file", report),
               Error);
}

}  // namespace
}  // namespace ssphh::bake
