#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>

#include "json_number.h"
#include "random_set.h"
#include "temp_dir.h"

namespace ssphh::probes {
namespace {

using test::random_set;
using testing::HasSubstr;

/// Three probes, matrices on some edges, a hierarchy, an empty emitter: every field of the format.
ProbeSet full_set(int degree = 2) {
  ProbeSet set = random_set(42, 3, degree, 2, true);
  set.probes[1].edges.erase(set.probes[1].edges.begin());
  set.probes[2].edges[0].matrix = {};
  hier(set, {HierOperator::mean, 2, 0.1f});
  set.fitted = test::random_fitted(7, 9, 3);
  set.surface = test::random_records(8, 5, 2);
  set.baseline = test::random_baseline(9, 4, 3, 2);
  merge_groups(set);
  return set;
}

std::string number_text(float value) {
  std::string text;
  append_five_digits(text, value);
  return text;
}

std::string error_of(const std::string& json) {
  try {
    probes_from_json(json, "file");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(ProbeFile, BinaryRoundTripKeepsEveryBit) {
  for (const int degree : {0, 2, 10}) {
    const ProbeSet set = degree == 10 ? random_set(1, 3, 10) : full_set(degree);
    const auto bytes = probes_to_binary(set);
    const ProbeSet back = probes_from_binary(bytes, "file");
    EXPECT_EQ(back, set);
    EXPECT_EQ(probes_to_binary(back), bytes);
  }
}

TEST(ProbeFile, JsonRoundTripKeepsFiveDigitsAndIsThenIdempotent) {
  const ProbeSet set = full_set(3);
  const std::string text = probes_to_json(set);
  const ProbeSet back = probes_from_json(text, "file");
  EXPECT_EQ(probes_to_json(back), text);

  EXPECT_EQ(back.generator, set.generator);
  EXPECT_EQ(back.light_groups, set.light_groups);
  ASSERT_EQ(back.probes.size(), set.probes.size());
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    EXPECT_EQ(back.probes[i].name, set.probes[i].name);
    EXPECT_EQ(back.probes[i].position, set.probes[i].position);
    EXPECT_EQ(back.probes[i].radius, set.probes[i].radius);
    EXPECT_EQ(back.probes[i].groups[0].emitted, sh::RadianceSh());
    const auto& a = set.probes[i].groups[1].emitted.values;
    const auto& b = back.probes[i].groups[1].emitted.values;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      // Half a unit of the fifth digit, and the rounding to float.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[k][c], a[k][c], 5.1e-5f * std::abs(a[k][c]));
    }
  }
  EXPECT_EQ(back.hierarchy->op, HierOperator::mean);
  EXPECT_EQ(back.hierarchy->neighbors, 2);
  EXPECT_EQ(back.hierarchy->threshold, 0.1f);
  ASSERT_TRUE(back.fitted);
  ASSERT_EQ(back.fitted->points.size(), 9u);
  for (std::size_t p = 0; p < 9; ++p) {
    EXPECT_EQ(back.fitted->points[p].position, set.fitted->points[p].position);
    EXPECT_EQ(back.fitted->points[p].normal, set.fitted->points[p].normal);
    ASSERT_EQ(back.fitted->weights[p].count, set.fitted->weights[p].count);
    for (int k = 0; k < set.fitted->weights[p].count; ++k) {
      const ProbeWeight a = set.fitted->weights[p].used()[k];
      const ProbeWeight b = back.fitted->weights[p].used()[k];
      EXPECT_EQ(b.probe, a.probe);
      EXPECT_NEAR(b.weight, a.weight, 5.1e-5f * a.weight);
    }
  }
  EXPECT_EQ(back.probes[2].edges[0].matrix.values.size(), 0u);
  EXPECT_EQ(back.probes[2].edges[1].matrix.values.size(), 256u);
}

TEST(ProbeFile, AllFormatsHoldTheSame) {
  const ProbeSet set = full_set();
  const ProbeSet json = probes_from_json(probes_to_json(set), "file");
  EXPECT_EQ(probes_from_binary(probes_to_binary(json), "file"), json);
}

TEST(ProbeFile, NumbersHaveFiveDigitsAndAreShort) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.0f), "0");
  EXPECT_EQ(number_text(1), "1");
  EXPECT_EQ(number_text(-0.5f), "-0.5");
  EXPECT_EQ(number_text(3.14159265f), "3.1416");
  EXPECT_EQ(number_text(31415.9265f), "31416");
  EXPECT_EQ(number_text(1234567), "1234600");
  EXPECT_EQ(number_text(12345678), "1.2346e7");
  EXPECT_EQ(number_text(0.012345f), "0.012345");
  EXPECT_EQ(number_text(0.0012345f), "1.2345e-3");
  EXPECT_EQ(number_text(2e10f), "2e10");
  EXPECT_EQ(number_text(99999.7f), "100000");
  EXPECT_EQ(number_text(1e-40f), "0");
  Pcg32 rng(9);
  for (int i = 0; i < 20000; ++i) {
    const float value = std::ldexp(rng.uniform() - 0.5f, static_cast<int>(rng.next() % 120) - 60);
    const std::string text = number_text(value);
    const float back = std::strtof(text.c_str(), nullptr);
    EXPECT_NEAR(back, value, 5.1e-5f * std::abs(value)) << text;
    EXPECT_EQ(number_text(back), text);
  }
}

TEST(ProbeFile, ADegreeTenProbeTakesLessThanFourKilobytesOfJson) {
  // The worst: every number negative with five digits and one-digit exponents.
  ProbeSet set = random_set(1, 1, 10, 1);
  for (vec3& v : set.probes[0].groups[0].reflected.values) v = {-0.012345f, -1.2345e-3f, -1.2345e-9f};
  const std::string text = probes_to_json(set);
  const std::size_t begin = text.find("\"reflected\":") + 12, end = text.find(']', begin) + 1;
  EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                       text.begin() + static_cast<std::ptrdiff_t>(end), ','),
            362);
  EXPECT_LT(end - begin, 4096u);
  // With everything else that a probe and a file have, for the usual numbers.
  EXPECT_LT(probes_to_json(random_set(1, 1, 10, 1)).size(), 4096u);
  EXPECT_LT(probes_to_binary(random_set(1, 1, 10, 1)).size(), 1700u);
}

TEST(ProbeFile, ASetWithoutProbesIsAFile) {
  const ProbeSet set = random_set(1, 0, 9, 0);
  EXPECT_EQ(probes_from_binary(probes_to_binary(set), "file"), set);
  EXPECT_EQ(probes_from_json(probes_to_json(set), "file"), set);
}

TEST(ProbeFile, TheNameChoosesTheFormat) {
  const test::TempDir dir;
  const ProbeSet set = full_set();
  write_probe_file(set, dir / "a.sphl");
  write_probe_file(set, dir / "a.sphl.json");
  EXPECT_EQ(read_probe_file(dir / "a.sphl"), set);
  EXPECT_EQ(read_text_file(dir / "a.sphl.json"), probes_to_json(set));
  EXPECT_EQ(probes_to_json(read_probe_file(dir / "a.sphl.json")), probes_to_json(set));
  EXPECT_THROW(write_probe_file(set, dir / "a.txt"), Error);
  EXPECT_THROW(read_probe_file(dir / "missing.sphl"), Error);
}

TEST(ProbeFile, EveryTruncationAndEveryFlippedBitOfABinaryFileIsAnError) {
  ProbeSet small = random_set(3, 2, 1, 1);
  hier(small, {});
  const auto bytes = probes_to_binary(small);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(probes_from_binary(std::span(bytes).first(size), "file"), Error) << size;
  }
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto damaged = bytes;
    damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_THROW(probes_from_binary(damaged, "file"), Error) << bit;
  }
}

/// A binary file whose payload was changed by someone who also mended the checksum.
std::vector<std::byte> mended(std::vector<std::byte> file) {
  constexpr std::size_t header = 36;
  const Hash128 sum = Hasher().bytes(std::span(file).subspan(header)).finish();
  std::memcpy(file.data() + 20, &sum.high, 8);
  std::memcpy(file.data() + 28, &sum.low, 8);
  return file;
}

TEST(ProbeFile, HostileBinaryWithARightChecksumIsAnErrorOrAValidSet) {
  ProbeSet small = random_set(3, 2, 1, 1);
  hier(small, {});
  const auto bytes = probes_to_binary(small);
  ASSERT_EQ(mended(bytes), bytes) << "the test knows where the checksum stands";
  int errors = 0, total = 0;
  for (std::size_t at = 36; at < bytes.size(); ++at) {
    for (const std::byte value : {std::byte{0xff}, std::byte{0x7f}, std::byte{0}}) {
      auto hostile = bytes;
      hostile[at] = value;
      ++total;
      try {
        validate(probes_from_binary(mended(hostile), "file"), "file");
      } catch (const Error&) {
        ++errors;
      }
    }
  }
  EXPECT_GT(errors, 50);
  EXPECT_LT(errors, total);  // a changed low byte of a coefficient is as good as any
}

TEST(ProbeFile, EveryTruncationOfAJsonFileIsAnError) {
  const std::string text = probes_to_json(random_set(3, 2, 1, 1));
  for (std::size_t size = 0; size + 2 < text.size(); ++size) {
    EXPECT_THROW(probes_from_json(std::string_view(text).substr(0, size), "file"), Error) << size;
  }
}

TEST(ProbeFile, ADamagedJsonFileIsAnErrorOrAValidSet) {
  const std::string text = probes_to_json(full_set(1));
  int errors = 0;
  for (std::size_t i = 0; i < text.size(); i += 13) {
    for (const char c : {'\0', '9', '"', ']', '-', '\xff'}) {
      std::string damaged = text;
      damaged[i] = c;
      try {
        validate(probes_from_json(damaged, "file"), "file");
      } catch (const Error&) {
        ++errors;
      }
    }
  }
  EXPECT_GT(errors, 300);
}

TEST(ProbeFile, JsonErrorsNameFileAndPlace) {
  std::string text = probes_to_json(full_set(0));
  text.replace(text.find("\"radius\":"), 9, "\"radius\":-");
  EXPECT_THAT(error_of(text), HasSubstr("file: probes[0].radius"));
  EXPECT_THAT(error_of("{\"format\":1}"), HasSubstr("\"version\""));
  EXPECT_THAT(error_of("nonsense"), HasSubstr("file: is not valid JSON"));
}

TEST(ProbeFile, AnEmissionFileIsToldFromABrokenOne) {
  const auto said = [](std::string_view text) {
    try {
      probes_from_binary(std::as_bytes(std::span(text)), "f");
    } catch (const Error& e) {
      return e.problem();
    }
    return std::string("no error");
  };
  EXPECT_EQ(said(R"({"format":"ssphh-emission","version":1})"),
            "is an emission file: what a thing sends out, not light that probes receive");
  EXPECT_EQ(said("{}"), "is not a binary probe file");
}

TEST(ProbeFile, HostileNestingIsAnErrorAndCheap) {
  EXPECT_THAT(error_of(std::string(1 << 20, '[')), HasSubstr("nested deeper"));
  std::string objects;
  for (int i = 0; i < 1 << 16; ++i) objects += "{\"a\":";
  EXPECT_THAT(error_of(objects), HasSubstr("nested deeper"));
  std::string wide = "[";
  for (int i = 0; i < (1 << 21) + 1; ++i) wide += "[],";
  EXPECT_THAT(error_of(wide + "0]"), HasSubstr("more than 2097152 arrays"));
}

TEST(ProbeFile, NumbersThatNoFloatHoldsAreErrors) {
  const std::string text = probes_to_json(full_set(0));
  for (const char* number : {"1e999", "1e31", "-1e31", "NaN", "Infinity", "null", "\"1\"", "true"}) {
    std::string bad = text;
    const std::size_t at = bad.find("\"transfer\":") + 11;
    bad.replace(at, bad.find(',', at) - at, number);
    EXPECT_THROW(probes_from_json(bad, "file"), Error) << number;
  }
}

TEST(ProbeFile, ASetThatBreaksTheRulesIsNotWritten) {
  const auto expect_rejected = [](const char* place, auto&& change) {
    ProbeSet set = full_set();
    change(set);
    for (const bool json : {false, true}) {
      try {
        json ? void(probes_to_json(set)) : void(probes_to_binary(set));
        ADD_FAILURE() << place << " was written";
      } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr(place));
      }
    }
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect_rejected("/degree", [](ProbeSet& s) { s.degree = 11; });
  expect_rejected("/probes/1/groups/0/reflected",
                  [&](ProbeSet& s) { s.probes[1].groups[0].reflected[3].y = nan; });
  expect_rejected("/probes/1/groups", [](ProbeSet& s) { s.probes[1].groups.pop_back(); });
  expect_rejected("/probes/2/position", [&](ProbeSet& s) { s.probes[2].position.x = nan; });
  expect_rejected("/probes/2/radius", [](ProbeSet& s) { s.probes[2].radius = 0; });
  expect_rejected("/probes/2/edges/0/from", [](ProbeSet& s) { s.probes[2].edges[0].from = 2; });
  expect_rejected("/probes/2/edges/1/from", [](ProbeSet& s) { s.probes[2].edges[1].from = 0; });
  expect_rejected("/probes/0/edges/1/from", [](ProbeSet& s) { s.probes[0].edges[1].from = 3; });
  expect_rejected("/probes/0/edges/0/transfer", [](ProbeSet& s) { s.probes[0].edges[0].transfer = -0.1f; });
  expect_rejected("/probes/0/edges/0/matrix",
                  [](ProbeSet& s) { s.probes[0].edges[0].matrix.values.pop_back(); });
  expect_rejected("/hierarchy", [](ProbeSet& s) { s.hierarchy->neighbor.pop_back(); });
  for (const std::size_t i : {0, 2}) {
    expect_rejected(fmt::format("/probes/{}/neighbor", i).c_str(),
                    [&](ProbeSet& s) { s.hierarchy->neighbor[i][0].y = nan; });
  }
  expect_rejected("/light_groups/1/name", [](ProbeSet& s) { s.light_groups[1].name.resize(2000, 'x'); });
  expect_rejected("/generator/directions", [](ProbeSet& s) { s.generator.directions = -1; });
  expect_rejected("/generator/surfel_size", [&](ProbeSet& s) { s.generator.surfel_size = nan; });
  expect_rejected("/fitted/5/probes", [](ProbeSet& s) { s.fitted->weights[5].entries[0].probe = 3; });
  expect_rejected("/fitted/1/weights", [&](ProbeSet& s) { s.fitted->weights[1].entries[0].weight = nan; });
  expect_rejected("/fitted/1/weights", [](ProbeSet& s) { s.fitted->weights[1].count = 17; });
  expect_rejected("/fitted/2/position", [&](ProbeSet& s) { s.fitted->points[2].position.y = nan; });
  expect_rejected("/fitted/2/normal", [](ProbeSet& s) { s.fitted->points[2].normal *= 1.1f; });
  expect_rejected("/fitted", [](ProbeSet& s) { s.fitted->weights.pop_back(); });
  expect_rejected("/surface/3/position", [&](ProbeSet& s) { s.surface->points[3].position.z = nan; });
  expect_rejected("/surface/1/normal", [](ProbeSet& s) { s.surface->points[1].normal *= 0.9f; });
  expect_rejected("/surface/4/groups", [&](ProbeSet& s) { s.surface->groups[1][4].scale = nan; });
  expect_rejected("/surface/2/groups", [](ProbeSet& s) { s.surface->groups[0][2].scale = -1; });
  expect_rejected("/surface", [](ProbeSet& s) { s.surface->groups[1].pop_back(); });
  expect_rejected("/surface", [](ProbeSet& s) { s.surface->groups.pop_back(); });
  expect_rejected("/baseline/neighbors", [](ProbeSet& s) { s.baseline->viz_neighbors = -2; });
  expect_rejected("/baseline/threshold", [&](ProbeSet& s) { s.baseline->viz_threshold = nan; });
  expect_rejected("/baseline/records", [](ProbeSet& s) { s.baseline->records = -1; });
  expect_rejected("/baseline/surfels", [](ProbeSet& s) { s.baseline->most_surfels = -1; });
  expect_rejected("/baseline/items/3/name", [](ProbeSet& s) { s.baseline->items[3].name.resize(2000, 'x'); });
  expect_rejected("/baseline/trials", [](ProbeSet& s) { s.baseline->trials.pop_back(); });
  expect_rejected("/baseline/trials/2", [](ProbeSet& s) { s.baseline->trials[2].halves[1].pop_back(); });
  expect_rejected("/baseline/trials/1",
                  [](ProbeSet& s) { s.baseline->trials[1].halves[0][0].values.pop_back(); });
  expect_rejected("/baseline/trials/0", [&](ProbeSet& s) { s.baseline->trials[0].halves[0][1][8].z = nan; });
  expect_rejected("/generator/spp", [](ProbeSet& s) { s.generator.spp = 0; });
}

}  // namespace
}  // namespace ssphh::probes
