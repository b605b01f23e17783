// Pictures of another renderer as the light of probes.

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/bake/gen.h>
#include <ssphh/bake/viz.h>
#include <ssphh/core/sphere.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/image/io.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/path_tracer.h>

#include "here.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::json_here;
using test::problem_here;
using test::run_here;
using testing::HasSubstr;

/// Path traced at the first SPHL of cornell, as another renderer would: a picture, and nothing else.
struct Traced {
  scene::ProbePlace place;
  image::CubeMap cube{16};
  sh::RadianceSh reflected;

  explicit Traced(int degree) {
    const scene::Scene scene = scene::make_builtin("cornell");
    const trace::PathTracer tracer(scene, 0);
    place = scene::sphl_places(scene).at(0);
    rays::CubeRequest request;
    request.position = place.position;
    request.face_size = cube.size;
    request.path = {.max_depth = 4, .passes = 1, .spp = 4, .seed = 1};
    reflected = sh::RadianceSh(degree);
    for (const probes::GroupLight& group : bake::gen(tracer, request, degree)) reflected += group.reflected;
    for (const rays::GroupRadiance& group : tracer.incident_radiance(request, {})) {
      for (std::size_t f = 0; f < 6; ++f) {
        for (int y = 0; y < cube.size; ++y) {
          for (int x = 0; x < cube.size; ++x)
            cube.faces[f].set_rgb(x, y, cube.faces[f].rgb(x, y) + group.reflected.faces[f].rgb(x, y));
        }
      }
    }
  }
};

TEST(ProbeImport, OfOurOwnCubeIsWhatGenFinds) {
  const test::TempDir dir;
  const Traced traced(5);
  for (const image::Layout layout :
       {image::Layout::cross_v, image::Layout::cross_h, image::Layout::strip_h}) {
    const std::string picture = dir / "cube.exr", file = dir / "set.sphl";
    image::write_image(picture, image::from_cube(traced.cube, layout));
    const json::Value said =
        json_here({"probe", "import", picture, "--layout", std::string(name_of(layout)), "--scene",
                   "builtin:cornell", "--sphl", traced.place.name, "--degree", "5", "-o", file});
    EXPECT_EQ(said["face_size"], 16);
    const probes::ProbeSet set = probes::read_probe_file(file);
    ASSERT_EQ(set.probes.at(0).reflected.values.size(), traced.reflected.values.size());
    const float mean = luminance(traced.reflected[0]);
    EXPECT_GT(mean, 0);
    for (std::size_t k = 0; k < traced.reflected.values.size(); ++k)
      EXPECT_LT(glm::distance(set.probes[0].reflected.values[k], traced.reflected.values[k]), 1e-3f * mean)
          << name_of(layout) << ' ' << k;
  }
}

/// The faces as cameras within them see them, face0.exr to face5.exr in a folder.
std::vector<std::string> write_views(const image::CubeMap& cube, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::vector<std::string> files;
  for (const image::Image& face : cube.faces) {
    image::Image view(cube.size, cube.size);
    for (int y = 0; y < cube.size; ++y)
      for (int x = 0; x < cube.size; ++x) view.set_rgb(x, y, face.rgb(cube.size - 1 - x, y));
    files.push_back((folder / fmt::format("face{}.exr", files.size())).string());
    image::write_image(files.back(), view);
  }
  return files;
}

std::vector<std::string> import_into(const std::string& file, const std::vector<std::string>& images,
                                     const std::vector<std::string>& more) {
  std::vector<std::string> words = {"probe", "import"};
  words.insert(words.end(), images.begin(), images.end());
  words.insert(words.end(), {"-o", file});
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// As of Mitsuba, which can hide lamps, and of pbrt, which cannot: there pictures of lamps alone are taken
// off.
TEST(ProbeImport, OfSixFacesIsWhatGenFindsWithLampsInThemOrNot) {
  const test::TempDir dir;
  const Traced traced(4);
  const std::string file = dir / "set.sphl";
  image::CubeMap lamps(16), all = traced.cube;
  for (std::size_t f = 0; f < 6; ++f)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const vec3 lamp = f == 2 && x < 4 ? vec3(5, 3, 1) : vec3(0);
        lamps.faces[f].set_rgb(x, y, lamp);
        all.faces[f].set_rgb(x, y, all.faces[f].rgb(x, y) + lamp);
      }
  const std::vector<std::string> reflected = write_views(traced.cube, dir / "reflected"),
                                 seen = write_views(all, dir / "all"),
                                 alone = write_views(lamps, dir / "lamps");
  const float mean = luminance(traced.reflected[0]);
  for (const bool with_lamps : {false, true}) {
    std::vector<std::string> more = {"--scene",         "builtin:cornell", "--sphl",
                                     traced.place.name, "--degree",        "4"};
    if (with_lamps) more.push_back("--emitted"), more.insert(more.end(), alone.begin(), alone.end());
    json_here(import_into(file, with_lamps ? seen : reflected, more));
    const probes::Probe probe = probes::read_probe_file(file).probes.at(0);
    for (std::size_t k = 0; k < traced.reflected.values.size(); ++k)
      EXPECT_LT(glm::distance(probe.reflected.values[k], traced.reflected.values[k]), 1e-3f * mean) << k;
    if (!with_lamps) continue;
    // A quarter of one face, from its edge inwards: over 4π that is its solid angle times its light.
    double solid = 0;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 4; ++x) solid += texel_solid_angle(x, y, 16);
    EXPECT_NEAR(sh::mean(probe.groups.at(0).emitted).x, 5 * solid / (4 * pi_d), 1e-4);
  }
}

TEST(ProbeImport, OfTheSphereOfAnotherIsTheEdgeThatVizFinds) {
  const test::TempDir dir;
  const scene::Scene scene = scene::make_builtin("cornell");
  const std::vector<scene::ProbePlace> places = scene::sphl_places(scene);
  const scene::Scene lit =
      scene::lit_by_sphere(scene, 0, places[1].position, places[1].radius,
                           probes::emitter_radiance(probes::VizSource::intensity, places[1].radius));
  rays::CubeRequest request;
  request.position = places[0].position;
  request.face_size = 16;
  request.path = {.max_depth = 3, .passes = 1, .spp = 64, .seed = 1};
  const trace::PathTracer tracer(lit, 0);
  image::CubeMap cube(16);
  for (const rays::GroupRadiance& group : tracer.incident_radiance(request, {}))
    for (std::size_t f = 0; f < 6; ++f)
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
          cube.faces[f].set_rgb(x, y,
                                cube.faces[f].rgb(x, y) + group.emitted.faces[f].rgb(x, y) +
                                    group.reflected.faces[f].rgb(x, y));
  const std::vector<std::string> faces = write_views(cube, dir / "viz");
  const std::string file = dir / "set.sphl";
  const std::vector<std::string> base = {"--sphl", places[0].name, "--viz-from", places[1].name};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return import_into(file, faces, more);
  };
  const json::Value said = json_here(with({"--scene", "builtin:cornell", "--degree", "4"}));
  const probes::ProbeSet set = probes::read_probe_file(file);
  ASSERT_EQ(set.probes[0].edges.size(), 1u);
  const probes::Edge& edge = set.probes[0].edges[0];
  EXPECT_EQ(edge.from, 1);
  EXPECT_FLOAT_EQ(said["transfer"].number(), edge.transfer);

  const trace::PathTracer plain(scene, 0);
  const bake::VizParams params;
  const std::vector<probes::Edge> ours = bake::viz(plain, probes::dark_set(places, 4), 0, request, params);
  // The random numbers are others, and the rim of the sphere is a few texels with 64 samples each.
  EXPECT_NEAR(edge.transfer / ours.at(0).transfer, 1, 0.03);

  EXPECT_THAT(problem_here(with({"--into", file, "--viz-source", "radiance"})),
              HasSubstr("is not that of the set's edges, intensity"));
  EXPECT_THAT(problem_here(import_into(
                  file, faces, {"--sphl", places[0].name, "--viz-from", places[0].name, "--into", file})),
              HasSubstr("is the probe itself"));
  run_here(with({"--into", file}));
  EXPECT_EQ(probes::read_probe_file(file).probes[0].edges, set.probes[0].edges) << "in place of the first";
}

TEST(ProbeImport, NeedsALayoutForOnePictureAndNoneForSix) {
  const test::TempDir dir;
  const std::vector<std::string> faces = write_views(image::CubeMap(2), dir / "faces");
  const std::vector<std::string> rest = {"--scene", "builtin:cornell", "--sphl", "center"};
  EXPECT_THAT(problem_here(import_into(dir / "x.sphl", {faces[0]}, rest)), HasSubstr("needs --layout"));
  EXPECT_THAT(problem_here(import_into(dir / "x.sphl", {faces[0], faces[1], faces[2]}, rest)),
              HasSubstr("3 pictures are given"));
  std::vector<std::string> with_layout = rest;
  with_layout.insert(with_layout.end(), {"--layout", "strip-h"});
  EXPECT_THAT(problem_here(import_into(dir / "x.sphl", faces, with_layout)),
              HasSubstr("6 pictures are given, but a layout is of one"));
  image::write_image(faces[4], image::Image(3, 2, 3));
  EXPECT_THAT(problem_here(import_into(dir / "x.sphl", faces, rest)), HasSubstr("must be square"));
  EXPECT_FALSE(std::filesystem::exists(dir / "x.sphl"));
}

TEST(ProbeImport, GoesOnWithASetGroupByGroup) {
  const test::TempDir dir;
  const Traced traced(2);
  const std::string picture = dir / "cube.exr", file = dir / "set.sphl";
  image::write_image(picture, image::from_cube(traced.cube, image::Layout::cross_v));
  const std::vector<std::string> base = {"probe",  "import",          picture, "--layout", "cross-v",
                                         "--sphl", traced.place.name, "-o",    file};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return more;
  };
  run_here(with({"--scene", "builtin:cornell", "--degree", "2"}));
  run_here(with({"--into", file, "--group", "sky", "--part", "emitted"}));
  const probes::ProbeSet set = probes::read_probe_file(file);
  ASSERT_EQ(set.light_groups.size(), 2U);
  EXPECT_EQ(set.light_groups[1].name, "sky");
  EXPECT_EQ(set.probes[0].groups.at(1).emitted, set.probes[0].groups.at(0).reflected);
  EXPECT_EQ(sh::mean(set.probes[0].groups[1].reflected), vec3(0));

  EXPECT_THAT(problem_here(with({})), HasSubstr("needs either --into or --scene"));
  EXPECT_THAT(problem_here({"probe", "import", picture, "--layout", "cross-v", "--sphl", "nobody", "--into",
                            file, "-o", file}),
              HasSubstr("there is no probe \"nobody\" (the set has: " + traced.place.name));
}

TEST(ProbeImport, RefusesWhatIsNoCubeAndNoLight) {
  const test::TempDir dir;
  const std::string picture = dir / "x.exr";
  const auto said = [&](const image::Image& image, const char* layout) {
    image::write_image(picture, image);
    return problem_here({"probe", "import", picture, "--layout", layout, "--scene", "builtin:cornell",
                         "--sphl", scene::sphl_places(scene::make_builtin("cornell")).at(0).name, "-o",
                         dir / "y.sphl"});
  };
  EXPECT_THAT(said(image::Image(10, 10, 3), "cross-v"), HasSubstr("x.exr: "));
  EXPECT_THAT(said(image::Image(12, 9, 3), "cross-v"), HasSubstr("x.exr: "));
  image::Image strip(12, 2, 3);
  strip.set_rgb(3, 1, vec3(1, -1, 0));
  EXPECT_THAT(said(strip, "strip-h"), HasSubstr("at pixel (3, 1)"));
  strip.set_rgb(3, 1, vec3(1, std::nanf(""), 0));
  EXPECT_THAT(said(strip, "strip-h"), HasSubstr("light is finite and not negative"));
  EXPECT_FALSE(std::filesystem::exists(dir / "y.sphl"));
}

}  // namespace
}  // namespace ssphh
