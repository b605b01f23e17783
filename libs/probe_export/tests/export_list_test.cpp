// What every target writes of one set, grids as they come out, and light in free space: number by number.

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>

#include "error_message.h"
#include "expected_text.h"
#include "field_sets.h"
#include "random_set.h"
#include "text_digest.h"
#include "triangle_source.h"

namespace ssphh::probe_export {
namespace {

/// A line's text, with the weighted sum of its numbers in their place where they are many.
std::string digest_of_line(std::string_view line) {
  const test::TextDigest digest = test::digest_of(line);
  if (digest.count < 30) return std::string(line) + "\n";
  return fmt::format("{}: {}\n", digest.words.substr(0, 60), test::numbers_text(digest));
}

std::string digest(const ExportFile& file) {
  const std::string text(text_of(file));
  if (text.find('\0') == std::string::npos) {
    std::string lines;
    for (const std::string& line : test::lines_of(text)) lines += "    " + digest_of_line(line);
    return lines;
  }
  // Half or whole floats behind a header, which the first differing number would tell of.
  double halves = 0, floats = 0;
  for (std::size_t i = 0; i + 4 <= file.data.size(); i += 4) {
    float value = 0;
    std::memcpy(&value, file.data.data() + i, 4);
    if (std::abs(value) < 1e5f && std::abs(value) > 1e-5f) floats += test::weight(i) * double{value};
    std::uint16_t pair[2];
    std::memcpy(pair, file.data.data() + i, 4);
    for (int k = 0; k < 2; ++k) {
      const float h = half(pair[k]);
      if (std::isfinite(h)) halves += test::weight(2 * i + static_cast<std::size_t>(k)) * double{h};
    }
  }
  return fmt::format("    {} bytes, {:.4g} as floats, {:.4g} as halves\n", file.data.size(), floats, halves);
}

/// Probes in both rooms, which a wall with a shut door parts; every probe and colour another light.
class ExportList : public testing::Test {
 protected:
  static probes::ProbeSet some_probes() {
    Pcg32 random(3);
    probes::ProbeSet set;
    set.degree = 3;
    set.light_groups = {{"lamp", vec3(2, 1, 0.5f)}, {"sky \"blue\"", vec3(0.5f)}};
    for (int i = 0; i < 12; ++i) {
      probes::Probe& probe = set.probes.emplace_back();
      probe.name = i == 3 ? "three \"quoted\"" : fmt::format("p{}", i);
      probe.radius = 0.1f + 0.01f * static_cast<float>(i);
      probe.position = vec3(7.4f, 2.4f, 3.4f) * random.uniform3() + vec3(-3.7f, 0.3f, -1.7f);
      for (std::size_t g = 0; g < 2; ++g) {
        probes::GroupLight& light = probe.groups.emplace_back();
        light.reflected = test::random_sh(random, 3, 0.4f), light.emitted = test::random_sh(random, 3, 0.2f);
        light.reflected[0] += vec3(3, 2 + probe.position.x / 4, 1);
      }
    }
    probes::merge_groups(set);
    return set;
  }

  const test::TriangleSource rooms_{scene::make_builtin("two-rooms")};
  const probes::ProbeSet set_ = some_probes();
};

TEST_F(ExportList, OfEveryTarget) {
  std::string text;
  for (const Target& target : targets()) {
    ExportSource source{set_, rooms_};
    source.grid.spacing = 1.1f;
    const Exported exported = target.write(source, "my file", {});
    text +=
        fmt::format("{} {} degree {} grid {} hides {}: {} points, {} filled\n", target.name, target.ending,
                    target.degree, target.grid, target.hides, exported.points, exported.filled);
    for (const ExportFile& file : exported.files)
      if (file.ending != ".cs" && target.name != "blender")
        text += fmt::format("  \"{}\"\n{}", file.ending, digest(file));
    for (const std::string& note : exported.notes) text += "  " + note + "\n";
    for (const std::string& line : lost(set_, target)) text += "  lost: " + line + "\n";
  }
  ExportSource all{set_, rooms_};
  all.light = probes::ProbeLight::all;
  text += "all light, csv\n" + digest(find_target("csv").write(all, "f", {}).files[0]);
  all.grid.spacing = 2;
  text += "all light, babylon\n" + digest(find_target("babylon").write(all, "f", {}).files[1]);
  test::expect_text_of("libs/probe_export/tests/expected/targets.txt", text);
}

TEST_F(ExportList, OfGridsAndTheirPoints) {
  const FreeLight light(set_, rooms_, probes::ProbeLight::reflected),
      open(set_, open_space, probes::ProbeLight::reflected);
  std::string text;
  const auto add_shape = [&](const std::string& name, const GridShape& s) {
    text += fmt::format("{}: {} {} {} of {:.6g} {:.6g} {:.6g} from {:.6g} {:.6g} {:.6g}\n", name, s.size.x,
                        s.size.y, s.size.z, s.cell.x, s.cell.y, s.cell.z, s.low.x, s.low.y, s.low.z);
  };
  for (const float spacing : {0.0f, 0.33f, 0.5f, 0.9f, 3.0f})
    add_shape(fmt::format("{}", spacing), fit_grid(set_, light, {.spacing = spacing}));
  add_shape("few points", fit_grid(set_, light, {.most = 500}));
  add_shape("few cells", fit_grid(set_, light, {.most_cells = 20}));
  add_shape("no surface", fit_grid(set_, open, {.spacing = 0.5f}));
  probes::ProbeSet one = set_;
  one.probes.resize(1);
  add_shape("one probe",
            fit_grid(one, FreeLight(one, rooms_, probes::ProbeLight::reflected), {.spacing = 0.5f}));
  for (const float spacing : {-1.0f, NAN, HUGE_VALF, 0.02f})
    text += test::message_of([&] { fit_grid(set_, light, {.spacing = spacing}); }) + "\n";

  // Some points stand in the wall and under the floor.
  const GridShape shape{vec3(-4.4f, -0.6f, -2.2f), vec3(0.8f, 0.6f, 1.1f), {11, 6, 4}};
  const LightGrid grid = resample(set_, light, rooms_, shape);
  double sum = 0;
  for (std::size_t i = 0; i < grid.light.size(); ++i)
    for (int k = 0; k < 9; ++k)
      for (int c = 0; c < 3; ++c)
        sum += test::weight(27 * i + 3 * static_cast<std::size_t>(k) + static_cast<std::size_t>(c)) *
               double{grid.light[i][k][c]};
  text += fmt::format("light {:.5g}\n", sum);
  for (const FilledPoint& point : grid.filled) {
    text += fmt::format("  {} from", point.index);
    for (const std::size_t from : point.from) text += fmt::format(" {}", from);
    text += '\n';
  }
  test::expect_text_of("libs/probe_export/tests/expected/grids.txt", text);
}

TEST_F(ExportList, OfLightInFreeSpace) {
  std::string text;
  for (const probes::ProbeLight what : {probes::ProbeLight::reflected, probes::ProbeLight::all}) {
    const FreeLight light(set_, rooms_, what);
    for (const vec3& place :
         {vec3(-2, 1, 0.5f), vec3(0.4f, 2, -1), vec3(3, 0.2f, 1), vec3(0, 2.6f, 1.5f), vec3(9, 9, 9)}) {
      const LightAt found = light.at(place);
      bool seen = false;
      const vec3 e = light.irradiance(place, glm::normalize(vec3(1, 2, -1)), seen);
      text += fmt::format("{:g} {:g} {:g} seen {} {}: {:.6g} {:.6g} {:.6g};", place.x, place.y, place.z,
                          found.seen, seen, e.x, e.y, e.z);
      for (const vec3& v : found.light.values) text += fmt::format(" {:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
      text += '\n';
    }
  }
  test::expect_text_of("libs/probe_export/tests/expected/free-light.txt", text);
}

TEST_F(ExportList, OfWhatIsLost) {
  probes::ProbeSet set = set_;
  set.light_groups[0].mode = scene::LightMode::baked;
  set.light_groups[1].scale = vec3(0);
  set.surface.emplace().points.resize(1);
  set.fitted.emplace();
  set.generator.time = 1.5f;
  set.probes[0].edges.resize(2);
  set.hierarchy.emplace();
  std::string text;
  for (const char* name : {"csv", "three"})
    for (const std::string& line : lost(set, find_target(name))) text += fmt::format("{}: {}\n", name, line);
  text += test::message_of([&] { only_group(set, "lamp"); }) + "\n";
  text += test::message_of([&] { only_group(set_, "moon"); }) + "\n";
  text += test::message_of([&] { find_target("doom"); }) + "\n";
  test::expect_text_of("libs/probe_export/tests/expected/losses.txt", text);
  const probes::ProbeSet alone = only_group(set_, "lamp");
  EXPECT_EQ(alone.light_groups[0].scale, set_.light_groups[0].scale);
  EXPECT_EQ(alone.light_groups[1].scale, vec3(0));
}

}  // namespace
}  // namespace ssphh::probe_export
