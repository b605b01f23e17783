/// Contracts of libs/sh.

#include <array>

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

#include "contract.h"

namespace ssphh::test {
namespace {

using sh::RadianceSh;

constexpr vec3 up(0, 1, 0);

/// More coefficients than any degree of this library has.
RadianceSh too_many() {
  RadianceSh f;
  f.values.assign(sh::coefficient_count(sh::max_degree + 1), vec3(1));
  return f;
}

sh::TransferMatrix torn_matrix() {
  sh::TransferMatrix matrix(2, 2);
  matrix.values.resize(5);
  return matrix;
}

std::vector<Contract> of_values() {
  return {
      refuses("Function", "OfDegreeMinusOne", [] { RadianceSh(-1); }, {"spherical harmonics", "0..10"}),
      refuses("Function", "OfDegreeEleven", [] { RadianceSh(11); }, {"spherical harmonics", "0..10"}),
      refuses("Function", "OfABillionDegrees", [] { RadianceSh(1'000'000'000); }, {"0..10"}),
      refuses(
          "Sum", "OfTwoDegrees", [] { return std::make_unique<RadianceSh>(2); },
          [](RadianceSh& f) { f += RadianceSh(4); }, {"degrees differ"},
          [](RadianceSh& f) { EXPECT_EQ(f, RadianceSh(2)); }),
      refuses("Add", "OfTwoDegrees", [] { sh::add(RadianceSh(1), RadianceSh(3)); }, {"degrees differ"}),
      gives("Degree", "OfNoCoefficients", [] { EXPECT_EQ(RadianceSh().degree(), -1); }),
      gives("Mean", "OfNoCoefficients", [] { EXPECT_EQ(sh::mean(RadianceSh()), vec3(0)); }),
      refuses(
          "CoefficientProduct", "OfOtherDegrees", [] { return std::make_unique<RadianceSh>(2); },
          [](RadianceSh& sum) { sh::add_coefficient_product(sum, RadianceSh(2), RadianceSh(1)); },
          {"coefficient product", "one degree"}, [](RadianceSh& sum) { EXPECT_EQ(sum, RadianceSh(2)); }),
      refuses(
          "RawProduct", "OfOtherDegrees", [] { return std::make_unique<RadianceSh>(2); },
          [](RadianceSh& sum) { sh::add_raw_product(sum, RadianceSh(1), RadianceSh(2)); },
          {"raw product", "one degree"}, [](RadianceSh& sum) { EXPECT_EQ(sum, RadianceSh(2)); }),
      refuses("MeanProduct", "OfASourceWithoutMean",
              [] {
                RadianceSh sum(2);
                sh::add_mean_product(sum, RadianceSh(2), RadianceSh());
              },
              {"mean product"}),
      refuses("TransferMatrix", "OfDegreeEleven", [] { sh::TransferMatrix(2, 11); }, {"0..10"}),
      refuses("TransferMatrixSum", "OfOtherDegrees",
              [] {
                sh::TransferMatrix sum(2, 2);
                sum += sh::TransferMatrix(2, 3);
              },
              {"degrees differ"}),
      refuses("TransferMatrixSum", "WithOneThatLacksValues",
              [] {
                sh::TransferMatrix sum(2, 2);
                sum += torn_matrix();
              },
              {"degrees differ"}),
      refuses("AddPath", "IntoAMatrixThatLacksValues",
              [] {
                sh::TransferMatrix matrix = torn_matrix();
                sh::add_path(matrix, vec3(1), up, up);
              },
              {"transfer matrix"}),
      refuses("AddPath", "IntoAMatrixWithoutDegree",
              [] {
                sh::TransferMatrix matrix;
                sh::add_path(matrix, vec3(1), up, up);
              },
              {"degree"}),
      refuses("MatrixProduct", "OfAnotherDegree",
              [] {
                RadianceSh sum(2);
                sh::add_matrix_product(sum, sh::TransferMatrix(2, 2), RadianceSh(3));
              },
              {"matrix product"}),
      refuses("MatrixProduct", "WithAMatrixThatLacksValues",
              [] {
                RadianceSh sum(2);
                sh::add_matrix_product(sum, torn_matrix(), RadianceSh(2));
              },
              {"matrix product"}),
      refuses("TripleProduct", "OfDegreeEleven", [] { sh::TripleProductTensor(2, 11, 2); }, {"0..10"}),
      refuses("TripleProduct", "OfFactorsOfOtherDegrees",
              [] { sh::TripleProductTensor(1, 1, 2).product(RadianceSh(2), RadianceSh(1)); },
              {"triple product", "degrees"}),
  };
}

std::vector<Contract> of_directions() {
  static std::array<float, 200> room;
  return {
      refuses("EvalBasis", "OfDegreeEleven", [] { sh::eval_basis(11, up, room); }, {"0..10"}),
      refuses("EvalBasis", "WithoutRoom", [] { sh::eval_basis(2, up, std::span(room).first(8)); }, {"room"}),
      refuses("EvalBasisOfMany", "OfDegreeMinusOne", [] { sh::eval_basis(-1, room, room, room, room); },
              {"0..10"}),
      refuses("EvalBasisOfMany", "WithXAndYOfTwoLengths",
              [] {
                sh::eval_basis(1, std::span(room).first(2), std::span(room).first(1),
                               std::span(room).first(2), room);
              },
              {"differ in number"}),
      refuses("Eval", "IntoFewerValuesThanDirections",
              [] {
                const std::array<vec3, 2> directions{up, up};
                std::array<vec3, 1> out;
                sh::eval(RadianceSh(1), directions, out);
              },
              {"each direction"}),
      refuses("Eval", "OfMoreCoefficientsThanDegreeTenHas", [] { sh::eval(too_many(), up); }, {"0..10"}),
      gives("Eval", "OfNoCoefficients", [] { EXPECT_EQ(sh::eval(RadianceSh(), up), vec3(0)); }),
      gives("Eval", "OfADirectionThatIsNoNumber",
            [] {
              RadianceSh f(1);
              f[1] = vec3(1);
              EXPECT_FALSE(is_finite(sh::eval(f, vec3(nan))));
            }),
      refuses("CosineBandFactor", "OfBandEleven", [] { sh::cosine_band_factor(11); }, {"0..10"}),
      refuses("Irradiance", "OfMoreCoefficientsThanDegreeTenHas", [] { sh::irradiance(too_many(), up); },
              {"0..10"}),
      refuses("IrradianceFromRadiance", "OfMoreCoefficientsThanDegreeTenHas",
              [] { sh::irradiance_from_radiance(too_many()); }, {"0..10"}),
      gives("Irradiance", "OfNoCoefficients", [] { EXPECT_EQ(sh::irradiance(RadianceSh(), up), vec3(0)); }),
      refuses("Rotation", "OfAMatrixThatSkews",
              [] {
                glm::dmat3 skew(1);
                skew[1][0] = 0.5;
                sh::Rotation(2, skew);
              },
              {"rotation", "not orthogonal"}),
      refuses("Rotation", "OfAMatrixThatIsNoNumber", [] { sh::Rotation(2, glm::dmat3(double(nan))); },
              {"not orthogonal"}),
      refuses("Rotation", "OfDegreeEleven", [] { sh::Rotation(11, glm::dmat3(1)); }, {"0..10"}),
      refuses("Rotation", "AboutNoAxis", [] { sh::Rotation::about_axis(2, vec3(0), 1); }, {"rotation"}),
      refuses("Rotation", "OfAFunctionOfHigherDegree",
              [] { sh::Rotation(2, glm::dmat3(1)).apply(RadianceSh(3)); }, {"degree"}),
  };
}

std::vector<Contract> of_integrals() {
  static const std::vector<vec3> two(2, up), three(3, up);
  static const std::vector<float> weights(2, 1.0f), texels(6 * 4 * 4 * 3, 1.0f);
  return {
      refuses("Project", "WithWeightsOfAnotherNumber", [] { sh::project(2, three, weights, three); },
              {"differ in number"}),
      refuses("Project", "ToDegreeEleven", [] { sh::project(11, two, weights, two); }, {"0..10"}),
      gives("Project", "OfNoSamples",
            [] { EXPECT_EQ(sh::project(2, {}, std::span<const float>(), {}), RadianceSh(2)); }),
      refuses("ProjectByQuadrature", "ToDegreeEleven",
              [] { sh::project(11, sh::sphere_quadrature(2), [](const vec3&) { return vec3(1); }); },
              {"0..10"}),
      refuses("ProjectByQuadrature", "OfARuleThatLacksWeights",
              [] {
                sh::SphereQuadrature rule = sh::sphere_quadrature(2);
                rule.weights.pop_back();
                sh::project(1, rule, [](const vec3&) { return vec3(1); });
              },
              {"differ in number"}),
      refuses("ProjectByQuadrature", "OfNoFunction",
              [] { sh::project(1, sh::sphere_quadrature(2), nullptr); }, {"no function"}),
      refuses("CubeProjector", "OfFacesWithoutTexels", [] { sh::CubeProjector(2, 0); }, {"texels"}),
      refuses("CubeProjector", "OfDegreeEleven", [] { sh::CubeProjector(11, 4); }, {"0..10"}),
      refuses("CubeProjector", "GivenTwoChannels", [] { sh::CubeProjector(2, 4).project({}, 2); },
              {"3 or 4 channels"}),
      refuses("CubeProjector", "GivenFacesOfAnotherSize",
              [] {
                sh::CubeFaces faces;
                faces.fill(std::span(texels).first(4 * 4 * 3));
                sh::CubeProjector(2, 5).project(faces);
              },
              {"size"}),
      refuses("GaussLegendre", "WithoutNodes", [] { sh::gauss_legendre(0); }, {"one node"}),
      refuses("SphereQuadrature", "OfANegativeDegree", [] { sh::sphere_quadrature(-1); }, {"negative"}),
      refuses("SphereSamples", "WithoutCells", [] { sh::stratified_sphere_samples(0, 1); }, {"one cell"}),
      refuses("HanningWindow", "OfNoWidth", [] { sh::hanning_window(0); }, {"width"}),
      refuses("LanczosWindow", "OfAWidthThatIsNoNumber", [] { sh::lanczos_window(double(nan)); }, {"width"}),
      refuses("ApplyWindow", "ToMoreCoefficientsThanDegreeTenHas",
              [] { sh::apply_window(too_many(), sh::lanczos_window(3)); }, {"0..10"}),
      refuses("Minimum", "OfMoreCoefficientsThanDegreeTenHas", [] { sh::minimum(too_many()); }, {"0..10"}),
      refuses("ChooseWindow", "ForMoreCoefficientsThanDegreeTenHas",
              [] { sh::choose_window(too_many(), sh::NonNegative::radiance); }, {"0..10"}),
      gives("Dering", "OfNoCoefficients", [] { EXPECT_TRUE(sh::dering(RadianceSh()).empty()); }),
      refuses("ZonalFromFunction", "OfDegreeEleven",
              [] { sh::zonal_from_function(11, [](double) { return 1.0; }); }, {"0..10"}),
      refuses("ZonalFromFunction", "OfNoFunction", [] { sh::zonal_from_function(2, nullptr); },
              {"no function"}),
      refuses("ZonalFromFunction", "OfAnEmptyInterval",
              [] {
                sh::zonal_from_function(
                    2, [](double) { return 1.0; }, 1);
              },
              {"[-1, 1)"}),
      refuses("ZonalCosineLobe", "OfDegreeMinusOne", [] { sh::zonal_cosine_lobe(-1); }, {"0..10"}),
      refuses("EvalZonal", "OfNoCoefficients", [] { sh::eval_zonal({}, 1); }, {"zonal"}),
      refuses("RotateZonal", "WithoutRoom",
              [] {
                std::array<float, 3> out;
                sh::rotate_zonal(sh::zonal_cosine_lobe(2), up, out);
              },
              {"room"}),
      refuses("GgxBandScale", "OfAlphaZero", [] { sh::ggx_band_scale(0, 2); }, {"alpha"}),
      gives("GlossyBandScales", "OfARoughnessThatIsNoNumber",
            [] { EXPECT_EQ(sh::glossy_band_scales(nan), sh::glossy_band_scales(0)); }),
      refuses("ConventionFactor", "OfACoefficientThatItDoesNotStore",
              [] { sh::convention_factor(sh::Convention::unity, 9); }, {"convention", "store"}),
      refuses("FromConvention", "OfTwoCoefficients", [] { sh::from_convention(two, sh::Convention::d3dx); },
              {"2"}),
      refuses("FromConvention", "OfNumbersThatAreNone",
              [] { sh::from_convention(std::vector<vec3>(4, vec3(nan)), sh::Convention::d3dx); }, {"finite"}),
      gives("ParseEnum", "OfAnUnknownConvention", [] { EXPECT_FALSE(parse_enum<sh::Convention>("povray")); }),
  };
}

SSPHH_CONTRACTS(ShValues, of_values());
SSPHH_CONTRACTS(ShDirections, of_directions());
SSPHH_CONTRACTS(ShIntegrals, of_integrals());

}  // namespace
}  // namespace ssphh::test
