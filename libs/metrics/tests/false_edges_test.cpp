// False edges: planted ones are found, what is in both pictures and what is only noise is not.

#include <cmath>
#include <functional>

#include <gmock/gmock.h>

#include <ssphh/core/random.h>
#include <ssphh/metrics/false_edges.h>

#include "error_message.h"

namespace ssphh::metrics {
namespace {

using image::Image;
using Light = std::function<vec3(double, double)>;

constexpr int width = 160, height = 90;

Image picture(const Light& light) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, light(x, y));
  return image;
}

/// Gaussian, relative, alike in all channels as that of paths.
Image noisy(Image image, float deviation, std::uint64_t seed) {
  Pcg32 random(seed);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const vec2 u = random.uniform2();
      const float normal = std::sqrt(-2 * std::log(1 - u.x)) * std::cos(2 * pi * u.y);
      image.set_rgb(x, y, image.rgb(x, y) * (1 + deviation * normal));
    }
  }
  return image;
}

/// A wall in light that falls off from a corner.
vec3 smooth(double x, double y) {
  return vec3(1, 0.8f, 0.6f) * static_cast<float>(1 / (1 + (x * x + y * y) / 2e4));
}

FalseEdges found(const Image& truth, const Image& test, const FalseEdgeParams& params = {}) {
  return false_edges({truth, {}, {}, {}}, {test, {}, {}, {}}, params);
}

double marked(const FalseEdges& edges, int x, int y) {
  double most = 0;
  for (int i = -1; i <= 1; ++i) {
    const float step = *edges.map.at(x + i, y);
    most = std::max(most, static_cast<double>(std::isnan(step) ? 0 : step));
  }
  return most;
}

/// Share of the rows 10 … 79 in which the step after column x(y) is marked, there or a pixel beside it.
double rate(const FalseEdges& edges, const std::function<double(int)>& x) {
  double count = 0;
  for (int y = 10; y < 80; ++y) count += marked(edges, static_cast<int>(std::lround(x(y))), y) > 0;
  return count / 70;
}

TEST(FalseEdges, OfTheTruthItselfAreNone) {
  const Image truth = noisy(picture(smooth), 0.05f, 1);
  const FalseEdges edges = found(truth, truth);
  EXPECT_EQ(edges.edges, 0u);
  EXPECT_EQ(edges.share, 0);
  EXPECT_EQ(edges.pixels, static_cast<std::uint64_t>(width * height));
  EXPECT_GT(edges.tested, edges.pixels * 9 / 10) << "all but the rim";
  EXPECT_EQ(edges.least_step, 0.03) << "equal pictures have no noise between them";
}

TEST(FalseEdges, DepthsThatJumpByAThirdOfAPerCentAreTwoSurfaces) {
  // Two walls that face the viewer, the right one nearer.
  const auto tested = [](float nearer) {
    SurfacePicture truth{picture(smooth), {}, {}, Image(width, height, 1)};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) *truth.depth.at(x, y) = x < width / 2 ? 3 : 3 / (1 + nearer);
    return false_edges(truth, {truth.indirect, {}, {}, {}}, {}).tested;
  };
  const std::uint64_t one = tested(0);
  EXPECT_EQ(tested(0.0028f), one);
  EXPECT_LT(tested(0.0032f), one) << "no window reaches over the gap";
}

TEST(FalseEdges, AreDrawnOnPicturesOfTheirSizeAlone) {
  const FalseEdges edges = found(picture(smooth), picture(smooth));
  EXPECT_EQ(edge_picture(edges, picture(smooth)).width, width);
  for (const Image& other : {Image(width, height + 1), Image(width - 1, height), Image()})
    EXPECT_EQ(ssphh::test::message_of([&] { edge_picture(edges, other); }),
              "edge picture: the picture is not of the map's size");
}

TEST(FalseEdges, AreDrawnOverThePictureInGreyOfItsOwnBrightness) {
  const auto halves = [](double x, double) { return vec3(x < 80 ? 1.0f : 0.2f); };
  const Image light = picture(halves);
  const FalseEdges edges = found(light, light);
  const image::Rgba8 drawn = edge_picture(edges, light);
  const auto red_at = [&](int x) { return drawn.rgba[4 * (45 * width + x)]; };
  // Of the encoded brightness; 8 bits hold it within 1 of 70.
  EXPECT_NEAR(static_cast<double>(red_at(130)) / red_at(30), std::pow(0.2, 1 / 2.2), 0.02);
  EXPECT_LE(red_at(30), 153) << "so that edges are brighter than any light";
}

TEST(FalseEdges, PlantedStepsAreFoundAndMeasured) {
  const Image truth = noisy(picture(smooth), 0.02f, 1);
  for (const double step : {0.04, 0.08, 0.2}) {
    const Image test = picture(
        [&](double x, double y) { return smooth(x, y) * static_cast<float>(x > 80 ? std::exp(step) : 1); });
    const FalseEdges edges = found(truth, test);
    EXPECT_GT(rate(edges, [](int) { return 80; }), 0.95) << step;
    EXPECT_NEAR(marked(edges, 80, 45), step, 0.01) << step;
    // One or two pixels wide, and nowhere else.
    EXPECT_GT(edges.edges, 80u);
    EXPECT_LT(edges.edges, 3u * height);
    EXPECT_NEAR(edges.share, static_cast<double>(edges.edges) / static_cast<double>(edges.tested), 1e-12);
  }
  const Image faint = picture([&](double x, double y) { return smooth(x, y) * (x > 80 ? 1.015f : 1.0f); });
  EXPECT_EQ(found(truth, faint).edges, 0u) << "nobody sees 1.5 %";
}

TEST(FalseEdges, AreFoundInEveryDirection) {
  const Image truth = noisy(picture(smooth), 0.02f, 1);
  for (const double lean : {0.25, 0.5, 0.75, 1.0, -0.6}) {
    const auto edge = [&](double y) { return 80 + lean * (y - 45); };
    const Image test =
        picture([&](double x, double y) { return smooth(x, y) * (x > edge(y) ? 1.1f : 1.0f); });
    EXPECT_GT(rate(found(truth, test), [&](int y) { return edge(y); }), 0.9) << lean;
  }
  const Image across = picture([&](double x, double y) { return smooth(x, y) * (y > 45 ? 1.1f : 1.0f); });
  const FalseEdges edges = found(truth, across);
  int count = 0;
  for (int x = 10; x < 150; ++x) count += *edges.map.at(x, 45) > 0 || *edges.map.at(x, 44) > 0;
  EXPECT_GT(count, 130);
}

TEST(FalseEdges, SawTeethInARampAreFound) {
  // Every 24 pixels the light falls back by 8 %.
  const Image truth = noisy(picture(smooth), 0.02f, 1);
  const Image test = picture([](double x, double y) {
    const double tooth = x / 24 - std::floor(x / 24);
    return smooth(x, y) * static_cast<float>(1 + 0.08 * tooth);
  });
  const FalseEdges edges = found(truth, test);
  for (int x : {47, 71, 95, 119}) EXPECT_GT(rate(edges, [&](int) { return x; }), 0.95) << x;
  EXPECT_LT(edges.edges, 7u * 3 * height);
}

TEST(FalseEdges, PatchesAreFoundAlongTheirRims) {
  const Image truth = noisy(picture(smooth), 0.02f, 1);
  const Image test = picture(
      [](double x, double y) { return smooth(x, y) * (std::hypot(x - 80, y - 45) < 25 ? 1.12f : 1.0f); });
  const FalseEdges edges = found(truth, test);
  int count = 0;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * pi_d / 180;
    const int x = static_cast<int>(std::lround(80 + 25 * std::cos(angle))),
              y = static_cast<int>(std::lround(45 + 25 * std::sin(angle)));
    count += marked(edges, x, y) > 0 || marked(edges, x, y - 1) > 0 || marked(edges, x, y + 1) > 0;
  }
  EXPECT_GT(count, 0.85 * 360) << "of the rim";
}

TEST(FalseEdges, AColourThatStepsAtTheSameLuminanceIsOne) {
  const Image truth = noisy(picture(smooth), 0.02f, 1);
  const Image test = picture([](double x, double y) {
    vec3 light = smooth(x, y);
    const float before = luminance(light);
    if (x > 80) light.x *= 1.12f, light *= before / luminance(light);
    return light;
  });
  EXPECT_GT(rate(found(truth, test), [](int) { return 80; }), 0.95);
}

TEST(FalseEdges, OfNoiseAloneAreRarerThanThreeInTenThousand) {
  // 4 σ are passed by chance 6·10⁻⁵ times; there are eight directions, three colours and four windows that
  // are hardly independent, and what passes must be sharp and absent from the truth. 1.4·10⁻⁴ were counted.
  std::uint64_t tested = 0, edges = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const FalseEdges one =
        found(noisy(picture(smooth), 0.1f, 2 * seed + 1), noisy(picture(smooth), 0.1f, 2 * seed + 2));
    tested += one.tested, edges += one.edges;
    EXPECT_GT(one.least_step, 0.04) << "and it is told that smaller ones would not have been seen";
    EXPECT_LT(one.least_step, 0.08);
  }
  EXPECT_LT(static_cast<double>(edges), 3e-4 * static_cast<double>(tested));
  EXPECT_EQ(found(noisy(picture(smooth), 0.2f, 9), picture(smooth)).edges, 0u)
      << "a smooth test steps nowhere";
}

TEST(FalseEdges, ShadowsThatBothHaveAreNone) {
  const auto shadow = [](double x, double y) { return smooth(x, y) * (x > 80 + 0.3 * y ? 0.5f : 1.0f); };
  const Image truth = noisy(picture(shadow), 0.03f, 1);
  EXPECT_LE(found(truth, picture(shadow)).edges, 2u);
  // Blurred by a lookup, or a tenth too bright on one side: soft, and there.
  const Image blurred = picture([](double x, double y) {
    const double at = (x - 80 - 0.3 * y) / 6;
    return smooth(x, y) * static_cast<float>(0.75 - 0.25 * std::tanh(at));
  });
  EXPECT_LT(found(truth, blurred).share, 0.002);
  const Image weaker =
      picture([](double x, double y) { return smooth(x, y) * (x > 80 + 0.3 * y ? 0.55f : 1.0f); });
  EXPECT_LT(found(truth, weaker).share, 0.002);
}

TEST(FalseEdges, AreNotSoughtWhereTheSurfaceEnds) {
  // Two walls that meet at column 80, a box in front of them: each is brighter by itself.
  const Image truth = picture(smooth);
  const Image test = picture([](double x, double y) {
    const bool box = x > 30 && x < 60 && y > 30 && y < 60;
    return smooth(x, y) * (box ? 1.3f : x > 80 ? 1.15f : 1.0f);
  });
  Image normal(width, height), depth(width, height, 1), albedo(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      normal.set_rgb(x, y, x > 80 ? vec3(-1, 0, 0) : vec3(0, 0, 1));
      *depth.at(x, y) = x > 30 && x < 60 && y > 30 && y < 60 ? 3.9f : 4;
      albedo.set_rgb(x, y, vec3(0.5f));
    }
  }
  EXPECT_GT(found(truth, test).edges, 150u) << "without knowing of the surfaces";
  const FalseEdges edges = false_edges({truth, albedo, normal, depth}, {test, {}, {}, {}});
  EXPECT_EQ(edges.edges, 0u);
  EXPECT_GT(edges.tested, edges.pixels / 2);
}

TEST(FalseEdges, TextureIsDividedOut) {
  const auto tile = [](double x, double y) {
    return (static_cast<int>(x / 20) + static_cast<int>(y / 20)) % 2 ? vec3(0.8f) : vec3(0.2f);
  };
  const Image albedo = picture(tile);
  const Image truth = noisy(picture([&](double x, double y) { return smooth(x, y) * tile(x, y); }), 0.02f, 1);
  const Image test = picture([&](double x, double y) { return smooth(x, y) * tile(x, y); });
  EXPECT_EQ(false_edges({truth, albedo, {}, {}}, {test, albedo, {}, {}}).edges, 0u);
  const Image stepped =
      picture([&](double x, double y) { return smooth(x, y) * tile(x, y) * (x > 90 ? 1.1f : 1.0f); });
  EXPECT_GT(rate(false_edges({truth, albedo, {}, {}}, {stepped, albedo, {}, {}}), [](int) { return 90; }),
            0.95);
}

TEST(FalseEdges, AreNotSeenWhereAnotherMaterialBegins) {
  const auto paint = [](double x, double) { return x > 80 ? vec3(0.3f) : vec3(0.7f); };
  const Image albedo = picture(paint);
  const Image truth = picture([&](double x, double y) { return smooth(x, y) * paint(x, y); });
  const Image test = picture([&](double x, double y) {
    return smooth(x, y) * paint(x, y) * (x > 80 ? 1.1f : 1.0f) * (x > 120 ? 1.1f : 1.0f);
  });
  const FalseEdges edges = false_edges({truth, albedo, {}, {}}, {test, albedo, {}, {}});
  EXPECT_LT(rate(edges, [](int) { return 80; }), 0.05);
  EXPECT_GT(rate(edges, [](int) { return 120; }), 0.95) << "but in the midst of one";
}

TEST(FalseEdges, DarknessDoesNotDecide) {
  const auto light = [](double x, double y) { return smooth(x, y) * (y > 45 ? 1e-4f : 1.0f); };
  const Image truth = picture(light);
  const Image test = picture([&](double x, double y) { return light(x, y) * (x > 80 ? 1.2f : 1.0f); });
  const FalseEdges edges = found(truth, test);
  EXPECT_GT(marked(edges, 80, 20), 0.1);
  for (int y = 56; y < 85; ++y) EXPECT_EQ(marked(edges, 80, y), 0) << y;
}

TEST(FalseEdges, InBlackPicturesAreNone) {
  const FalseEdges edges = found(Image(width, height), Image(width, height));
  EXPECT_EQ(edges.tested, 0u);
  EXPECT_EQ(edges.share, 0);
}

TEST(FalseEdges, RefuseWhatDoesNotFit) {
  const Image image = picture(smooth);
  const auto problem = [&](const SurfacePicture& truth, const SurfacePicture& test,
                           const FalseEdgeParams& params = {}) {
    return test::message_of([&] { false_edges(truth, test, params); });
  };
  EXPECT_EQ(problem({image, {}, {}, {}}, {Image(8, 8), {}, {}, {}}),
            "the test's indirect light: its size is not that of the truth's indirect light");
  EXPECT_EQ(problem({image, {}, Image(width, height, 1), {}}, {image, {}, {}, {}}),
            "the normals: it has too few channels");
  EXPECT_EQ(problem({image, {}, {}, {}}, {image, {}, {}, {}}, {.across = 2}),
            "false edges: windows of 2 and 8 pixels are none");
  EXPECT_EQ(problem({image, {}, {}, {}}, {image, {}, {}, {}}, {.across = 33}),
            "false edges: windows of 33 and 8 pixels are none");
  EXPECT_NO_THROW(false_edges({image, {}, {}, {}}, {image, {}, {}, {}}, {.across = 32}));
  EXPECT_EQ(problem({image, {}, {}, {}}, {image, {}, {}, {}}, {.threshold = 0}),
            "false edges: thresholds and floor must be over 0, standard errors at least 0");
}

}  // namespace
}  // namespace ssphh::metrics
