/// Renders of random rooms: threads and tiles leave every bit, light is linear, a mirror image is one.

#include <ssphh/core/parallel.h>

#include "property.h"
#include "random_room.h"
#include "thread_count.h"

namespace ssphh::test {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

/// Cuts a rectangle into tiles: each number halves the largest tile somewhere, one way or the other.
std::vector<trace::Tile> cut_up(int width, int height, const std::vector<int>& cuts) {
  std::vector<trace::Tile> tiles{{0, 0, width, height}};
  for (const int cut : cuts) {
    const auto largest = std::max_element(tiles.begin(), tiles.end(), [](const auto& a, const auto& b) {
      return a.width * a.height < b.width * b.height;
    });
    trace::Tile rest = *largest;
    if (cut % 2 == 0 && largest->width > 1) {
      largest->width = 1 + cut % (largest->width - 1);
      rest.x += largest->width, rest.width -= largest->width;
      tiles.push_back(rest);
    } else if (cut % 2 == 1 && largest->height > 1) {
      largest->height = 1 + cut % (largest->height - 1);
      rest.y += largest->height, rest.height -= largest->height;
      tiles.push_back(rest);
    }
  }
  return tiles;
}

/// The first image in which two renders differ.
std::string difference(const trace::RenderState& a, const trace::RenderState& b) {
  const std::pair<const char*, image::Image trace::RenderState::*> images[] = {
      {"color", &trace::RenderState::color},       {"direct", &trace::RenderState::direct},
      {"indirect", &trace::RenderState::indirect}, {"albedo", &trace::RenderState::albedo},
      {"normal", &trace::RenderState::normal},     {"depth", &trace::RenderState::depth},
      {"coverage", &trace::RenderState::coverage}};
  for (const auto& [name, image] : images) {
    if ((a.*image).pixels != (b.*image).pixels) return name;
  }
  if (a.groups.size() != b.groups.size()) return "number of groups";
  for (std::size_t g = 0; g < a.groups.size(); ++g) {
    if (a.groups[g].pixels != b.groups[g].pixels) return "group " + std::to_string(g);
  }
  if (a.paths != b.paths) return "number of paths";
  return a.rays == b.rays ? "" : "number of rays";
}

TEST(RenderProperty, AnyTilesByAnyNumberOfThreadsGiveTheSameBits) {
  EXPECT_TRUE(for_all(seeds(), lists(integers(0, 97), 0, 6), integers(1, 4), integers(1, 4))
                  .cases(20)
                  .holds([](std::uint64_t seed, const std::vector<int>& cuts, int threads,
                            int other_threads) -> AssertionResult {
                    const scene::Scene scene = random_room(seed);
                    const trace::PathTracer tracer(scene);
                    trace::RenderParams params = view_of_room(12, 2, 4, seed);
                    params.path.passes = 2;
                    params.per_group = true;
                    trace::RenderState whole;
                    {
                      const Threads limit(threads);
                      tracer.render(params, whole);
                    }
                    const Threads limit(other_threads);
                    trace::RenderState pasted = trace::empty_state(params, tracer.light_groups().size());
                    for (const trace::Tile& tile : cut_up(params.width, params.height, cuts)) {
                      params.tile = tile;
                      trace::RenderState part;
                      tracer.render(params, part);
                      paste(pasted, part, tile);
                    }
                    const std::string differs = difference(pasted, whole);
                    if (differs.empty()) return AssertionSuccess();
                    return AssertionFailure() << "another " << differs;
                  }));
}

/// Largest difference of two pictures, relative to the second's brightest pixel.
double apart(const image::Image& a, const image::Image& b) {
  float worst = 0, brightest = 1e-30f;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    worst = std::max(worst, std::abs(a.pixels[i] - b.pixels[i]));
    brightest = std::max(brightest, b.pixels[i]);
  }
  return static_cast<double>(worst / brightest);
}

TEST(RenderProperty, AllLightTimesKIsThePictureTimesKToTheBit) {
  EXPECT_TRUE(for_all(seeds(), integers(-12, 12)).cases(20).holds([](std::uint64_t seed, int exponent) {
    const float k = std::ldexp(1.0f, exponent);
    const scene::Scene scene = random_room(seed);
    scene::Scene brighter = scene;
    for (scene::Light& light : brighter.lights) light.intensity *= k;
    for (scene::Material& material : brighter.materials) material.emission *= k;
    brighter.environment->color *= k;
    const trace::RenderParams params = view_of_room(10, 2, 4, seed);
    image::Image expected = render(scene, params).color;
    for (float& x : expected.pixels) x *= k;
    // A power of two changes no rounding, no choice among lights and no end of a path.
    return render(brighter, params).color.pixels == expected.pixels;
  }));
}

/// [quarter][channel]
using Quarters = std::array<std::array<Samples, 3>, 4>;
/// Means of a picture's quarters over independent seeds.
Quarters quarters(const scene::Scene& scene, trace::RenderParams params, std::uint64_t first_seed,
                  bool mirrored) {
  const trace::PathTracer tracer(scene);
  Quarters result;
  for (std::uint64_t n = 0; n < 32; ++n) {
    params.path.seed = first_seed + n;
    trace::RenderState state;
    tracer.render(params, state);
    std::array<glm::dvec3, 4> sums{};
    for (int y = 0; y < params.height; ++y) {
      for (int x = 0; x < params.width; ++x) {
        const bool right = (2 * x >= params.width) != mirrored;
        sums[std::size_t(right) + (2 * y >= params.height ? 2 : 0)] += glm::dvec3(state.color.rgb(x, y));
      }
    }
    for (std::size_t q = 0; q < 4; ++q) {
      for (std::size_t c = 0; c < 3; ++c)
        result[q][c].add(sums[q][static_cast<glm::length_t>(c)] * 4 / (params.width * params.height));
    }
  }
  return result;
}

AssertionResult same_quarters(const Quarters& a, const Quarters& b, Significance significance) {
  for (std::size_t q = 0; q < 4; ++q) {
    for (std::size_t c = 0; c < 3; ++c) {
      // Coordinates that round anew change edges: 1e-5.
      if (const auto agree = means_agree(a[q][c], b[q][c], significance, 1e-5); !agree) return agree;
    }
  }
  return AssertionSuccess();
}

/// That lamp alone, and twice with half of its intensity, in one group or two.
std::pair<scene::Scene, scene::Scene> whole_and_split(std::uint64_t seed, scene::LightType type,
                                                      bool two_groups) {
  scene::Scene scene = random_room(seed);
  scene.environment.reset();
  for (scene::Material& material : scene.materials) material.emission = vec3(0);
  std::erase_if(scene.lights, [&](const scene::Light& light) { return light.type != type; });
  scene::Scene split = scene;
  split.lights[0].intensity /= 2;
  split.lights.push_back(split.lights[0]);
  if (two_groups) split.lights[1].name = "twin";
  return {std::move(scene), std::move(split)};
}

TEST(RenderProperty, ALampThatIsAPointMayBeSplitInTwoAndEverySampleStays) {
  EXPECT_TRUE(for_all(seeds(), one_of<scene::LightType>({scene::LightType::point, scene::LightType::spot}),
                      integers(0, 1))
                  .cases(20)
                  .holds([](std::uint64_t seed, scene::LightType type, int groups) {
                    const auto [whole, split] = whole_and_split(seed, type, groups > 0);
                    const trace::RenderParams params = view_of_room(10, 2, 4, seed);
                    // Each sample is I / 2 over a chance of one half.
                    return at_most(apart(render(split, params).color, render(whole, params).color), 2e-5);
                  }));
}

TEST(RenderProperty, ALampWithAnExtentMayBeSplitInTwoAndTheMeanStays) {
  constexpr int cases = 20;
  const Significance significance{1e-3, cases * 12};
  EXPECT_TRUE(for_all(seeds(),
                      one_of<scene::LightType>({scene::LightType::sphere, scene::LightType::directional}),
                      integers(0, 1))
                  .cases(cases)
                  .holds([&](std::uint64_t seed, scene::LightType type, int groups) -> AssertionResult {
                    const auto [whole, split] = whole_and_split(seed, type, groups > 0);
                    const trace::RenderParams params = view_of_room(8, 2, 3, 0);
                    // Rays that meet both halves weigh them otherwise than one: another estimate of the same.
                    return same_quarters(quarters(whole, params, 0, false),
                                         quarters(split, params, 1000, false), significance);
                  }));
}

TEST(RenderProperty, AMirroredSceneGivesTheMirroredPicture) {
  constexpr int cases = 20;
  const Significance significance{1e-3, cases * 12};
  EXPECT_TRUE(for_all(seeds(), directions())
                  .cases(cases)
                  .holds([&](std::uint64_t seed, const vec3& n) -> AssertionResult {
                    const scene::Scene scene = random_room(seed);
                    const mat3 flip = mat3(1) - 2.0f * glm::outerProduct(n, n);
                    // Meshes turn inside out with a mirror and must be lit from the same side; lamps look
                    // along their mirrored −z.
                    scene::Scene mirrored = scene;
                    for (std::size_t m = 0; m < mirrored.meshes.size(); ++m) {
                      const int material = mirrored.meshes[m].material;
                      mirrored.meshes[m] = scene::transformed(mirrored.meshes[m], mat4(flip));
                      mirrored.meshes[m].material = material;
                    }
                    for (const scene::Light& light : scene.lights) {
                      const auto node = static_cast<std::size_t>(light.node);
                      const scene::Transform& local = scene.nodes[node].local;
                      mirrored.nodes[node].local.translation = flip * local.translation;
                      mirrored.nodes[node].local.rotation = looking(flip * (local.rotation * vec3(0, 0, -1)));
                    }
                    trace::RenderParams params = view_of_room(8, 4, 3, 0), there = params;
                    const mat4& w = params.camera.world;
                    // Right turned around once more, so that it stays a rotation: the picture is seen in a
                    // mirror.
                    there.camera.world = mat4(vec4(-(flip * vec3(w[0])), 0), vec4(flip * vec3(w[1]), 0),
                                              vec4(flip * vec3(w[2]), 0), vec4(flip * vec3(w[3]), 1));
                    return same_quarters(quarters(scene, params, seed, false),
                                         quarters(mirrored, there, ~seed / 2, true), significance);
                  }));
}

}  // namespace
}  // namespace ssphh::test
