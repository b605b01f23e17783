#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>

#include "property.h"
#include "random_scene.h"

namespace ssphh::scene_io {
namespace {

using namespace ssphh::test;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

TEST(GltfProperty, RandomScenesComeBackWithEveryNumber) {
  EXPECT_TRUE(for_all(seeds()).cases(40).holds([](std::uint64_t seed) -> AssertionResult {
    scene::Scene scene = random_scene(seed);
    scene::validate(scene);
    scene::Scene back = load_gltf(export_glb(scene), "memory.glb");
    const std::vector<std::string> repairs = scene::validate(back);
    if (!repairs.empty()) return AssertionFailure() << repairs.front();
    if (scene_hash(back) != scene_hash(scene)) return AssertionFailure() << "another scene";
    if (light_hash(back) != light_hash(scene)) return AssertionFailure() << "other light";
    // A mesh under several materials has become several: from then on nothing changes any more.
    const std::vector<std::byte> file = export_glb(back);
    if (export_glb(load_gltf(file, "memory.glb")) != file) return AssertionFailure() << "other bytes";
    return AssertionSuccess();
  }));
}

}  // namespace
}  // namespace ssphh::scene_io
