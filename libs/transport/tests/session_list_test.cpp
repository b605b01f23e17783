/// Every number of small sessions in a round room, as it was: what closed forms elsewhere bound loosely or at
/// one place alone.

#include <gtest/gtest.h>

#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/link_viz.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/surface_gather.h>

#include "ball_room.h"
#include "expected_text.h"

namespace ssphh::transport {
namespace {

class Listing {
 public:
  void title(const std::string& text) { text_ += "# " + text + "\n"; }
  template <class... Numbers>
  void line(const std::string& name, Numbers... numbers) {
    text_ += name;
    (add(numbers), ...);
    text_ += '\n';
  }
  void function(const std::string& name, const sh::RadianceSh& f) {
    text_ += name;
    for (const vec3& v : f.values) add(v);
    text_ += '\n';
  }
  /// Means over all, and with other weights, so that the order counts.
  template <class Values, class Get>
  void means(const std::string& name, const Values& values, const Get& get) {
    glm::dvec3 plain(0), weighted(0);
    const auto n = static_cast<double>(std::size(values));
    std::size_t i = 0;
    for (const auto& value : values) {
      const glm::dvec3 v(get(value));
      plain += v / n, weighted += static_cast<double>(1 + i++ % 5) * v / n;
    }
    line(name, n, vec3(plain), vec3(weighted));
  }
  void expect(const std::string& name) const {
    ssphh::test::expect_text_of("libs/transport/tests/expected/" + name + ".txt", text_);
  }

 private:
  void add(double number) { text_ += fmt::format(" {:.7g}", std::abs(number) < 1e-7 ? 0.0 : number); }
  void add(const vec3& v) { add(double{v.x}), add(double{v.y}), add(double{v.z}); }

  std::string text_;
};

class SessionList : public testing::Test {
 protected:
  static RelightParams params() {
    RelightParams params;
    params.transport = {.directions = 48, .surfel_size = 0.7f, .link_rays = 24, .samples = 3};
    params.degree = 2;
    params.solve.tolerance = 1e-5f;
    params.bounce.tolerance = 1e-5f;
    params.bounce.weights.method = probes::WeightMethod::distance;
    return params;
  }
  void list_network(const TransportNetwork& network) {
    const auto& surfels = network.surfels().surfels();
    list_.means("surfels", surfels, [](const Surfel& s) { return s.point.position; });
    list_.means("normals", surfels, [](const Surfel& s) { return s.point.normal; });
    list_.means("albedo", network.albedo(), [](const vec3& v) { return v; });
    list_.means("samples", network.samples(), [](const rays::SurfacePoint& p) { return p.position; });
    list_.means("used, existing", network.sample_used(), [](std::uint8_t used) { return vec3(used); });
    list_.means("fixed links", network.links().rows,
                [](const LinkRows::Row& row) { return sums(row.fixed); });
    list_.means("moving links", network.links().rows,
                [](const LinkRows::Row& row) { return sums(row.moving); });
    list_.means("seen", network.seen(), [](const SeenPatch& s) {
      return vec3(static_cast<float>(s.index), unpack_albedo(s.albedo).x, unpack_albedo(s.albedo).z);
    });
    list_.means("distances", network.seen_distance(), [](float d) { return vec3(d); });
    list_.means("emission", network.seen_emission(), [](std::uint16_t e) { return vec3(e); });
    list_.means("mixed", network.mixed_hits(), [](const MixedHit& m) {
      return vec3(static_cast<float>(m.owner), static_cast<float>(m.other.index), m.share);
    });
    list_.line("palette, lost", static_cast<double>(network.palette().size()),
               static_cast<double>(network.lost_links()));
    list_.line("contraction", network.contraction().lower, network.contraction().upper);
  }
  void list_light(const RelightSession& session) {
    const auto colour = [](const Irradiance4& e) { return vec3(e); };
    list_.means("direct", session.patch_direct(), colour);
    list_.means("indirect", session.surfel_irradiance(), colour);
    for (const sh::RadianceSh& f : session.reflected()) list_.function("reflected", f);
    for (int i = 0; i < static_cast<int>(places_.size()); ++i) list_.function("emitted", session.emitted(i));
  }
  /// As lit at first, at another time, dimmed and with a probe that shines.
  void list_updates(RelightSession& session) {
    scene::LightingState state = session.lighting();
    const auto update = [&](const char* name) {
      list_.title(name);
      const RelightReport report = session.update(state);
      list_.line("report", report.hits_changed, report.pose_rays, report.direct_rays, report.solve.converged,
                 report.changed_probes.size());
      list_light(session);
    };
    update("first");
    state.time = 0.65f;
    update("moved");
    list_network(session.network());
    state.lights[0].intensity = 3, state.lights[0].world[3].x = -0.5f;
    state.group_scales = {vec3(1, 0.5f, 2), vec3(0.3f)};
    sh::RadianceSh leaving(1);
    leaving[0] = vec3(4, 5, 6), leaving[1] = vec3(1, 0, 2);
    state.emission = {{1, leaving}};
    update("changed");
  }

  const test::BallRoom room_{};
  const std::vector<scene::ProbePlace> places_ = {{"a", {-1.1f, 0.4f, 0.6f}, 0.2f},
                                                  {"b", {0.9f, -0.7f, 0.5f}, 0.15f},
                                                  {"c", {0.2f, 0.8f, -1.2f}, 0.1f},
                                                  {"d", {0.1f, -1.3f, -0.4f}, 0.1f},
                                                  {"e", {1.2f, 0.5f, -0.6f}, 0.1f}};
  Listing list_;

 private:
  static vec3 sums(std::span<const Link> links) {
    vec3 sum(0);
    for (const Link& link : links)
      sum += vec3(link.weight, link.weight * static_cast<float>(link.patch % 16),
                  static_cast<float>(link.patch % 7));
    return sum;
  }
};

TEST_F(SessionList, OfSurfelsPosedExactly) {
  RelightSession session(room_, places_, params(), 0.2f);
  list_network(session.network());
  list_updates(session);
  list_.title("of groups");
  SolveReport slowest;
  const auto reflected = session.reflected_by_group({}, &slowest), emitted = session.emitted_by_group();
  list_.line("slowest", slowest.converged);
  for (std::size_t g = 0; g < 2; ++g)
    for (std::size_t i = 0; i < places_.size(); ++i) {
      list_.function("reflected", reflected[g][i]);
      list_.function("emitted", emitted[g][i]);
    }
  list_.function("profile of the ball",
                 session.emission_profile(vec3(room_.part_pose(1, 0.65f)[3]), 0.6f, 1, 16));
  const std::vector<rays::SurfacePoint> points = surfel_points(session.network(), 2);
  list_.means("points", points, [](const rays::SurfacePoint& p) { return p.position; });
  list_.means("gathered", session.network().gather(points, 8),
              [](std::int32_t s) { return vec3(static_cast<float>(s)); });
  list_.expect("session-surfel");
}

TEST_F(SessionList, OfRecordsIsTheSameBeforeTheFirstUpdateAndAfterIt) {
  RelightSession before(room_, places_, params()), after(room_, places_, params());
  after.update(after.lighting());
  const GatherParams asked{.points = 0, .rays = 64, .baked = {}};
  for (RelightSession* session : {&before, &after})
    session->keep_records_at(surfel_points(session->network(), 2), asked);
  const probes::SurfaceRecords a = before.records_by_group(), b = after.records_by_group();
  EXPECT_FALSE(a.points.empty());
  EXPECT_EQ(a.groups, b.groups);
}

TEST_F(SessionList, OfRecordsThatWereTakenOverFollowTheBallAsBefore) {
  const std::vector<vec3> positions = {vec3(0)};
  TransportNetwork network(room_, positions, params().transport);
  const std::vector<rays::SurfacePoint> points = surfel_points(network);
  const std::size_t half = points.size() / 2;
  const std::vector<rays::SurfacePoint> first(points.begin(), points.begin() + static_cast<long>(half)),
      second(points.begin() + static_cast<long>(half), points.end());
  SurfaceGather alone(network, second, 64), joined(network, first, 64);
  joined.append(SurfaceGather(network, second, 64));
  std::vector<Irradiance4> lit(network.patch_count());
  for (std::size_t s = 0; s < lit.size(); ++s) lit[s] = Irradiance4(0.5f + static_cast<float>(s % 7));
  std::vector<probes::RecordLight> before, of_joined, of_alone;
  alone.light(lit, before);
  network.set_time(0.7f);
  alone.update_pose();
  joined.update_pose();
  alone.light(lit, of_alone);
  joined.light(lit, of_joined);
  ASSERT_EQ(of_joined.size(), points.size());
  EXPECT_TRUE(std::equal(of_alone.begin(), of_alone.end(), of_joined.begin() + static_cast<long>(half)));
  EXPECT_NE(before, of_alone) << "or nothing is tested";
}

TEST_F(SessionList, OfSurfelsBetweenPoses) {
  RelightParams blended = params();
  blended.poses = 3;
  blended.warm_start = false;
  RelightSession session(room_, places_, blended);
  list_updates(session);
  list_.title("nearer to the later pose");
  scene::LightingState state = session.lighting();
  state.time = 0.85f;
  session.update(state);
  list_network(session.network());
  list_.line("bytes of poses", session.network().pose_bytes());
  list_.expect("session-poses");
}

TEST_F(SessionList, OfBounce) {
  RelightParams bounce = params();
  bounce.op = probes::LightOperator::bounce;
  RelightSession session(room_, places_, bounce);
  list_updates(session);
  list_.expect("session-bounce");
}

TEST_F(SessionList, OfEdgesAndFittedWeights) {
  std::vector<vec3> positions;
  std::vector<probes::Probe> probes;
  for (const scene::ProbePlace& place : places_) {
    positions.push_back(place.position);
    probes.emplace_back().position = place.position;
    probes.back().radius = place.radius;
  }
  const TransportNetwork network(room_, positions, params().transport, 0.4f);
  for (const auto& [neighbors, threshold] : {std::pair(-1, 0.0005f), std::pair(2, 0.0f)}) {
    list_.title(fmt::format("{} neighbours over {}", neighbors, threshold));
    const auto edges =
        viz_from_links(network, room_, probes, 1, {.neighbors = neighbors, .threshold = threshold});
    for (const auto& of_probe : edges) {
      for (const probes::Edge& edge : of_probe) {
        list_.line("edge", edge.from, edge.transfer);
        list_.function("h", edge.h);
      }
    }
  }
  FitParams fit;
  fit.probes = 3, fit.training_lights = 4, fit.gather_rays = 24;
  const auto points = spread_points(surfel_points(network), 12);
  const probes::FittedPoints fitted = fit_weights(network, room_, points, fit);
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    list_.line("point", fitted.points[i].position, fitted.points[i].normal);
    for (int k = 0; k < fitted.weights[i].count; ++k) {
      const probes::ProbeWeight& w = fitted.weights[i].entries[k];
      list_.line("weight", w.probe, w.weight);
    }
  }
  list_.expect("edges-and-weights");
}

}  // namespace
}  // namespace ssphh::transport
