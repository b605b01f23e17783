/// Which image of a texture is meant, and what is said where none can be read.

#include <gmock/gmock.h>
#include <webp/encode.h>

#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/scene_io/gltf.h>

#include "glb_builder.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;
using test::GlbBuilder;
using testing::ElementsAre;
using testing::IsEmpty;

using Codes = std::vector<std::uint8_t>;

const Codes in_webp = {200, 100, 50, 255}, in_png = {10, 20, 30, 255};

Codes webp(const Codes& pixel) {
  std::uint8_t* out = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(pixel.data(), 1, 1, 4, &out);
  Codes file(out, out + size);
  WebPFree(out);
  return file;
}

Codes png(const Codes& pixel) {
  const auto bytes = image::encode_png(image::Rgba8{1, 1, pixel});
  Codes file(bytes.size());
  std::memcpy(file.data(), bytes.data(), bytes.size());
  return file;
}

class GltfImages : public testing::Test {
 protected:
  GltfImages() {
    set_log_sink([this](LogLevel, const std::string& line) { lines_.push_back(line); });
  }
  ~GltfImages() override { set_log_sink({}); }

  /// A material with a texture of these members; image 0 is a PNG, image 1 a WebP.
  static Scene load(const std::string& texture) {
    GlbBuilder b;
    const int first = b.view(png(in_png)), second = b.view(webp(in_webp));
    return load_gltf(
        b.glb(fmt::format("\"images\":[{{\"bufferView\":{}}},{{\"bufferView\":{}}}],\"textures\":[{{{}}}],"
                          "\"materials\":[{{\"emissiveTexture\":{{\"index\":0}}}}]",
                          first, second, texture)),
        "f");
  }
  std::vector<std::string> lines_;
};

TEST_F(GltfImages, WebpGoesBeforeWhatStandsBesideIt) {
  const Scene both = load("\"source\":0,\"extensions\":{\"EXT_texture_webp\":{\"source\":1}}");
  ASSERT_EQ(both.textures.size(), 1u);
  EXPECT_EQ(both.textures[0].rgba, in_webp);
  EXPECT_EQ(load("\"extensions\":{\"EXT_texture_webp\":{\"source\":1}}").textures.at(0).rgba, in_webp);
  EXPECT_EQ(load("\"source\":0").textures.at(0).rgba, in_png);
  EXPECT_EQ(load("\"source\":1").textures.at(0).rgba, in_webp) << "as the content says";
  EXPECT_THAT(both.ignored, IsEmpty());
  EXPECT_THAT(lines_, IsEmpty());
}

TEST_F(GltfImages, BesideKtx2IsReadOrSaysWhatToDo) {
  const Scene fallback = load("\"source\":0,\"extensions\":{\"KHR_texture_basisu\":{\"source\":1}}");
  EXPECT_EQ(fallback.textures.at(0).rgba, in_png);
  EXPECT_THAT(lines_, IsEmpty());
  const Scene none = load("\"extensions\":{\"KHR_texture_basisu\":{\"source\":1}}");
  EXPECT_THAT(none.textures, IsEmpty());
  EXPECT_THAT(
      lines_,
      ElementsAre("f: textures[0] has no PNG, JPEG or WebP image; the texture is left out (export it with "
                  "PNG, JPEG or WebP textures, or convert each of them with: ktx extract --transcode rgba8 "
                  "IN.ktx2 OUT.png)"));
}

}  // namespace
}  // namespace ssphh::scene_io
