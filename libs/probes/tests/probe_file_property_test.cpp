#include <ssphh/probes/probe_file.h>

#include "property.h"
#include "set_generators.h"

namespace ssphh::probes {
namespace {

using namespace ssphh::test;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

/// Every field of a set by chance, coefficients of magnitudes whose products a file may hold.
ProbeSet wild_set(const SetShape& shape) {
  ProbeSet set = shape.make();
  Pcg32 random(shape.seed, 99);
  const auto coin = [&] { return random.next() % 2 == 0; };
  const auto positive = [&] { return static_cast<int>(1 + random.next() % 4096); };
  const auto wild = [&](sh::RadianceSh& f) {
    for (vec3& v : f.values) v *= std::ldexp(1.0f, static_cast<int>(random.next() % 100) - 55);
  };
  const auto name = [&] {
    static const char* const pieces[] = {"a", "\"", "\\",         "\n", "\t", "\x01",
                                         "ü", "光", "\U0001f4a1", "/",  ""};
    std::string text;
    for (int i = 0; i < 5; ++i) text += pieces[random.next() % std::size(pieces)];
    return text;
  };
  GeneratorInfo& g = set.generator;
  g.op = static_cast<LightOperator>(random.next() % 3), g.viz = static_cast<VizMethod>(random.next() % 3);
  g.gen = static_cast<GenMode>(random.next() % 2);
  g.max_depth = positive(), g.passes = positive(), g.spp = positive(), g.face_size = positive();
  g.directions = positive(), g.link_rays = positive(), g.surfel_size = random.uniform();
  g.seed = (std::uint64_t{random.next()} << 32) | random.next();
  g.scene = name(), g.scene_hash = {g.seed * 3, g.seed * 5}, g.time = 100 * random.uniform();
  for (LightGroup& group : set.light_groups)
    group.name += name(), group.scale = std::ldexp(1.0f, -int(random.next() % 20)) * group.scale;
  for (Probe& probe : set.probes) {
    probe.name = name();
    probe.position *= std::ldexp(1.0f, static_cast<int>(random.next() % 40) - 20);
    for (GroupLight& light : probe.groups) wild(light.emitted), wild(light.reflected);
    std::erase_if(probe.edges, [&](const Edge&) { return coin(); });
    for (Edge& edge : probe.edges) {
      wild(edge.h);
      if (coin()) edge.matrix = {};
    }
  }
  merge_groups(set);
  if (coin()) hier(set, {HierOperator::mean, static_cast<int>(random.next() % 4) - 1, random.uniform()});
  if (coin()) set.fitted = random_fitted(shape.seed, 7, shape.probes);
  if (coin()) set.baseline = random_baseline(shape.seed + 2, 3, coin() ? shape.probes : 0, shape.groups);
  if (coin()) {
    set.surface = random_records(shape.seed + 1, 6, shape.groups);
    if (coin() && shape.groups > 0) {
      set.surface->direct.resize(static_cast<std::size_t>(shape.groups));
      set.surface->direct.back() = set.surface->groups.front();
    }
    merge_groups(set);
  }
  return set;
}

TEST(ProbeFileProperty, BinaryKeepsEveryBitOfEveryField) {
  EXPECT_TRUE(for_all(set_shapes(0, 5)).cases(60).holds([](const SetShape& shape) {
    const ProbeSet set = wild_set(shape);
    const std::vector<std::byte> file = probes_to_binary(set);
    const ProbeSet back = probes_from_binary(file, "memory");
    return back == set && probes_to_binary(back) == file;
  }));
}

TEST(ProbeFileProperty, WhatWasJsonOnceIsTheSameInBothFormatsFromThenOn) {
  EXPECT_TRUE(for_all(set_shapes(0, 4, 3)).cases(40).holds([](const SetShape& shape) {
    const std::string text = probes_to_json(wild_set(shape));
    const ProbeSet once = probes_from_json(text, "memory");
    const ProbeSet through_binary = probes_from_binary(probes_to_binary(once), "memory");
    return through_binary == once && probes_to_json(through_binary) == text;
  }));
}

/// The largest relative difference of two sums of functions, and whether they are of one shape.
struct Nearness {
  bool same_shape = true;
  double worst = 0;

  void compare(std::span<const vec3> a, std::span<const vec3> b) {
    same_shape = same_shape && a.size() == b.size();
    if (!same_shape) return;
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (glm::length_t c = 0; c < 3; ++c)
        worst = std::max(
            worst, std::abs(double(a[k][c]) - double(b[k][c])) / std::max(1e-35, std::abs(double(b[k][c]))));
    }
  }
};

TEST(ProbeFileProperty, JsonKeepsFiveDigitsOfEveryFunctionAndAllOfTheRest) {
  EXPECT_TRUE(for_all(set_shapes(0, 4, 3)).cases(40).holds([](const SetShape& shape) -> AssertionResult {
    ProbeSet set = wild_set(shape), back = probes_from_json(probes_to_json(set), "memory");
    Nearness near;
    if (back.probes.size() != set.probes.size()) return AssertionFailure() << "probes are lost";
    for (std::size_t i = 0; i < set.probes.size(); ++i) {
      Probe &a = back.probes[i], &b = set.probes[i];
      if (a.edges.size() != b.edges.size()) return AssertionFailure() << "edges are lost";
      for (std::size_t g = 0; g < b.groups.size(); ++g) {
        near.compare(a.groups[g].emitted.values, b.groups[g].emitted.values);
        near.compare(a.groups[g].reflected.values, b.groups[g].reflected.values);
      }
      for (std::size_t e = 0; e < b.edges.size(); ++e) {
        near.compare(a.edges[e].h.values, b.edges[e].h.values);
        near.compare(a.edges[e].matrix.values, b.edges[e].matrix.values);
        near.compare(std::vector<vec3>{vec3(a.edges[e].transfer)},
                     std::vector<vec3>{vec3(b.edges[e].transfer)});
        if (a.edges[e].from != b.edges[e].from) return AssertionFailure() << "an edge comes from elsewhere";
      }
      if (a.name != b.name || a.position != b.position || a.radius != b.radius)
        return AssertionFailure() << "a probe is another";
    }
    if (back.generator != set.generator) return AssertionFailure() << "the generator is another";
    if (back.light_groups != set.light_groups) return AssertionFailure() << "the light groups are others";
    if (back.hierarchy.has_value() != set.hierarchy.has_value()) return AssertionFailure() << "no hierarchy";
    if (set.hierarchy) {
      for (std::size_t i = 0; i < set.probes.size(); ++i)
        near.compare(back.hierarchy->neighbor[i].values, set.hierarchy->neighbor[i].values);
    }
    if (!near.same_shape) return AssertionFailure() << "a function has another degree";
    return at_most(near.worst, 5.1e-5);  // half a unit of the fifth digit, and the rounding to float
  }));
}

}  // namespace
}  // namespace ssphh::probes
