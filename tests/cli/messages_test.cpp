// What the tool says of what it cannot do, in full: where, what is wrong, and what to do about it.

#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/image/io.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>

#include "commands/command.h"
#include "expected_text.h"
#include "here.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

/// A line a command and one what it says, with the folder's name taken out of both.
class Messages : public testing::Test {
 protected:
  void add(const std::vector<std::string>& arguments) {
    std::string lines = fmt::format("ssphh {}\n  {}\n", fmt::join(arguments, " "), said(arguments));
    const std::string folder = dir_.path().string();
    for (std::size_t at; (at = lines.find(folder)) != std::string::npos;)
      lines.replace(at, folder.size(), "DIR");
    said_ += lines;
  }
  static std::string said(const std::vector<std::string>& arguments) {
    try {
      return test::problem_here(arguments);
    } catch (const app::ParsingEnded& wrong) {
      return std::string("usage: ") + wrong.what();
    }
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name) << text;
    return dir_ / name;
  }
  std::string picture(const std::string& name, int width, int height, float value = 0.5f) const {
    image::Image image(width, height);
    std::ranges::fill(image.pixels, value);
    image::write_image(dir_ / name, image);
    return dir_ / name;
  }
  /// As INIT makes them: without light and without edges.
  std::string probes_of(const std::string& scene) const {
    const std::string file = dir_ / "p.sphl";
    probes::write_probe_file(place::init_from_scene(scene::make_builtin(scene), 2, 0), file);
    return file;
  }
  void expect(const std::string& file) { test::expect_text_of("tests/cli/expected/" + file, said_); }

  const test::TempDir dir_{test::memory_dir()};
  std::string said_;
};

TEST_F(Messages, OfSphericalHarmonics) {
  add({"sh", "eval", "--degree", "2", "--direction", "0", "0", "0"});
  const auto file = [&](const std::string& name, const std::string& text) {
    add({"sh", "irradiance", write(name, text), "--normal", "0", "0", "1"});
  };
  const std::string one = R"("coefficients": [[1,2,3]])";
  file("list.json", "[]");
  file("degree.json", "{" + one + "}");
  file("half.json", R"({"degree": 0.5, )" + one + "}");
  file("none.json", R"({"degree": 0})");
  file("object.json", R"({"degree": 0, "coefficients": {}})");
  file("unity.json", R"({"degree": 0, "convention": "unity", )" + one + "}");
  file("eleven.json", R"({"degree": 11, )" + one + "}");
  file("minus.json", R"({"degree": -1, )" + one + "}");
  file("count.json", R"({"degree": 1, )" + one + "}");
  file("row.json", R"({"degree": 0, "coefficients": [[1,2]]})");
  file("flat.json", R"({"degree": 0, "coefficients": [1]})");
  file("word.json", R"({"degree": 0, "coefficients": [[1,2,"3"]]})");
  file("large.json", R"({"degree": 0, "coefficients": [[1,2,1e39]]})");
  const std::string good = write("good.json", R"({"degree": 0, )" + one + "}");
  add({"sh", "rotate", good});
  add({"sh", "rotate", good, "--axis", "0", "0", "0", "--angle", "1"});
  add({"sh", "rotate", good, "--axis", "0", "1", "0", "--angle", "inf"});
  add({"sh", "rotate", good, "--quaternion", "0", "0", "0", "0"});
  add({"sh", "convert", good, "--from", "nobody", "--to", "ssphh"});
  add({"sh", "convert", good, "--to", "nobody"});
  add({"sh", "window", good});
  add({"sh", "window", good, "--lanczos", "0"});
  add({"sh", "window", good, "--hanning", "-1"});
  add({"sh", "project", picture("nan.exr", 8, 4, std::numeric_limits<float>::quiet_NaN()), "--layout",
       "equirect", "--degree", "2"});
  add({"cubemap", "convert", picture("odd.exr", 5, 3), "-o", dir_ / "x.exr", "--from", "cross-h", "--to",
       "equirect"});
  expect("messages_sh.txt");
}

TEST_F(Messages, OfPictures) {
  const std::string out = dir_ / "x.exr", probes = probes_of("box");
  const std::vector<std::string> render = {"render", "builtin:box", "-o", out};
  const auto with = [&](const std::vector<std::string>& more) { add(test::joined(render, more)); };
  with({"--at", "nobody", "--projection", "cube"});
  with({"--at", "0,1,0"});
  with({"--camera", "nobody"});
  with({"--method", "ssphh", "--broker", "ipc:///nowhere"});
  with({"--method", "vpl", "--probes", probes});
  with({"--param", "photons=8"});
  with({"--method", "ssphh", "--probes", probes, "--param", "x=1"});
  with({"--method", "vpl", "--broker", "ipc:///nowhere"});
  with({"--method", "vpl", "--param", "nothing=1"});
  with({"--method", "vpl", "--param", "photons=many"});
  with({"--occlusion", "0.5"});
  with({"--indirect-scale", "2"});
  with({"--resume", "--broker", "ipc:///nowhere"});
  with({"--broker", "tcp://192.0.2.1:5"});
  with({"--broker", "nonsense"});
  with({"--method", "ssphh", "--lookup", "light", "--weights", "mls", "--probes", probes});
  with({"--method", "ssphh", "--weights", "fitted", "--probes", probes});
  with({"--backend", "gl", "--method", "path"});
  with({"--backend", "gl", "--method", "prt"});
  with({"--backend", "gl", "--method", "vpl", "--projection", "cube"});
  with({"--backend", "gl", "--method", "vpl", "--resume"});
  with({"--backend", "gl", "--method", "vpl", "--probes", probes});
  with({"--backend", "gl", "--method", "ssphh", "--param", "x=1"});
  with({"--backend", "gl", "--method", "direct", "--aov", "groups"});
  const std::vector<std::string> bench = {"bench-frame", "builtin:box"};
  add(test::joined(bench, {"--ratio"}));
  add(test::joined(bench, {"--method", "vpl", "--probes", probes}));
  add(test::joined(bench, {"--method", "vpl", "--move"}));
  add(test::joined(bench, {"--param", "photons=8"}));
  add({"truth", "builtin:box", "-o", out, "--renderer", "cycles", "--broker", "ipc:///nowhere"});
  add({"turntable", "builtin:box", "-o", write("file", "")});
  for (const char* size : {"63x64", "64x63", "16385x64", "64x16385", "64", "64x64x", "axb"})
    add({"view", "builtin:box", "--size", size});
  add({"compare", picture("a.exr", 2, 3), picture("b.exr", 3, 2)});
  add({"compare", dir_ / "a.exr", dir_ / "a.exr", "-o", dir_ / "map.jpg"});
  expect("messages_pictures.txt");
}

TEST_F(Messages, OfProbes) {
  const std::string out = dir_ / "x.sphl", probes = probes_of("box");
  const std::string bare = write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  add({"hier", probes, "-o", out, "--scale", "lamp"});
  add({"hier", probes, "-o", out, "--scale", "lamp=1,2"});
  add({"hier", probes, "-o", out, "--scale", "lamp=1,2,3,4"});
  add({"hier", probes, "-o", out, "--scale", "lamp=x"});
  add({"hier", probes, "-o", out, "--scale", "nobody=1"});
  const std::vector<std::string> bake = {"bake", "builtin:box", "-o", out};
  const auto with = [&](const std::vector<std::string>& more) { add(test::joined(bake, more)); };
  with({"--viz-transfer", "--viz", "links"});
  with({"--operator", "surfel", "--gen", "local"});
  with({"--operator", "surfel", "--spp", "4"});
  with({"--viz", "path", "--records", "0", "--directions", "64"});
  with({"--viz", "off", "--threshold", "0.5"});
  with({"--operator", "surfel", "--broker", "ipc:///nowhere"});
  add({"bake", bare, "-o", out, "--probes", "scene"});
  const std::string place = dir_ / "x.ssphh.json";
  add({"place", "builtin:box", "-o", place, "--probes", "scene"});
  write("s.ssphh.json", R"({"scene": "builtin:box"})");
  add({"place", dir_ / "s.ssphh.json", "-o", dir_ / "s.ssphh.json"});
  add({"place", dir_ / "s.ssphh.json", "--overlay", dir_ / "s.ssphh.json", "-o", place});
  add({"relight", bare, "--probes", "scene", "--animate", "time=0:1"});
  add({"relight", "builtin:box", "--operator", "bounce", "--poses", "3"});
  add({"relight", "builtin:box", "-o", write("frames", "")});
  add({"respond", "builtin:two-rooms", "--method", "direct", "--event", "time=1:1"});
  add({"measure", "builtin:box"});
  add({"measure", "builtin:cornell", "--method", "direct", "--points", "16", "--box", "90,90,90,91,91,91"});
  add({"measure", "builtin:box", "--method", "nobody", "--points", "2", "--truth-spp", "2"});
  add({"measure", "builtin:box", "--method", "vpl,nothing=1", "--points", "2", "--truth-spp", "2"});
  add({"leak", "builtin:box", "--probes", probes, "-o", dir_ / "map.jpg"});
  add({"probe", "info", write("x.sphl.json", "{}")});
  expect("messages_probes.txt");
}

}  // namespace
}  // namespace ssphh
