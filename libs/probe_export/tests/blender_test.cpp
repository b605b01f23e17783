// The script for Blender, run by Blender itself.

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "expect_near.h"
#include "readers.h"
#include "temp_dir.h"

namespace ssphh::probe_export {
namespace {

/// What stands in Blender's scene once the script has run.
json::Value scene_in_blender(const Exported& exported) {
  const test::TempDir dir;
  write_file(dir / "probes.py", text_of(exported.files.at(0)));
  const std::string tell = fmt::format(
      R"(import json
objects = bpy.data.collections["ssphh light probes"].objects
probes = [o for o in objects if o.type == "EMPTY"]
balls = [[list(v.co) + list(c.color) for v, c in zip(o.children[0].data.vertices, o.children[0].data.color_attributes[0].data)] for o in probes]
json.dump([dict(name=o.name, at=list(o.location), degree=o["degree"], radiance=list(o["radiance"]), ball=b) for o, b in zip(probes, balls)], open("{}", "w"))
)",
      (dir / "scene.json").string());
  const std::string command = fmt::format(
      "blender --background --factory-startup --python-exit-code 1 --python '{}' --python-expr '{}' > '{}' "
      "2>&1",
      (dir / "probes.py").string(), "import bpy\n" + tell, (dir / "log").string());
  EXPECT_EQ(std::system(command.c_str()), 0) << read_text_file(dir / "log");
  return json::parse(read_text_file(dir / "scene.json"), "scene");
}

TEST(Blender, EmptiesHoldTheLightAndBallsShowIrradianceOverPi) {
  if (std::system("command -v blender > /dev/null") != 0) GTEST_SKIP() << "no Blender on PATH";
  for (const bool linear : {false, true}) {
    const probes::ProbeSet set = field_set(linear, 3);
    const json::Value scene = scene_in_blender(find_target("blender").write({set, open_space}, "p", {}));
    ASSERT_EQ(scene.size(), set.probes.size());
    for (const json::Value& object : scene.elements()) {
      const auto probe = std::ranges::find(set.probes, object["name"].string(), &probes::Probe::name);
      ASSERT_NE(probe, set.probes.end()) << print(object);
      const vec3 at = triple(object["at"]);
      test::expect_near(vec3(at.x, at.z, -at.y), probe->position, 1e-6f);
      EXPECT_EQ(object["degree"], 3);
      ASSERT_EQ(object["radiance"].size(), 48u);
      for (int k = 0; k < 16; ++k) {
        for (int channel = 0; channel < 3; ++channel)
          EXPECT_NEAR(object["radiance"][3 * k + channel].number(), probe->reflected[k][channel], 1e-6);
      }
      ASSERT_GT(object["ball"].size(), 100u);
      for (const json::Value& vertex : object["ball"].elements()) {
        const vec3 n = glm::normalize(triple(vertex));
        const vec3 color(vertex[3].number(), vertex[4].number(), vertex[5].number());
        test::expect_near(color, field_irradiance(probe->position, {n.x, n.z, -n.y}, linear) / pi, 1e-4f);
      }
    }
  }
}

TEST(Blender, NamesAreTextsOfPythonWhateverStandsInThem) {
  if (std::system("command -v blender > /dev/null") != 0) GTEST_SKIP() << "no Blender on PATH";
  probes::ProbeSet set = field_set(false);
  set.probes.resize(1);
  set.probes[0].name = "a \"b\" \\ '''c''' {d} ü";
  const json::Value scene = scene_in_blender(find_target("blender").write({set, open_space}, "p", {}));
  EXPECT_EQ(scene[0]["name"], set.probes[0].name);
}

}  // namespace
}  // namespace ssphh::probe_export
