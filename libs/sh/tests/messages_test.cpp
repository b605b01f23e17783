/// What is meant where nobody says anything, and what is said of what cannot be.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/sh/convert.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/operators.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/triple_product.h>
#include <ssphh/sh/window.h>
#include <ssphh/sh/zonal.h>

#include "error_message.h"

namespace ssphh::sh {
namespace {

using ssphh::test::message_of;

TEST(ShDefaults, AreNamed) {
  EXPECT_EQ(max_degree, 10);
  EXPECT_EQ(max_coefficient_count, 121);
  EXPECT_EQ(RadianceSh().degree(), -1);
  EXPECT_TRUE(RadianceSh().empty());
  EXPECT_FALSE(RadianceSh(0).empty());
  const TransferMatrix matrix;
  EXPECT_EQ(matrix.arriving_degree, -1);
  EXPECT_EQ(matrix.emitted_degree, -1);
  EXPECT_EQ(AutoWindow().width, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(AutoWindow().reached);
  RadianceSh negative(2);
  negative[0] = vec3(1), negative[2] = vec3(3), negative[6] = vec3(3);
  EXPECT_EQ(choose_window(negative).width, choose_window(negative, NonNegative::irradiance).width);
  EXPECT_NE(choose_window(negative).width, choose_window(negative, NonNegative::radiance).width);
  EXPECT_EQ(dering(negative), dering(negative, NonNegative::irradiance));
  const auto f = [](double x) { return x * x; };
  EXPECT_EQ(zonal_from_function(3, f), zonal_from_function(3, f, -1, 64));
}

TEST(ShMessages, OfDegrees) {
  const std::string degree = ": the degree must be 0..10";
  for (const int bad : {-1, 11}) {
    EXPECT_EQ(message_of([&] { require_degree(bad, "here"); }), "here" + degree);
    EXPECT_EQ(message_of([&] { cosine_band_factor(bad); }), "cosine band factor" + degree);
    EXPECT_TRUE(message_of([&] { RadianceSh{bad}; }).ends_with(degree));
    EXPECT_TRUE(message_of([&] { CubeProjector(bad, 1); }).ends_with(degree));
    EXPECT_TRUE(message_of([&] { zonal_cosine_lobe(bad); }).ends_with(degree));
  }
  for (const int good : {0, 10}) EXPECT_EQ(message_of([&] { require_degree(good, "here"); }), "no error");
}

TEST(ShMessages, OfFunctionsThatDoNotFit) {
  RadianceSh one(1), two(2), none;
  const std::string tensor = "triple product: the factors' degrees are not those of the tensor";
  EXPECT_EQ(message_of([&] { TripleProductTensor(1, 2, 2).product(two, two); }), tensor);
  EXPECT_EQ(message_of([&] { TripleProductTensor(1, 2, 2).product(one, one); }), tensor);
  EXPECT_EQ(message_of([&] { TripleProductTensor(1, 2, 2).product(one, two); }), "no error");
  EXPECT_EQ(message_of([&] { one += two; }), "sum of spherical functions: their degrees differ");
  EXPECT_EQ(message_of([&] { add_coefficient_product(one, two, one); }),
            "coefficient product: sum, response and source must have one degree");
  EXPECT_EQ(message_of([&] { add_coefficient_product(one, one, two); }),
            "coefficient product: sum, response and source must have one degree");
  EXPECT_EQ(message_of([&] { add_raw_product(one, one, two); }),
            "raw product: sum, response and source must have one degree");
  EXPECT_EQ(message_of([&] { add_mean_product(one, two, one); }),
            "mean product: sum and response must have one degree, and the source a mean");
  EXPECT_EQ(message_of([&] { add_mean_product(one, one, none); }),
            "mean product: sum and response must have one degree, and the source a mean");
  EXPECT_EQ(message_of([&] { add_mean_product(one, one, two); }), "no error");
  TransferMatrix matrix(1, 2), other(2, 1);
  EXPECT_EQ(message_of([&] { matrix += other; }), "sum of transfer matrices: their degrees differ");
  EXPECT_EQ(message_of([&] { add_matrix_product(one, matrix, two); }), "no error");
  for (RadianceSh* wrong : {&two, &none}) {
    EXPECT_EQ(message_of([&] { add_matrix_product(*wrong, matrix, two); }),
              "matrix product: sum, matrix and source are not of matching degrees");
  }
  EXPECT_EQ(message_of([&] { add_matrix_product(one, matrix, one); }),
            "matrix product: sum, matrix and source are not of matching degrees");
  matrix.values.pop_back();
  EXPECT_EQ(message_of([&] { add_path(matrix, vec3(1), vec3(0, 0, 1), vec3(0, 0, 1)); }),
            "path into a transfer matrix: its degrees and its size do not agree");
}

TEST(ShMessages, OfStoredCoefficients) {
  const auto said = [](std::size_t count, Convention convention) {
    return message_of([&] { from_convention(std::vector<vec3>(count), convention); });
  };
  EXPECT_EQ(said(5, Convention::ssphh),
            "coefficients: 5 values are not those of a whole degree up to 10 (give (degree+1)² values: 1, 4, "
            "9 … 121)");
  EXPECT_EQ(
      said(16, Convention::unity),
      "coefficients: 16 values are not those of a whole degree up to 2 (give (degree+1)² values: 1, 4, 9)");
}

TEST(ShMessages, OfSamples) {
  const std::vector<vec3> two(2, vec3(0, 0, 1)), three(3, vec3(1));
  const std::vector<float> weights(2, 1.0f);
  EXPECT_EQ(message_of([&] { project(1, two, weights, two); }), "no error");
  const std::string number = "projection: directions, weights and radiance differ in number";
  EXPECT_EQ(message_of([&] { project(1, three, weights, two); }), number);
  EXPECT_EQ(message_of([&] { project(1, two, weights, three); }), number);
  SphereQuadrature rule = sphere_quadrature(1);
  EXPECT_EQ(message_of([&] { project(1, rule, nullptr); }), "projection: there is no function to project");
  rule.weights.pop_back();
  EXPECT_EQ(message_of([&] { project(1, rule, [](const vec3&) { return vec3(1); }); }),
            "projection: directions and weights differ in number");
  EXPECT_EQ(message_of([] { gauss_legendre(0); }), "Gauss-Legendre quadrature: it needs at least one node");
  EXPECT_EQ(message_of([] { sphere_quadrature(-1); }), "sphere quadrature: the degree must not be negative");
  EXPECT_EQ(message_of([] { stratified_sphere_samples(0, 1); }),
            "sphere samples: there must be at least one cell");
  std::vector<vec3> out(3);
  EXPECT_EQ(message_of([&] { eval(RadianceSh(1), two, out); }),
            "reconstruction: there is not one value for each direction");
}

TEST(ShMessages, OfCubes) {
  EXPECT_EQ(message_of([] { CubeProjector(1, 0); }), "cube projector: a face needs texels");
  const CubeProjector projector(1, 2);
  const std::vector<float> face(12, 1.0f), large(16, 1.0f);
  CubeFaces faces;
  faces.fill(face);
  EXPECT_EQ(message_of([&] { projector.project(faces); }), "no error");
  for (const int channels : {2, 5})
    EXPECT_EQ(message_of([&] { projector.project(faces, channels); }),
              "cube projector: a texel must have 3 or 4 channels");
  EXPECT_EQ(message_of([&] { projector.project(faces, 4); }),
            "cube projector: a face is not of the projector's size");
  faces[5] = large;
  EXPECT_EQ(message_of([&] { projector.project(faces); }),
            "cube projector: a face is not of the projector's size");
}

TEST(ShMessages, OfTurnsLobesAndWindows) {
  const Rotation turn(1, glm::dmat3(1));
  EXPECT_EQ(message_of([&] { turn.apply(RadianceSh(1)); }), "no error");
  EXPECT_EQ(message_of([&] { turn.apply(RadianceSh(2)); }),
            "rotation: the function's degree is over the rotation's");
  EXPECT_EQ(message_of([] { Rotation(1, glm::dmat3(1.00004)); }), "no error") << "rounding";
  EXPECT_EQ(message_of([] { Rotation(1, glm::dmat3(1.0001)); }), "rotation: the matrix is not orthogonal");
  EXPECT_EQ(message_of([] {
              zonal_from_function(
                  1, [](double x) { return x; }, 1);
            }),
            "zonal harmonics: the interval must begin in [-1, 1)");
  EXPECT_EQ(message_of([] {
              zonal_from_function(
                  1, [](double x) { return x; }, -1.1);
            }),
            "zonal harmonics: the interval must begin in [-1, 1)");
  EXPECT_EQ(message_of([] { zonal_from_function(1, nullptr); }),
            "zonal harmonics: there is no function to project");
  EXPECT_EQ(message_of([] { ggx_band_scale(0, 1); }), "glossy band scale: alpha must be over 0");
  for (const double width : {0.0, -1.0}) {
    EXPECT_EQ(message_of([&] { hanning_window(width); }), "window: its width must be over 0");
    EXPECT_EQ(message_of([&] { lanczos_window(width); }), "window: its width must be over 0");
  }
}

}  // namespace
}  // namespace ssphh::sh
