/// Where records of surfaces are put, and why.

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/surface_gather.h>

#include "solved_scene.h"

namespace ssphh::test {
namespace {

using transport::SurfaceGather;

TEST(RecordPlaces, AreAsManyAsAskedForAndKnowNoLessThanOnesSpreadEvenly) {
  const SolvedScene gallery(scene::make_builtin("gallery1"), 0.16f);
  constexpr int most = 4000, rays = 128;
  const auto some = gallery.where_needed(most, rays);
  const SurfaceGather even(gallery.network(),
                           transport::spread_points(transport::surfel_points(gallery.network()), most), rays);
  const std::size_t count = some->points().size();
  EXPECT_LT(count, 1.1 * most) << "with those in pockets";
  const SurfaceGather as_many(
      gallery.network(),
      transport::spread_points(transport::surfel_points(gallery.network()), static_cast<int>(count)), rays);
  // Place by place: a hundredth of them, where light changes within a record's reach, makes a third of the
  // mean error, so that it takes many to tell ways apart. If this one knew as much as another, z would be
  // below -3 once in 700 times.
  const std::vector<rays::SurfacePoint> places =
      transport::spread_points(transport::surfel_points(gallery.network()), 3000);
  std::vector<probes::RecordLight> truth;
  SurfaceGather(gallery.network(), places, 256).light(gallery.lit, truth);
  const std::vector<double> errors = gallery.errors_between(*some, places, truth);
  const auto z_of = [&](const SurfaceGather& other) {
    const std::vector<double> others = gallery.errors_between(other, places, truth);
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double gain = others[i] - errors[i];
      sum += gain, squares += gain * gain;
    }
    const auto n = static_cast<double>(places.size());
    return sum / std::sqrt(squares - sum * sum / n);
  };
  const double of_as_many = z_of(as_many), of_more = z_of(even);
  RecordProperty("z", fmt::format("{:.1f}, {:.1f}", of_as_many, of_more));
  EXPECT_GT(of_as_many, -3) << "than as many that are spread evenly";
  EXPECT_GT(of_more, -3) << "than those of the finest grid";
}

TEST(RecordPlaces, AreDenseWhereSurfacesMeet) {
  // In darkness only nearness asks for points.
  SolvedScene box(scene::make_builtin("box"), 0.08f);
  box.lit.assign(box.lit.size(), Irradiance4(0));
  box.reflected.assign(box.reflected.size(), Irradiance4(0));
  const auto gather = box.where_needed(static_cast<int>(transport::most_records), 64);
  EXPECT_LT(gather->points().size(), transport::surfel_points(box.network()).size() / 2)
      << "however many it may be";
  scene::Bounds bounds;
  for (const rays::SurfacePoint& p : gather->points()) bounds.add(p.position);
  // Along a wall, by distance from the nearest other wall as a share of the box
  double inner = 0, outer = 0;
  for (const rays::SurfacePoint& p : gather->points()) {
    const vec3 share = (p.position - bounds.min) / (bounds.max - bounds.min);
    float near = 1;
    for (int c = 0; c < 3; ++c) {
      if (std::abs(p.normal[c]) < 0.5f) near = std::min({near, share[c], 1 - share[c]});
    }
    (near > 0.25f ? inner : outer) += 1;
  }
  // A quarter of each wall is that far from its rims.
  EXPECT_GT(outer, 4 * 3 * inner) << "twice as dense as without regard to nearness, at least";
}

TEST(RecordPlaces, FewAreNotTakenFromElsewhereByLampsThatMakeCoarseSurfelsFiner) {
  const auto far_records = [](const scene::Scene& scene) {
    const trace::TransportScene source(scene);
    transport::TransportParams params = small_network();
    params.surfel_size = 0.3f;
    params.most_surfels = 2000;
    const transport::TransportNetwork network(source, scene::positions_of(places_of(scene)), params);
    const std::vector<Irradiance4> none(network.patch_count(), Irradiance4(0)),
        none_of_surfels(network.surfel_count(), Irradiance4(0));
    const auto gather = gather_where_needed(network, {60, 64}, std::array{0.0f}, [&](float) {
      return transport::PosedIrradiance{{}, none, none_of_surfels};
    });
    return std::ranges::count_if(gather->points(),
                                 [](const rays::SurfacePoint& p) { return std::abs(p.position.x) > 5; });
  };
  scene::Scene lit;  // a passage of 40 m with a lamp in its middle
  add_body(lit, "floor", scene::flipped(scene::make_quad({-20, 0, -2}, {40, 0, 0}, {0, 0, 4})), vec3(0.5f));
  add_body(lit, "ceiling", scene::make_quad({-20, 2.5f, -2}, {40, 0, 0}, {0, 0, 4}), vec3(0.5f));
  for (int i = 0; i < 20; ++i) add_sphl(lit, fmt::format("{}", i), {2 * i - 19, 1.2f, 0});
  add_body(lit, "lamp", scene::make_quad({-0.3f, 2.4f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}), vec3(0.5f),
           vec3(10));
  scene::Scene dark = lit;
  dark.materials.back().emission = vec3(0);
  EXPECT_GT(5 * far_records(lit), 4 * far_records(dark)) << "a fifth, where lamps make records denser";
}

TEST(RecordPlaces, AreDenseWhereSurfelsGotWhatPointsDoNotGive) {
  // Of a room in darkness a patch of the floor is said to have got light, which no point tells.
  SolvedScene box(scene::make_builtin("box"), 0.08f);
  box.lit.assign(box.lit.size(), Irradiance4(0));
  const std::vector<rays::SurfacePoint> all = transport::surfel_points(box.network());
  scene::Bounds bounds;
  for (const rays::SurfacePoint& p : all) bounds.add(p.position);
  const auto in_patch = [&](const rays::SurfacePoint& p) {
    const vec3 share = (p.position - bounds.min) / (bounds.max - bounds.min);
    return p.normal.y > 0.5f && glm::length(vec2(share.x, share.z) - 0.5f) < 0.15f;
  };
  const auto points_of = [&](float told) {
    box.reflected.assign(box.reflected.size(), Irradiance4(0));
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (in_patch(all[i])) box.reflected[i] = Irradiance4(told, told, told, 0);
    }
    const auto gather = box.where_needed(static_cast<int>(transport::most_records), 64);
    return std::ranges::count_if(gather->points(), in_patch);
  };
  const auto surfels = std::ranges::count_if(all, in_patch);
  EXPECT_LT(points_of(0), surfels / 4);
  EXPECT_GT(points_of(1), surfels * 3 / 4);
}

TEST(RecordPlaces, AreWhereLightAsksForThemInEveryPose) {
  // On the wall beside a door that stands ajar light changes within centimetres; while it is shut nothing
  // tells. Against gathers of many rays at places around the doorway.
  const scene::Scene rooms = scene::make_builtin("two-rooms");
  const trace::TransportScene source(rooms);
  constexpr float ajar = 0.5f;
  const auto error_of = [&](float begin, int poses) {
    transport::RelightParams params;
    params.transport = small_network();
    params.records = {.points = 8192, .rays = 256, .poses = poses};
    LitSession session(source, places_of(rooms), params, begin);
    session.update();
    session.state.time = ajar;
    session.update();
    const std::vector<Irradiance4> lit = session.patch_irradiance();
    std::vector<rays::SurfacePoint> around;
    for (int row = 0; row < 10; ++row) {
      for (const float z : {-0.65f, -0.6f, -0.55f, -0.5f, 0.5f, 0.55f, 0.6f, 0.65f})
        around.push_back({{0.075f, 0.15f + 0.2f * static_cast<float>(row), z}, {1, 0, 0}});
    }
    std::vector<probes::RecordLight> truth;
    SurfaceGather(session.network(), around, 4096).light(lit, truth);
    const rays::PosedWorld world(source, ajar);
    const probes::SurfaceInterpolation known(
        session.gather()->points(), [&](const vec3& a, const vec3& b) { return world.visible(a, b); });
    double error = 0, all = 0;
    for (std::size_t i = 0; i < around.size(); ++i) {
      vec3 found(0);
      known.irradiance(around[i], session.record_light(), found);
      error += double(glm::distance(found, truth[i][3])), all += double(glm::length(truth[i][3]));
    }
    return error / all;
  };
  const double begun_there = error_of(ajar, 5);
  EXPECT_LT(error_of(0, 5), 1.2 * begun_there);
  EXPECT_GT(error_of(0, 1), 1.25 * begun_there) << "of the first pose alone";
}

using PlaceKey = std::array<float, 6>;

std::vector<PlaceKey> places_of_points(const SurfaceGather& gather) {
  std::vector<PlaceKey> places;
  for (const rays::SurfacePoint& p : gather.points())
    places.push_back({p.position.x, p.position.y, p.position.z, p.normal.x, p.normal.y, p.normal.z});
  return places;
}

TEST(RecordPlaces, AreAllDifferentAndTheSameEachTime) {
  const SolvedScene rooms(scene::make_builtin("two-rooms"));
  const auto once = rooms.where_needed(900, 32), again = rooms.where_needed(900, 32);
  EXPECT_EQ(places_of_points(*once), places_of_points(*again));
  std::vector<probes::RecordLight> light, other;
  once->light(rooms.lit, light);
  again->light(rooms.lit, other);
  EXPECT_EQ(light, other);
  std::vector<PlaceKey> places = places_of_points(*once);
  std::ranges::sort(places);
  EXPECT_EQ(std::ranges::adjacent_find(places), places.end());
}

TEST(RecordPlaces, AreNotWithinARoofThatRestsOnWalls) {
  // From within the roof the tops of the walls show their fronts.
  scene::Scene scene;
  add_body(scene, "ground", scene::make_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), vec3(0.5f));
  const auto box = [&](const char* name, const vec3& low, const vec3& high, const vec3& glow = vec3(0)) {
    add_body(scene, name, scene::make_box(low, high), vec3(0.6f), glow);
  };
  box("left", {-2, 0, -2}, {-1.5f, 2, 2});
  box("right", {1.5f, 0, -2}, {2, 2, 2});
  box("back", {-1.5f, 0, -2}, {1.5f, 2, -1.5f});
  box("front", {-1.5f, 0, 1.5f}, {1.5f, 2, 2});
  box("roof", {-2, 2, -2}, {2, 2.3f, 2});
  box("lamp", {-0.2f, 1.5f, -0.2f}, {0.2f, 1.6f, 0.2f}, vec3(3));
  add_sphl(scene, "inside", {0.5f, 0.8f, 0.4f});
  add_sphl(scene, "outside", {3, 1, 3});
  scene::validate(scene);
  const SolvedScene house(std::move(scene), 0.25f);
  const auto records = gather_where_needed(
      house.network(), {.points = 4000, .rays = 16, .baked = {0}}, std::array{0.0f}, [&](float) {
        return transport::PosedIrradiance{{}, house.lit, house.reflected};
      });
  int on_roof = 0;
  for (const rays::SurfacePoint& p : records->points()) {
    const bool top = std::abs(p.position.y - 2.3f) < 1e-3f;
    on_roof += top && p.normal.y > 0;
    EXPECT_FALSE(top && p.normal.y < 0) << p.position.x << " " << p.position.z;
  }
  EXPECT_GT(on_roof, 30) << "where no SPHL looks";
}

TEST(RecordPlaces, AreNotWithinAWallThatAnSphlStandsIn) {
  // The beam shows its fronts there, and surfels stand on them.
  scene::Scene scene;
  add_body(scene, "ground", scene::make_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), vec3(0.5f));
  add_body(scene, "wall", scene::make_box({-0.5f, 0, -2}, {0.5f, 2, 2}), vec3(0.6f));
  add_body(scene, "beam", scene::make_box({-1.5f, 0.9f, -0.2f}, {1.5f, 1.1f, 0.2f}), vec3(0.6f));
  add_body(scene, "lamp", scene::make_box({1.8f, 2.5f, -0.2f}, {2, 2.6f, 0.2f}), vec3(0.6f), vec3(3));
  add_sphl(scene, "inside", {0, 1.4f, 0});
  add_sphl(scene, "outside", {1.5f, 1.5f, 1});
  scene::validate(scene);
  const SolvedScene wall(std::move(scene), 0.2f);
  const auto within = [](const rays::SurfacePoint& p) {
    return std::abs(p.position.x) < 0.49f && std::abs(p.position.z) < 1.99f && p.position.y < 1.99f;
  };
  const auto count = [&](const std::vector<rays::SurfacePoint>& points) {
    return std::ranges::count_if(points, within);
  };
  EXPECT_GT(count(transport::surfel_points(wall.network())), 150);
  const auto records = wall.where_needed(4000, 16);
  EXPECT_GT(records->points().size(), 100u);
  EXPECT_LT(count(records->points()), 6) << "some see more of the ground within the wall than of the wall";
}

TEST(RecordPlaces, HaveAnOpennessOfTheHarmonicMeanDistance) {
  // Against as many other cosine rays as bring the mean of 1/d to 1 %.
  const SolvedScene room(coloured_room({3, 2.5f, 2}));
  const std::vector<rays::SurfacePoint> points =
      transport::spread_points(transport::surfel_points(room.network()), 30);
  const SurfaceGather gather(room.network(), points, 4096);
  const rays::PosedWorld world(room.source, 0);
  Pcg32 random(7);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Frame frame = Frame::around(points[p].normal);
    constexpr int count = 20000;
    std::vector<rays::RayQuery> rays;
    for (int i = 0; i < count; ++i) {
      rays.push_back({points[p].position + 1e-4f * points[p].normal,
                      frame.to_world(sample_cosine_hemisphere(random.uniform2()))});
    }
    std::vector<rays::RayHit> hits(rays.size());
    std::vector<std::uint8_t> parts(rays.size());
    world.intersect(rays, hits, parts);
    double sum = 0, squares = 0;
    for (const rays::RayHit& hit : hits) {
      const double nearness = 1 / double(hit.distance);
      sum += nearness, squares += nearness * nearness;
    }
    const double mean = sum / count, deviation = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_NEAR(1 / double(gather.openness()[p]), mean, 5 * deviation + 0.02 * mean) << p;
  }
}

TEST(RecordPlaces, GathersThatAreJoinedHoldWhatEachHeld) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::TransportNetwork network(source, positions_of(places_of(scene)), small_network());
  const std::vector<rays::SurfacePoint> all = transport::spread_points(transport::surfel_points(network), 90);
  const std::size_t half = all.size() / 2;
  const auto part = [&](std::size_t begin, std::size_t end) {
    return SurfaceGather(
        network,
        {all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)},
        48);
  };
  SurfaceGather joined = part(0, half), first = part(0, half), second = part(half, all.size());
  joined.append(part(half, all.size()));
  std::vector<Irradiance4> irradiance(network.patch_count());
  for (std::size_t s = 0; s < irradiance.size(); ++s)
    irradiance[s] = vec4(1 + s % 7, 1 + s % 5, 1 + s % 3, 0);
  for (const float time : {0.0f, 0.7f * source.duration()}) {
    network.set_time(time);
    std::vector<probes::RecordLight> whole, of_first, of_second;
    for (SurfaceGather* gather : {&joined, &first, &second}) gather->update_pose();
    joined.light(irradiance, whole);
    first.light(irradiance, of_first);
    second.light(irradiance, of_second);
    of_first.insert(of_first.end(), of_second.begin(), of_second.end());
    EXPECT_EQ(whole, of_first) << time;
  }
  std::vector<PlaceKey> places = places_of_points(first);
  std::ranges::copy(places_of_points(second), std::back_inserter(places));
  EXPECT_EQ(places_of_points(joined), places);
  std::vector<float> openness = first.openness();
  openness.insert(openness.end(), second.openness().begin(), second.openness().end());
  EXPECT_EQ(joined.openness(), openness);
}

TEST(RecordPlaces, NoneIsOnTheUndersideOfWhatLiesOnTheGround) {
  // A road on a plain, both of one side: from a hair below the road one sees the sky below the ground. One
  // that lies on stilts has an underside that a camera may see.
  for (const float gap : {0.0f, 0.5f}) {
    scene::Scene scene = scene::make_builtin("tunnel");
    scene.instances.clear(), scene.meshes.clear(), scene.animations.clear();
    const auto add = [&](scene::Mesh mesh) {
      scene.meshes.push_back(std::move(mesh));
      scene.instances.push_back(
          {static_cast<int>(scene.meshes.size()) - 1, static_cast<int>(scene.nodes.size()), 0, ""});
      scene.nodes.emplace_back();
    };
    add(scene::make_quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}));
    add(scene::make_box({-3, gap, -18}, {3, gap + 0.5f, 18}));
    const trace::TransportScene source(scene);
    const std::array places{vec3(-10, 2, 0), vec3(10, 2, 0)};
    const transport::TransportNetwork network(source, places, {.directions = 64, .link_rays = 16});
    const auto gather = gather_where_needed(network, {2000, 16, 1, {0}}, std::array{0.0f}, [&](float) {
      const std::vector<transport::Irradiance4> dark(network.surfel_count());
      return transport::PosedIrradiance{{}, std::vector<transport::Irradiance4>(network.patch_count()), dark};
    });
    const auto below = std::ranges::count_if(gather->points(), [&](const rays::SurfacePoint& p) {
      return p.normal.y < -0.9f && std::abs(p.position.x) < 3 && p.position.y > gap - 0.1f;
    });
    if (gap > 0) {
      EXPECT_GT(below, 5);
    } else {
      EXPECT_EQ(below, 0);
    }
  }
}

}  // namespace
}  // namespace ssphh::test
