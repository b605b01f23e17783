// Rooms with windows are inside, with their sills and the floor behind their doors; roofs, plains and courts
// are outside.

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/study/inside.h>
#include <ssphh/study/surface_points.h>

#include "boxes.h"
#include "ray_source.h"
#include "triangle_source.h"

namespace ssphh::study {
namespace {

/// On a plain of 100 m, all walls 0.2 m thick: a house of 6 × 3 × 5 m with a flat roof that reaches 0.5 m
/// over, a window of 3 × 1.4 m above a sill of 0.9 m and a door without a leaf, 1 m wide; and a court of 8 ×
/// 8 m, its walls 3 m.
scene::Scene house_and_court() {
  return boxes(
      {{{-50, -0.2f, -50}, {50, 0, 50}},
       // The house: back, left, right; the front with window (x 1 … 4) and door (x 4.6 … 5.6); the roof.
       {{0, 0, -0.2f}, {6, 3, 0}},
       {{-0.2f, 0, -0.2f}, {0, 3, 5.2f}},
       {{6, 0, -0.2f}, {6.2f, 3, 5.2f}},
       {{0, 0, 5}, {4.6f, 0.9f, 5.2f}},
       {{0, 0.9f, 5}, {1, 3, 5.2f}},
       {{4, 0.9f, 5}, {4.6f, 3, 5.2f}},
       {{1, 2.3f, 5}, {4, 3, 5.2f}},
       {{4.6f, 2.1f, 5}, {5.6f, 3, 5.2f}},
       {{5.6f, 0, 5}, {6, 3, 5.2f}},
       {{-0.7f, 3, -0.7f}, {6.7f, 3.2f, 5.7f}},
       // The court.
       {{20, 0, 0}, {28, 3, 0.2f}},
       {{20, 0, 7.8f}, {28, 3, 8}},
       {{20, 0, 0}, {20.2f, 3, 8}},
       {{27.8f, 0, 0}, {28, 3, 8}}});
}

TEST(Inside, RoomsAreAndRoofsPlainsAndCourtsAreNot) {
  const vec3 up(0, 1, 0), down(0, -1, 0), south(0, 0, 1), north(0, 0, -1), west(-1, 0, 0);
  const std::vector<std::pair<const char*, rays::SurfacePoint>> in = {
      {"floor", {{3, 0, 2}, up}},
      {"ceiling", {{3, 3, 2}, down}},
      {"back wall", {{3, 1.5f, 0}, south}},
      {"window sill", {{2.5f, 0.9f, 5.05f}, up}},
      {"floor below the window", {{2.5f, 0, 4.9f}, up}},
      {"floor behind the door", {{5.1f, 0, 4.8f}, up}},
      {"wall beside the window", {{0.9f, 1.5f, 5}, north}},
      {"corner", {{0.05f, 0, 0.05f}, up}}};
  const std::vector<std::pair<const char*, rays::SurfacePoint>> out = {
      {"plain", {{-30, 0, 30}, up}},
      {"roof", {{3, 3.2f, 2}, up}},
      {"front wall", {{5.8f, 1.5f, 5.2f}, south}},
      {"outside wall", {{-0.2f, 1, 2}, west}},
      {"ground along a wall", {{-0.4f, 0, 2}, up}},
      {"under the eaves", {{-0.45f, 3, 2}, down}},
      {"court", {{24, 0, 4}, up}},
      {"corner of the court", {{20.5f, 0, 0.5f}, up}},
      {"wall of the court", {{24, 1, 0.2f}, south}}};
  const test::TriangleSource source(house_and_court());
  for (const auto& [name, point] : in) EXPECT_TRUE(inside(source, {&point, 1}, 0)[0]) << name;
  for (const auto& [name, point] : out) EXPECT_FALSE(inside(source, {&point, 1}, 0)[0]) << name;
}

TEST(Inside, TellsAllPointsOfAHouseFromThoseOutside) {
  const test::TriangleSource source(house_and_court());
  const scene::Bounds around{{-8, -0.1f, -8}, {14, 4, 13}},
      room{{-0.05f, -0.05f, -0.05f}, {6.05f, 3.05f, 5.05f}};
  const auto points =
      reachable_points(source, std::vector<vec3>{{3, 1.5f, 2}, {3, 2, 12}, {-5, 6, -5}, {12, 6, 2}}, 0,
                       {2000, 1, 0.05f, around});
  const auto found = inside(source, points, 0);
  int rooms = 0, wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool wanted = within(room, points[i].position);
    rooms += wanted;
    wrong += wanted != (found[i] != 0);
  }
  EXPECT_GT(rooms, 200);
  EXPECT_LT(wrong, 20) << "thresholds and reveals may be either";
}

TEST(Inside, AQuarterOfTheSkyMayBeFreeAsAMeterWeighsIt) {
  // Free within an angle about the zenith, whose squared sine is its share; and along the horizon, which is
  // none.
  const auto is_inside = [](float share) {
    const float least = std::sqrt(1 - share);
    const test::RaySource source([=](const vec3& origin, const vec3& d) {
      return origin.y > 0.1f && (d.y > least || d.y == 0) ? rays::RayHit() : test::surface_at(2, d);
    });
    const rays::SurfacePoint floor{{0, 0, 0}, {0, 1, 0}};
    return inside(source, {&floor, 1}, 0)[0] != 0;
  };
  // Of sixteen rays four, and five.
  EXPECT_TRUE(is_inside(4.0f / 16));
  EXPECT_FALSE(is_inside(5.0f / 16));
}

TEST(Inside, ClosedScenesAreAndSingleThingsAreNot) {
  const rays::SurfacePoint floor{{0, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(inside(test::TriangleSource(boxes({{{-2, -1, -2}, {2, 0, 2}}, {{-3, -2, -3}, {3, 3, 3}}})),
                     {&floor, 1}, 0)[0]);
  EXPECT_FALSE(inside(test::TriangleSource(boxes({{{-2, -1, -2}, {2, 0, 2}}})), {&floor, 1}, 0)[0]);
  EXPECT_TRUE(inside(test::TriangleSource(boxes({{{-2, -1, -2}, {2, 0, 2}}})), {}, 0).empty());
}

}  // namespace
}  // namespace ssphh::study
