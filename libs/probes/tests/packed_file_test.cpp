// Files with packed light: what comes back, what they leave out, what is refused.

#include <cstring>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/core/hash.h>
#include <ssphh/probes/compact.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>

#include "error_message.h"
#include "random_set.h"
#include "temp_dir.h"

namespace ssphh::probes {
namespace {

using sh::Packing;
using test::message_of;
using test::random_set;
using testing::HasSubstr;

/// Three probes with two light groups, a hierarchy, fitted points and records; light is nowhere negative.
ProbeSet compact_set(int degree = 2) {
  ProbeSet set = random_set(42, 3, degree, 2, true);
  for (Probe& probe : set.probes)
    for (GroupLight& light : probe.groups)
      for (sh::RadianceSh* f : {&light.emitted, &light.reflected})
        if (!f->empty()) (*f)[0] = vec3(7);
  hier(set, {HierOperator::mean, 2, 0.1f});
  set.fitted = test::random_fitted(7, 9, 3);
  set.surface = test::random_records(8, 5, 2);
  set.baseline = test::random_baseline(9, 4, 3, 2);
  return compacted(set, degree);
}

/// The set with its light through pack() and unpack().
ProbeSet through(ProbeSet set, Packing packing) {
  const auto repack = [&](sh::RadianceSh& f) {
    if (f.empty()) return;
    std::vector<std::byte> bytes;
    sh::pack(f, packing, bytes);
    f = sh::unpack(bytes, packing, set.degree);
  };
  for (Probe& probe : set.probes)
    for (GroupLight& light : probe.groups) repack(light.emitted), repack(light.reflected);
  merge_groups(set);
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    repack(set.hierarchy->neighbor[i]);
    set.hierarchy->sum[i] = set.hierarchy->neighbor[i];
    set.hierarchy->sum[i] += set.probes[i].self;
  }
  return set;
}

TEST(PackedFile, HoldsTheLightAsPackedAndEverythingElseAsItWas) {
  for (const Packing packing : {Packing::half, Packing::rgb9e5, Packing::zh3, Packing::bc6h}) {
    const ProbeSet set = compact_set();
    const ProbeSet back = probes_from_binary(probes_to_binary(set, packing), "file");
    EXPECT_EQ(back, through(set, packing)) << name_of(packing);
    EXPECT_NE(back, set) << name_of(packing);
  }
}

TEST(PackedFile, HalfAndNoneAndHalfAgainIsTheSameFile) {
  const std::vector<std::byte> once = probes_to_binary(compact_set(5), Packing::half);
  const ProbeSet plain = probes_from_binary(probes_to_binary(probes_from_binary(once, "file")), "file");
  EXPECT_EQ(probes_to_binary(plain, Packing::half), once);
}

TEST(PackedFile, TellsItsPackingAndItsBytes) {
  const test::TempDir dir;
  const ProbeSet set = compact_set();
  const std::size_t plain = probes_to_binary(set).size();
  // Per probe two groups, one of which may lack emitted light, and the neighbours' part.
  std::size_t functions = 3;
  for (const Probe& probe : set.probes)
    for (const GroupLight& light : probe.groups) functions += light.emitted.empty() ? 1 : 2;
  for (const Packing packing : {Packing::half, Packing::rgb9e5, Packing::zh3, Packing::bc6h}) {
    write_probe_file(set, dir / "a.sphl", packing);
    EXPECT_EQ(packing_of_file(dir / "a.sphl"), packing);
    EXPECT_EQ(read_file(dir / "a.sphl").size(), plain + 1 - functions * (108 - sh::packed_bytes(packing, 2)));
  }
  write_probe_file(set, dir / "b.sphl");
  EXPECT_EQ(packing_of_file(dir / "b.sphl"), Packing::none);
  write_probe_file(set, dir / "b.sphl.json");
  EXPECT_EQ(packing_of_file(dir / "b.sphl.json"), Packing::none);
  EXPECT_THROW(packing_of_file(dir / "none.sphl"), Error);
  EXPECT_THAT(message_of([&] { write_probe_file(set, dir / "c.sphl.json", Packing::half); }),
              HasSubstr("JSON holds no packed light"));
}

TEST(PackedFile, CompactSetsKeepLowBandsAndDropWhatOnlyBakesNeed) {
  ProbeSet set = random_set(1, 3, 4, 2, true);
  hier(set, {});
  set.baseline = test::random_baseline(9, 4, 3, 2);
  const ProbeSet compact = compacted(set, 2);
  validate(compact, "set");
  EXPECT_EQ(compact.degree, 2);
  EXPECT_EQ(edge_count(compact), 0u);
  EXPECT_FALSE(compact.baseline);
  EXPECT_EQ(compact.hierarchy->sum[2].degree(), 2);
  for (int k = 0; k < 9; ++k) {
    EXPECT_EQ(compact.probes[1].groups[1].reflected[k], set.probes[1].groups[1].reflected[k]);
    EXPECT_EQ(compact.probes[1].self[k], set.probes[1].self[k]);
    EXPECT_EQ(compact.hierarchy->sum[2][k], set.hierarchy->sum[2][k]);
  }
  EXPECT_THROW(compacted(set, 5), Error);
  EXPECT_THROW(compacted(set, -1), Error);
}

TEST(PackedFile, SetsThatItCannotHoldAreRefused) {
  ProbeSet set = random_set(1, 3, 4, 2, true);
  EXPECT_THAT(message_of([&] { probes_to_binary(set, Packing::half); }),
              HasSubstr("no edges and no baseline"));
  set = compacted(set, 4);
  EXPECT_THAT(message_of([&] { probes_to_binary(set, Packing::zh3); }), HasSubstr("zh3 has no degree 4"));
  set.probes[1].name = "the bright one";
  set.probes[1].groups[0].reflected[0].x = 1e6f;
  EXPECT_THAT(message_of([&] { probes_to_binary(set, Packing::rgb9e5); }),
              HasSubstr("probe \"the bright one\": coefficient 0 is 1e+06; RGB9E5 holds 65408"));
}

TEST(PackedFile, EveryTruncationAndEveryFlippedBitIsAnError) {
  for (const Packing packing : {Packing::half, Packing::zh3}) {
    const std::vector<std::byte> bytes = probes_to_binary(compact_set(), packing);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_THROW(probes_from_binary(std::span(bytes).first(size), "file"), Error) << size;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += 7) {
      auto damaged = bytes;
      damaged[bit / 8] ^= std::byte{1} << (bit % 8);
      EXPECT_THROW(probes_from_binary(damaged, "file"), Error) << bit;
    }
  }
}

TEST(PackedFile, HostileBytesWithARightChecksumAreAnErrorOrAValidSet) {
  for (const Packing packing : {Packing::half, Packing::rgb9e5, Packing::zh3, Packing::bc6h}) {
    const std::vector<std::byte> bytes = probes_to_binary(compact_set(), packing);
    int errors = 0, total = 0;
    for (std::size_t at = 36; at < bytes.size(); ++at) {
      for (const std::byte value : {std::byte{0xff}, std::byte{0x7c}, std::byte{0}, std::byte{4}}) {
        auto hostile = bytes;
        hostile[at] = value;
        const Hash128 sum = Hasher().bytes(std::span(hostile).subspan(36)).finish();
        std::memcpy(hostile.data() + 20, &sum.high, 8);
        std::memcpy(hostile.data() + 28, &sum.low, 8);
        ++total;
        try {
          validate(probes_from_binary(hostile, "file"), "file");
        } catch (const Error&) {
          ++errors;
        }
      }
    }
    EXPECT_GT(errors, 50);
    EXPECT_LT(errors, total);
  }
}

TEST(PackedFile, LossIsThatOfKnownChanges) {
  ProbeSet set = compacted(random_set(1, 2, 1, 1), 1);
  for (Probe& probe : set.probes) {
    probe.groups[0].emitted = {};
    for (vec3& v : probe.groups[0].reflected.values) v = vec3(0);
  }
  set.light_groups[0].scale = vec3(1), set.light_groups[0].mode = scene::LightMode::realtime;
  set.probes[0].groups[0].reflected[0] = vec3(1, 2, 3);  // the second probe is dark
  merge_groups(set);
  ProbeSet other = set;
  other.probes[0].groups[0].reflected[0].y = 2.2f;
  other.probes[0].groups[0].reflected[2].z = 0.3f;
  merge_groups(other);
  const IrradianceLoss loss = irradiance_loss(set, other);
  EXPECT_EQ(loss.dark, 1u);
  EXPECT_EQ(loss.largest.x, 0);
  for (const float v : {loss.mean.y, loss.most_of_95.y, loss.largest.y}) EXPECT_NEAR(v, 0.1f, 1e-5f);
  // E_z changes by A_1 Y_10 0.3 = 0.3 (2π/3) √(3/4π) cos θ; the mean is π Y_00 2. |cos θ| is even on [0, 1].
  const float largest = 0.3f * 2 / 3 * std::sqrt(3.0f) / 2;
  EXPECT_NEAR(loss.mean.z, largest / 2, 0.01f * largest);
  // The fourth largest of the sixteen that lie evenly in |cos θ| of 0.75 to 1: its deviation is 0.025.
  EXPECT_NEAR(loss.most_of_95.z, 0.95f * largest, 0.08f * largest);
  EXPECT_LE(loss.largest.z, largest);
  EXPECT_GT(loss.largest.z, 0.95f * largest);
  other.probes.pop_back();
  EXPECT_THROW(irradiance_loss(set, other), Error);
}

}  // namespace
}  // namespace ssphh::probes
