#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include <ssphh/scene_io/load.h>

#include "error_message.h"
#include "farm_fixtures.h"
#include "shared_scenes.h"

namespace ssphh::farm {
namespace {

using ssphh::test::message_of;
using test::PackedScene;

scene::Scene unpacked(const ScenePackage& package) {
  return unpack_scene(package.manifest, [&](const Hash128& hash, std::uint64_t size) {
    for (const Blob& blob : package.blobs)
      if (blob.hash == hash && blob.bytes.size() == size) return blob.bytes;
    throw Error("blob", "there is none");
  });
}

/// Equal packages are equal bits of every field.
void expect_same(const scene::Scene& scene) {
  const ScenePackage package = pack_scene(scene);
  const scene::Scene back = unpacked(package);
  EXPECT_EQ(pack_scene(back).id, package.id) << scene.name;
  EXPECT_EQ(scene::scene_hash(back), scene::scene_hash(scene)) << scene.name;
  EXPECT_EQ(scene::light_hash(back), scene::light_hash(scene)) << scene.name;
}

TEST(ScenePackage, BuiltinScenesComeBackBitByBit) {
  for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) expect_same(builtin.make());
}

TEST(ScenePackage, FieldsThatNoBuiltinSceneHasComeBack) {
  scene::Scene scene = scene::make_builtin("cornell");
  scene.name = "päck";
  scene.ignored = {"something"};
  scene::Texture texture{"t", 32, 32, std::vector<std::uint8_t>(32 * 32 * 4, 77)};
  scene.textures = {texture, texture};
  scene.materials[0].base_color_texture = {
      1, 1, {0.5f, 0.25f}, {2, -3}, 0.5f, scene::Wrap::clamp, scene::Wrap::mirror, true};
  scene.environment.emplace();
  scene.environment->equirect = image::Image(64, 32);
  scene.environment->rotation = -0.0f;
  scene.animations.push_back(
      {"a", {{0, scene::AnimationPath::scale, scene::Interpolation::step, {0, 1}, {vec4(1), vec4(2)}}}});
  scene::validate(scene);
  const ScenePackage package = pack_scene(scene);
  std::size_t textures = 0;
  for (const Blob& blob : package.blobs) textures += blob.bytes.size() == 32 * 32 * 4;
  EXPECT_EQ(textures, 1u) << "equal textures travel once";
  const scene::Scene back = unpacked(package);
  EXPECT_EQ(back.name, scene.name);
  EXPECT_EQ(back.ignored, scene.ignored);
  EXPECT_TRUE(std::signbit(back.environment->rotation));
  EXPECT_EQ(back.materials[0].base_color_texture.wrap_v, scene::Wrap::mirror);
  expect_same(scene);
}

TEST(ScenePackage, FlatLampsComeBackAndTheirSizeIsOfTheKey) {
  scene::Scene scene = scene::make_builtin("gallery1");
  scene.lights[0].type = scene::LightType::rectangle, scene.lights[0].size = {0.5f, 0.25f};
  scene.lights[1].type = scene::LightType::disc, scene.lights[1].radius = 0.5f;
  scene::validate(scene);
  EXPECT_EQ(unpacked(pack_scene(scene)).lights[0].size, vec2(0.5f, 0.25f));
  expect_same(scene);
  const auto manifest = pack_scene(scene).manifest;
  scene.lights[0].size.y = 0.5f;
  EXPECT_NE(pack_scene(scene).manifest, manifest);
}

TEST(ScenePackage, ProfilesOfLampsComeBackAndBrokenOnesAreRefused) {
  scene::Scene scene = scene::make_builtin("gallery1");
  scene::PhotometricTable table{scene::Photometry::b, {45, 90, 135}, {-30, 60}, {1, 2, 3, 4, 5, 6}};
  scene.lights[0].profile = {"flood.ies", std::make_shared<const scene::PhotometricTable>(table)};
  scene::validate(scene);
  EXPECT_EQ(unpacked(pack_scene(scene)).lights[0].profile, scene.lights[0].profile);
  expect_same(scene);
  table.candela[3] = -1;
  scene.lights[0].profile.table = std::make_shared<const scene::PhotometricTable>(table);
  EXPECT_NE(message_of([&] { unpacked(pack_scene(scene)); }).find("an intensity of -1 cd"),
            std::string::npos);
}

TEST(ScenePackage, RealScenesComeBackBitByBit) {
  SSPHH_SHARED_SCENE(sponza, "sponza/sponza.glb");
  expect_same(scene_io::load_scene(sponza.string()));
}

TEST(ScenePackage, BrokenManifestsAreRefused) {
  const PackedScene packed("cornell");
  const auto& good = packed.package.manifest;
  const auto none = [](const Hash128&, std::uint64_t size) {
    if (size > 1 << 16) throw Error("blob", "there is none");
    return std::vector<std::byte>(size);
  };
  for (std::size_t cut = 0; cut < good.size(); cut += 7) {
    EXPECT_THROW(unpack_scene(std::span(good).first(cut), none), Error) << cut;
  }
  // A flipped bit is refused, repaired or gives another scene; it never crashes.
  int refused = 0;
  for (std::size_t i = 8; i < good.size(); i += 13) {
    auto bad = good;
    bad[i] ^= std::byte{0x40};
    try {
      unpack_scene(bad, none);
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

scene::Scene with_texture(int width, int height, std::size_t bytes) {
  scene::Scene scene;
  scene.textures = {{"t", width, height, std::vector<std::uint8_t>(bytes, 77)}};
  return scene;
}

TEST(ScenePackage, ArraysOverAKibibyteTravelAlone) {
  EXPECT_EQ(pack_scene(with_texture(16, 16, 1024)).blobs.size(), 0u);
  EXPECT_EQ(pack_scene(with_texture(257, 1, 1028)).blobs.size(), 1u);
  expect_same(with_texture(16, 16, 1024));
  expect_same(with_texture(257, 1, 1028));
}

TEST(ScenePackage, PicturesAreAsLargeAsTheySay) {
  const std::string wrong = "scene manifest: texture \"t\": its size does not fit its texels";
  const auto texture = [](int width, int height, std::size_t bytes) {
    return message_of([&] { unpacked(pack_scene(with_texture(width, height, bytes))); });
  };
  EXPECT_EQ(texture(1 << 20, 1, std::size_t{4} << 20), "no error");
  EXPECT_EQ(texture(1, 1 << 20, std::size_t{4} << 20), "no error");
  EXPECT_EQ(texture((1 << 20) + 1, 1, (std::size_t{4} << 20) + 4), wrong);
  EXPECT_EQ(texture(1, (1 << 20) + 1, (std::size_t{4} << 20) + 4), wrong);
  EXPECT_EQ(texture(-3, -3, 36), wrong);
  EXPECT_EQ(texture(3, 3, 32), wrong);
  EXPECT_EQ(texture(3, 3, 40), wrong);

  const auto environment = [](int width, int height, int channels, std::size_t floats) {
    scene::Scene scene;
    image::Image& e = scene.environment.emplace().equirect;
    e.width = width, e.height = height, e.channels = channels;
    e.pixels.resize(floats, 1);
    return message_of([&] { unpacked(pack_scene(scene)); });
  };
  EXPECT_EQ(environment(4, 2, 3, 24), "no error");
  for (const int channels : {0, 5, -1}) {
    EXPECT_EQ(environment(4, 2, channels, static_cast<std::size_t>(8 * std::abs(channels))),
              "scene manifest: environment: its size does not fit its pixels");
  }
  EXPECT_EQ(environment(4, 2, 3, 25), "scene manifest: environment: its size does not fit its pixels");
}

TEST(ScenePackage, TextsHaveALimit) {
  for (const std::size_t length : {std::size_t{1} << 16, (std::size_t{1} << 16) + 1}) {
    scene::Scene scene = with_texture(1, 1, 4);
    scene.name = std::string(length, 'x');
    const ScenePackage package = pack_scene(scene);
    EXPECT_EQ(message_of([&] { unpacked(package); }) == "no error", length == 1 << 16) << length;
  }
}

// A manifest that announces more than it may is refused before anything is asked for.
TEST(ScenePackage, BlobsFitIntoAPackage) {
  const ScenePackage package = pack_scene(with_texture(257, 1, 1028));
  std::vector<std::byte> size(8), manifest;
  size[0] = std::byte{1028 & 255}, size[1] = std::byte{1028 >> 8};
  const auto said_of_size = [&](std::uint64_t announced, std::size_t sent) {
    manifest = package.manifest;
    const auto at = std::search(manifest.begin(), manifest.end(), size.begin(), size.end());
    EXPECT_NE(at, manifest.end());
    std::memcpy(&*at, &announced, sizeof(announced));
    return message_of([&] {
      unpack_scene(manifest, [&](const Hash128&, std::uint64_t asked) {
        EXPECT_EQ(asked, announced);
        if (sent == 0) throw Error("blob", "was asked for");
        return std::vector<std::byte>(sent);
      });
    });
  };
  EXPECT_EQ(said_of_size(1028, 1028), "no error");
  const std::string hash = package.blobs.at(0).hash.hex();
  for (const std::size_t sent : {1027, 1029})
    EXPECT_NE(said_of_size(1028, sent).find(hash + " has another size"), std::string::npos);
  EXPECT_EQ(said_of_size(max_package_bytes, 0), "blob: was asked for");
  EXPECT_NE(said_of_size(max_package_bytes + 1, 0).find("larger than a package may be"), std::string::npos);
}

TEST(ScenePackage, MovedLampSendsTheManifestAlone) {
  scene::Scene scene = scene::make_builtin("gallery1");
  const ScenePackage before = pack_scene(scene);
  ASSERT_FALSE(scene.nodes.empty());
  scene.nodes.back().local.translation.x += 0.5f;
  const ScenePackage after = pack_scene(scene);
  EXPECT_NE(before.id, after.id);
  ASSERT_EQ(before.blobs.size(), after.blobs.size());
  for (std::size_t i = 0; i < before.blobs.size(); ++i) EXPECT_EQ(before.blobs[i].hash, after.blobs[i].hash);
}

}  // namespace
}  // namespace ssphh::farm
