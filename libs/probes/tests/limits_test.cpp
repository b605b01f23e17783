/// Every number of a set at its limits, which all formats hold, and just beyond them, which nothing writes or
/// reads.

#include <cmath>
#include <cstring>
#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/core/hash.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/probes/probe_limits.h>

#include "error_message.h"
#include "random_set.h"

namespace ssphh::probes {
namespace {

using test::message_of;

struct Number {
  std::string at;
  double low, high;
  std::function<void(ProbeSet&, double)> set;
  bool whole = false;
};

template <class T>
std::function<void(ProbeSet&, double)> into(T& (*member)(ProbeSet&)) {
  return [member](ProbeSet& s, double value) { member(s) = static_cast<T>(value); };
}

std::vector<Number> numbers() {
  using S = ProbeSet;
  constexpr double far = 1e9, most = 1e30, rays = 1 << 24;
  return {
      {"/generator/max_depth", 0, 65535, into<int>([](S& s) -> int& { return s.generator.max_depth; }), true},
      {"/generator/passes", 1, rays, into<int>([](S& s) -> int& { return s.generator.passes; }), true},
      {"/generator/spp", 1, rays, into<int>([](S& s) -> int& { return s.generator.spp; }), true},
      {"/generator/viz_max_depth", 0, 65535,
       into<int>([](S& s) -> int& { return s.generator.viz_max_depth; }), true},
      {"/generator/viz_passes", 1, rays, into<int>([](S& s) -> int& { return s.generator.viz_passes; }),
       true},
      {"/generator/viz_spp", 1, rays, into<int>([](S& s) -> int& { return s.generator.viz_spp; }), true},
      {"/generator/face_size", 1, 4096, into<int>([](S& s) -> int& { return s.generator.face_size; }), true},
      {"/generator/directions", 0, rays, into<int>([](S& s) -> int& { return s.generator.directions; }),
       true},
      {"/generator/link_rays", 0, rays, into<int>([](S& s) -> int& { return s.generator.link_rays; }), true},
      {"/generator/surfel_size", 0, far, into<float>([](S& s) -> float& { return s.generator.surfel_size; })},
      {"/generator/time", -far, far, into<float>([](S& s) -> float& { return s.generator.time; })},
      {"/light_groups/1/scale", 0, 1e6,
       into<float>([](S& s) -> float& { return s.light_groups[1].scale.z; })},
      {"/probes/2/position", -far, far, into<float>([](S& s) -> float& { return s.probes[2].position.y; })},
      {"/probes/1/radius", 1e-9, far, into<float>([](S& s) -> float& { return s.probes[1].radius; })},
      {"/probes/1/groups/1/emitted", -most, most,
       into<float>([](S& s) -> float& { return s.probes[1].groups[1].emitted[3].x; })},
      {"/probes/2/groups/0/reflected", -most, most,
       into<float>([](S& s) -> float& { return s.probes[2].groups[0].reflected[1].z; })},
      {"/probes/0/edges/1/transfer", 0, most,
       into<float>([](S& s) -> float& { return s.probes[0].edges[1].transfer; })},
      {"/probes/0/edges/1/h", -most, most,
       into<float>([](S& s) -> float& { return s.probes[0].edges[1].h[2].y; })},
      {"/probes/2/edges/0/matrix", -most, most,
       into<float>([](S& s) -> float& { return s.probes[2].edges[0].matrix.values[7].x; })},
      {"/hierarchy/threshold", 0, most, into<float>([](S& s) -> float& { return s.hierarchy->threshold; })},
      {"/probes/0/neighbor", -most, most,
       into<float>([](S& s) -> float& { return s.hierarchy->neighbor[0][2].y; })},
      {"/fitted/2/position", -far, far,
       into<float>([](S& s) -> float& { return s.fitted->points[2].position.z; })},
      {"/fitted/3/weights", 0, 1e6,
       into<float>([](S& s) -> float& { return s.fitted->weights[3].entries[1].weight; })}};
}

ProbeSet set_of_everything() {
  ProbeSet set = test::random_set(42, 3, 1, 2, true);
  hier(set, {HierOperator::mean, 2, 0.1f});
  set.fitted = test::random_fitted(7, 5, 3);
  return set;
}

/// A binary file in which the one number `from` became `to`, with its checksum mended.
std::vector<std::byte> replaced(std::vector<std::byte> file, std::uint32_t from, std::uint32_t to) {
  std::size_t found = 0;
  for (std::size_t i = 36; i + 4 <= file.size(); ++i) {
    if (std::memcmp(&file[i], &from, 4) != 0) continue;
    ++found;
    std::memcpy(&file[i], &to, 4);
  }
  EXPECT_EQ(found, 1u);
  const Hash128 sum = Hasher().bytes(std::span(file).subspan(36)).finish();
  std::memcpy(&file[20], &sum.high, 8), std::memcpy(&file[28], &sum.low, 8);
  return file;
}

TEST(Limits, OfEveryNumberAreWrittenAndReadAndNothingBeyondThem) {
  for (const Number& number : numbers()) {
    SCOPED_TRACE(number.at);
    const auto bits = [&](double v) {
      return number.whole ? static_cast<std::uint32_t>(static_cast<std::int64_t>(v))
                          : std::bit_cast<std::uint32_t>(static_cast<float>(v));
    };
    ProbeSet known = set_of_everything();
    const double inside = number.whole ? 3000 + number.low : 0.0123456789;
    number.set(known, inside);
    const std::vector<std::byte> file = probes_to_binary(known);
    for (const double limit : {number.low, number.high}) {
      ProbeSet set = set_of_everything();
      number.set(set, limit);
      merge_groups(set);
      EXPECT_EQ(message_of([&] { validate(set, "file"); }), "no error") << limit;
      EXPECT_EQ(message_of([&] { probes_from_binary(probes_to_binary(set), "file"); }), "no error") << limit;
      EXPECT_EQ(message_of([&] { probes_from_json(probes_to_json(set), "file"); }), "no error") << limit;
      const float endless =
          std::copysign(std::numeric_limits<float>::infinity(), limit > number.low ? 1.0f : -1.0f);
      const double beyond = number.whole
                                ? limit + (limit > number.low ? 1 : -1)
                                : static_cast<double>(std::nextafter(static_cast<float>(limit), endless));
      number.set(set, beyond);
      EXPECT_THAT(message_of([&] { validate(set, "file"); }),
                  testing::MatchesRegex("file at " + number.at + ": .* is not in .*\\.\\..*"))
          << beyond;
      EXPECT_NE(message_of([&] { probes_from_binary(replaced(file, bits(inside), bits(beyond)), "file"); }),
                "no error")
          << beyond;
    }
  }
}

TEST(Limits, OfNamesAndCounts) {
  const auto said = [](auto&& change) {
    ProbeSet set = set_of_everything();
    change(set);
    const std::string problem = message_of([&] { validate(set, "file"); });
    if (problem == "no error") {
      EXPECT_EQ(message_of([&] { probes_from_binary(probes_to_binary(set), "f"); }), problem);
      EXPECT_EQ(message_of([&] { probes_from_json(probes_to_json(set), "f"); }), problem);
    }
    return problem;
  };
  const std::string longest(1024, 'x'), too_long(1025, 'x'), problem = ": the name is longer than 1024 bytes";
  EXPECT_EQ(
      said([&](ProbeSet& s) { s.generator.scene = s.light_groups[0].name = s.probes[2].name = longest; }),
      "no error");
  EXPECT_EQ(said([&](ProbeSet& s) { s.generator.scene = too_long; }), "file at /generator/scene" + problem);
  EXPECT_EQ(said([&](ProbeSet& s) { s.light_groups[1].name = too_long; }),
            "file at /light_groups/1/name" + problem);
  EXPECT_EQ(said([&](ProbeSet& s) { s.probes[2].name = too_long; }), "file at /probes/2/name" + problem);
  for (const int good : {-1, 0, 65536})
    EXPECT_EQ(said([&](ProbeSet& s) { s.hierarchy->neighbors = good; }), "no error");
  for (const int bad : {-2, 65537})
    EXPECT_EQ(said([&](ProbeSet& s) { s.hierarchy->neighbors = bad; }),
              "file at /hierarchy/neighbors: must be -1 (all) or a count");
  EXPECT_EQ(said([&](ProbeSet& s) { s.hierarchy->neighbor.emplace_back(); }),
            "file at /hierarchy: needs one neighbour part per probe");
  const auto with_groups = [](std::size_t count) {
    return [count](ProbeSet& s) {
      s = ProbeSet{};
      s.light_groups.assign(count, {"lamp", vec3(1)});
    };
  };
  EXPECT_EQ(said(with_groups(256)), "no error");
  EXPECT_EQ(said(with_groups(257)), "file at /light_groups: there are more than 256");
  const auto of_length = [](float length) {
    return [length](ProbeSet& s) { s.fitted->points[1].normal = {0, length, 0}; };
  };
  for (const float good : {0.9991f, 1.0009f}) EXPECT_EQ(said(of_length(good)), "no error") << good;
  for (const float bad : {0.9989f, 1.0011f})
    EXPECT_EQ(said(of_length(bad)), fmt::format("file at /fitted/1/normal: its length is {}, not 1", bad));
}

TEST(Limits, OfScalesThatRelightTakes) {
  const std::string problem = "light group \"lamp 1\": its scale must be three numbers in 0..1e6";
  for (int c = 0; c < 3; ++c) {
    for (const float bad : {-1e-30f, 1.000001e6f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
      ProbeSet set = set_of_everything();
      vec3 scale(1);
      scale[c] = bad;
      EXPECT_EQ(message_of([&] { relight(set, "lamp 1", scale); }), problem) << bad;
    }
  }
  ProbeSet set = set_of_everything();
  relight(set, "lamp 1", {0, 1e6f, 2});
  EXPECT_FALSE(set.hierarchy);
  EXPECT_EQ(set.light_groups[1].scale, vec3(0, 1e6f, 2));
  const std::vector<GroupLight>& groups = set.probes[1].groups;
  const vec3 sum = set.light_groups[0].scale * groups[0].reflected[2] +
                   set.light_groups[1].scale * (groups[1].emitted[2] + groups[1].reflected[2]);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(set.probes[1].self[2][c], sum[c]);
  EXPECT_EQ(message_of([&] { relight(set, "lamp", vec3(1)); }),
            "light group \"lamp\": no such group in the probe set (there are: \"lamp 0\", \"lamp 1\")");
}

}  // namespace
}  // namespace ssphh::probes
