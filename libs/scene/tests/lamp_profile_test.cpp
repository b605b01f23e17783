/// Photometric profiles: intensities against formulas, and what is refused.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/scene/lamp_profile.h>

#include "error_message.h"

namespace ssphh::scene {
namespace {

using ssphh::test::message_of;

// Type C: 0 and 180 degrees from the aim, and a quarter turn toward +x, +y.
TEST(LampProfile, OfTypeCTurnsAboutTheAimFromXTowardY) {
  EXPECT_EQ(photometric_axes(Photometry::c), (mat3(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, -1))));
  const PhotometricTable table{
      Photometry::c, {0, 90, 180}, {0, 90, 180, 270, 360}, {9, 1, 5, 9, 2, 5, 9, 3, 5, 9, 4, 5, 9, 1, 5}};
  const auto at = [&](const vec3& d) { return eval_candela(table, d * photometric_axes(table.type)); };
  EXPECT_FLOAT_EQ(at({0, 0, -1}), 9);
  EXPECT_FLOAT_EQ(at({0, 0, 1}), 5);
  EXPECT_FLOAT_EQ(at({1, 0, 0}), 1);
  EXPECT_FLOAT_EQ(at({0, 1, 0}), 2);
  EXPECT_FLOAT_EQ(at({-1, 0, 0}), 3);
  EXPECT_FLOAT_EQ(at({0, -1, 0}), 4);
  EXPECT_FLOAT_EQ(at(glm::normalize(vec3(1, 1, 0))), 1.5f) << "half way between columns";
  EXPECT_FLOAT_EQ(at(glm::normalize(vec3(-1, 0, -1))), 6) << "half way between rows";
}

// Of types A and B the angle that an eye behind the lamp calls right is toward +x, up is toward +y.
TEST(LampProfile, OfTypesAAndBHaveTheirPolesBelowAndAtTheLeft) {
  for (const Photometry type : {Photometry::a, Photometry::b}) {
    const mat3 axes = photometric_axes(type);
    EXPECT_FLOAT_EQ(glm::determinant(axes), type == Photometry::a ? 1 : -1);
    const float right = 0.3f, up = 0.2f;
    // A: right about the vertical axis, then up from the horizon; B: up about the horizontal axis, then aside
    const vec3 direction =
        type == Photometry::a
            ? vec3(std::cos(up) * std::sin(right), std::sin(up), -std::cos(up) * std::cos(right))
            : vec3(std::sin(right), std::cos(right) * std::sin(up), -std::cos(right) * std::cos(up));
    const vec3 local = direction * axes;
    const float polar = std::acos(local.z), turn = std::atan2(local.y, local.x);
    EXPECT_NEAR(polar - pi / 2, type == Photometry::a ? up : right, 1e-6f);
    EXPECT_NEAR(turn, type == Photometry::a ? right : up, 1e-6f);
  }
}

TEST(LampProfile, IsDarkBeyondItsAngles) {
  const PhotometricTable half{Photometry::c, {0, 90}, {0}, {2, 2}};
  EXPECT_FLOAT_EQ(eval_candela(half, {1, 0, 0}), 2) << "the last angle counts";
  EXPECT_EQ(eval_candela(half, glm::normalize(vec3(1, 0, -0.01f))), 0);
  const PhotometricTable quarter{Photometry::b, {80, 100}, {-10, 10}, {1, 1, 1, 1}};
  EXPECT_FLOAT_EQ(eval_candela(quarter, {1, 0, 0}), 1);
  EXPECT_EQ(eval_candela(quarter, {-1, 0, 0}), 0);
  EXPECT_EQ(eval_candela(quarter, {0, 1, 0}), 0);
  EXPECT_EQ(eval_candela(quarter, {0, 0, 1}), 0);
}

TEST(LampProfile, MeanIsTheIntegralOverTheSphere) {
  const PhotometricTable even{Photometry::c, {0, 180}, {0}, {3, 3}};
  EXPECT_FLOAT_EQ(mean_candela(even), 3);
  // ∫₀^π (π − θ)/π sin θ dθ = 1
  const PhotometricTable ramp{Photometry::c, {0, 180}, {0}, {1, 0}};
  EXPECT_FLOAT_EQ(mean_candela(ramp), 0.5f);
  const PhotometricTable uneven{
      Photometry::b, {30, 70, 90, 150}, {-80, -10, 60}, {0, 1, 2, 0.5f, 3, 1, 0, 2, 0, 4, 1, 1}};
  double sum = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      sum += static_cast<double>(
          eval_candela(uneven, sample_uniform_sphere(vec2((static_cast<float>(i) + 0.5f) / n,
                                                          (static_cast<float>(j) + 0.5f) / n))));
  }
  EXPECT_NEAR(static_cast<double>(mean_candela(uneven)), sum / n / n, 5e-3 * sum / n / n)
      << "cells at the edges of the table are cut";
}

TEST(LampProfile, SaysWhatIsWrong) {
  const PhotometricTable good{Photometry::c, {0, 90}, {0}, {1, 2}};
  const auto said = [&](const auto& change) {
    PhotometricTable table = good;
    change(table);
    return message_of([&] { check_profile(table, "lamp"); });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(said([](auto&) {}), "no error");
  EXPECT_EQ(said([](auto& t) { t.polar = {0}, t.candela = {1}; }),
            "lamp: its profile has 1 by 1 angles, at least 2 by 1 are needed");
  EXPECT_EQ(said([](auto& t) { t.turn.clear(); }),
            "lamp: its profile has 2 by 0 angles, at least 2 by 1 are needed");
  EXPECT_EQ(said([](auto& t) { t.turn.resize(max_profile_values); }),
            "lamp: its profile has 2 by 262144 angles, 262144 intensities are the most");
  EXPECT_EQ(said([](auto& t) { t.candela.pop_back(); }),
            "lamp: its profile has 1 intensities for 2 by 1 angles");
  EXPECT_EQ(said([](auto& t) {
              t.polar = {0, 181};
            }),
            "lamp: its polar angle 181 is not within 0 to 180 degrees");
  EXPECT_EQ(said([&](auto& t) {
              t.polar = {nan, 90};
            }),
            "lamp: its polar angle nan is not within 0 to 180 degrees");
  EXPECT_EQ(said([](auto& t) { t.polar = {90, 90}; }), "lamp: its polar angles do not rise: 90 follows 90");
  EXPECT_EQ(said([](auto& t) { t.turn = {-181}; }),
            "lamp: its turn angle -181 is not within -180 to 360 degrees");
  EXPECT_EQ(said([](auto& t) {
              t.turn = {-90, 360}, t.candela = {1, 1, 1, 1};
            }),
            "lamp: its turn angles span more than 360 degrees");
  EXPECT_EQ(said([](auto& t) { t.candela = {1, -1}; }), "lamp: its profile has an intensity of -1 cd");
  EXPECT_EQ(said([&](auto& t) { t.candela = {nan, 1}; }), "lamp: its profile has an intensity of nan cd");
  EXPECT_EQ(said([](auto& t) { t.candela = {0, 0}; }), "lamp: its profile is dark in every direction");
}

TEST(LampProfile, IsTheSameWhereItsNumbersAre) {
  const PhotometricTable table{Photometry::c, {0, 90}, {0}, {1, 2}};
  PhotometricTable other = table;
  other.candela[1] = 3;
  const auto profile = [](const PhotometricTable& t) {
    return LampProfile{"p", std::make_shared<const PhotometricTable>(t)};
  };
  EXPECT_EQ(profile(table), profile(table));
  EXPECT_NE(profile(table), profile(other));
  EXPECT_NE(profile(table), (LampProfile{"p", nullptr}));
  EXPECT_EQ(LampProfile{}, LampProfile{});
}

}  // namespace
}  // namespace ssphh::scene
