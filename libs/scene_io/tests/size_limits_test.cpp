// Files too large to be meant, which are refused by their size alone: they hold nothing, on no disk.

#include <functional>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/obj.h>

#include "error_message.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

class SizeLimits : public testing::Test {
 protected:
  SizeLimits() {
    set_log_sink([this](LogLevel, const std::string& line) { warnings_ += line + "\n"; });
  }
  ~SizeLimits() override { set_log_sink({}); }

  std::string file(const std::string& name, std::uint64_t size) const {
    write_file(dir_ / name, std::string());
    std::filesystem::resize_file(dir_ / name, size);
    return (dir_ / name).string();
  }
  static std::string too_large(const std::string& path, std::uint64_t limit) {
    return path + ": is too large: " + std::to_string(limit + 1) + " bytes, the limit is " +
           std::to_string(limit);
  }

  const test::TempDir dir_{test::memory_dir()};
  std::string warnings_;
};

constexpr std::uint64_t mib = 1 << 20;

TEST_F(SizeLimits, OfScenesAndOverlays) {
  const std::string scene = file("a.glb", 4096 * mib + 1), overlay = file("o.json", 16 * mib + 1);
  EXPECT_EQ(test::message_of([&] { load_scene(scene); }), too_large(scene, 4096 * mib));
  LoadOptions options;
  options.overlay = overlay;
  EXPECT_EQ(test::message_of([&] { load_scene("builtin:box", options); }), too_large(overlay, 16 * mib));
}

TEST_F(SizeLimits, OfLibrariesAndImages) {
  const std::string library = file("a.mtl", 64 * mib + 1), image = file("i.png", 1024 * mib + 1);
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  load_obj("mtllib a.mtl\n" + triangle, dir_ / "a.obj");
  EXPECT_EQ(warnings_, too_large(library, 64 * mib) + "; default materials stand in\n");
  write_file(dir_ / "b.mtl", "newmtl m\nmap_Kd i.png\n");
  warnings_.clear();
  load_obj("mtllib b.mtl\nusemtl m\n" + triangle, dir_ / "a.obj");
  EXPECT_EQ(warnings_, too_large(image, 1024 * mib) + "; the texture is left out\n");
  const std::string gltf =
      R"({"asset": {"version": "2.0"}, "images": [{"uri": "i.png"}], "textures": [{"source": 0}],
                               "materials": [{"emissiveTexture": {"index": 0}}]})";
  warnings_.clear();
  load_gltf(std::as_bytes(std::span(gltf)), dir_ / "a.gltf");
  const std::string gltf_file = (dir_ / "a.gltf").string();
  EXPECT_EQ(warnings_,
            gltf_file + ": images[0].uri: " + too_large(image, 1024 * mib) + "; the image is left out\n");
}

}  // namespace
}  // namespace ssphh::scene_io
