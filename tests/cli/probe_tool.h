#pragma once
/// A small set of probes that was made by hand, in a file, for tests of `ssphh probe` and `ssphh hier`.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>

#include "commands/command.h"
#include "here.h"
#include "sloped_light.h"
#include "temp_dir.h"

namespace ssphh::test {

/// Three probes in a row, each lit by a lamp and the sky; edges of different strength.
inline probes::ProbeSet example_set() {
  probes::ProbeSet set;
  set.degree = 1;
  probes::GeneratorInfo& g = set.generator;
  g.op = probes::LightOperator::path, g.viz = probes::VizMethod::links, g.gen = probes::GenMode::local;
  g.max_depth = 5, g.passes = 2, g.spp = 7, g.face_size = 9, g.seed = 11;
  g.directions = 64, g.surfel_size = 0.25f, g.link_rays = 16;
  g.scene = "rooms", g.scene_hash = {0x1234, 0x5678}, g.time = 1.5f;
  set.light_groups = {{"lamp", {1, 0.5f, 0.25f}}, {"sky", {2, 2, 2}}};
  for (int i = 0; i < 3; ++i) {
    const auto x = static_cast<float>(i);
    probes::Probe probe;
    probe.name = std::string(1, static_cast<char>('a' + i));
    probe.position = {x, 1 + x, -2}, probe.radius = 0.125f * (x + 1);
    probe.groups = {{sloped_light(0.5f, 0.2f), sloped_light(1 + x, 0.25f)},
                    {{}, sloped_light(0.25f, 0.5f * x)}};
    for (int from = 0; from < 3; ++from) {
      if (from == i) continue;
      probes::Edge edge;
      edge.from = from, edge.transfer = 0.125f * static_cast<float>(1 + from + i);
      edge.h = sloped_light(edge.transfer, 0.01f);
      probe.edges.push_back(edge);
    }
    set.probes.push_back(probe);
  }
  probes::merge_groups(set);
  return set;
}

class ProbeTool : public testing::Test {
 protected:
  ProbeTool() { probes::write_probe_file(set_, file_); }
  static void expect_rgb(const json::Value& got, const vec3& wanted) {
    ASSERT_EQ(got.size(), 3u);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(float_of(got[c]), wanted[c], 1e-5f * (1 + std::abs(wanted[c])));
  }

  const TempDir dir_;
  const std::string file_ = dir_ / "a.sphl", out_ = dir_ / "b.sphl";
  const probes::ProbeSet set_ = example_set();
};

}  // namespace ssphh::test
