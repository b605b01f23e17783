// Pictures of another renderer as the light of probes.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/bake/gen.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/image/io.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
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
  EXPECT_THAT(said(strip, "strip-h"), HasSubstr("texel (1, 1) of face 1"));
  strip.set_rgb(3, 1, vec3(1, std::nanf(""), 0));
  EXPECT_THAT(said(strip, "strip-h"), HasSubstr("light is finite and not negative"));
  EXPECT_FALSE(std::filesystem::exists(dir / "y.sphl"));
}

}  // namespace
}  // namespace ssphh
