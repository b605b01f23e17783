/// The figures that methods tell of themselves, counted again from outside.

#include <map>

#include <gtest/gtest.h>

#include <ssphh/transport/fitted_weights.h>

#include "method_fixtures.h"
#include "transport_fixtures.h"

namespace ssphh {
namespace {

using test::MadeMethod;
using Numbers = std::map<std::string, double>;

const scene::Scene& room() {
  static const scene::Scene scene = test::coloured_room(vec3(1));
  return scene;
}

/// After one frame. Keeps a reference to the scene.
struct Framed : MadeMethod {
  Framed(const std::string& name, const std::vector<std::string>& settings,
         const scene::Scene& scene = room())
      : MadeMethod(name, settings, scene) {
    frame();
  }
  Framed(const std::string&, const std::vector<std::string>&, const scene::Scene&&) = delete;
  void frame(float time = 0) { method->update(rays::lighting_at(source, time), {}); }
  Numbers numbers() const {
    const methods::MethodNumbers list = method->numbers();
    Numbers found(list.begin(), list.end());
    EXPECT_EQ(found.size(), list.size()) << "names are unique";
    return found;
  }
};

/// What a network takes, of its plain data.
struct Network {
  transport::TransportNetwork network;
  explicit Network(const trace::TransportScene& source)
      : network(source, scene::positions_of(test::places_of(room())), params()) {}
  static transport::TransportParams params() {
    transport::TransportParams p;
    p.directions = 64, p.surfel_size = 0.5f;
    return p;
  }
  double surfels() const { return static_cast<double>(network.surfel_count()); }
  std::size_t bytes() const {
    const std::size_t rays = 4u * 64;
    // Links; what rays see, how far, and as packed; eight patches a surfel; and the surfels with their light.
    return network.links().link_count() * 8 + rays * (8 + 4 + 16) +
           network.surfel_count() * 8 * (28 + 1 + 12 + 3 * 16) +
           network.surfel_count() * (sizeof(transport::Surfel) + 2 * 16);
  }
};

const std::vector<std::string> own_places{"places=scene", "directions=64", "surfel_size=0.5"};

std::vector<std::string> with(std::vector<std::string> settings, const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

TEST(MethodNumbers, OfSsphhAreItsProbesSurfelsAndFittedPoints) {
  const Network network{trace::TransportScene(room())};
  const Framed mls("ssphh", with(own_places, {"weights=mls", "degree=3"}));
  EXPECT_EQ(mls.numbers(),
            (Numbers{{"probes", 4}, {"surfels", network.surfels()}, {"fitted_points", 0}, {"records", 0}}));
  // Weights by place; 16 coefficients of radiance and as many of irradiance.
  EXPECT_EQ(mls.method->memory().lookup, 4u * (12 + 17) + 4 * 12 * (16 + 16));
  EXPECT_EQ(mls.method->memory().update, network.bytes());
  EXPECT_EQ(Framed("ssphh", with(own_places, {"weights=mls", "degree=6"})).method->memory().lookup,
            4u * (12 + 17) + 4 * 12 * (49 + 25))
      << "irradiance ends at band 4";
  EXPECT_EQ(Framed("ssphh", with(own_places, {"weights=fitted"})).numbers()["fitted_points"],
            network.surfels())
      << "one each";
  const double few =
      Framed("ssphh", with(own_places, {"weights=fitted", "fit_points=20"})).numbers()["fitted_points"];
  EXPECT_LE(few, 20);
  EXPECT_GT(few, 5);
  const Framed surface("ssphh", with(own_places, {"weights=surface", "records=60", "degree=3"}));
  const double records = surface.numbers()["records"];
  EXPECT_LE(records, 120) << "as many again, where nothing is seen";
  EXPECT_GT(records, 15);
  // Each a place, spacing, normal and class of cover, an item of the tree, and 12 floats of light; a box of
  // the tree for four
  EXPECT_EQ(double(surface.method->memory().lookup) - double(mls.method->memory().lookup),
            records * (24 + 20 + 48) + 24 * (std::floor(records / 4) + 1));
  EXPECT_GT(surface.method->memory().update, network.bytes());
  EXPECT_EQ(Framed("ssphh", {"probes=7", "directions=64", "surfel_size=0.5"}).numbers()["probes"], 7);
}

TEST(MethodNumbers, OfProbeVolumesAreTheirProbesTetrahedraAndSurfels) {
  const Network network{trace::TransportScene(room())};
  const Framed own("irradiance-volume", with(own_places, {"degree=2"}));
  EXPECT_EQ(own.numbers(), (Numbers{{"probes", 4}, {"tetrahedra", 1}, {"surfels", network.surfels()}}));
  EXPECT_EQ(own.method->memory().update, network.bytes());
  const Framed six("irradiance-volume", with(own_places, {"degree=6"}));
  EXPECT_EQ(six.method->memory().lookup - own.method->memory().lookup, 4u * (49 - 9) * 12);
  const Framed grid("irradiance-volume", {"places=grid", "probes=27", "interpolation=trilinear",
                                          "directions=64", "surfel_size=0.5", "degree=2"});
  const double along = std::cbrt(grid.numbers()["probes"]);
  EXPECT_TRUE(along == 3 || along == 4) << along << ": as the grid is shifted";
  EXPECT_EQ(grid.numbers()["tetrahedra"], 0);
  // An index for each place and cell; of each probe radiance, and irradiance of as many bands.
  EXPECT_EQ(static_cast<double>(grid.method->memory().lookup),
            4 * (std::pow(along, 3) + std::pow(along - 1, 3)) + std::pow(along, 3) * (9 + 9) * 12);
}

TEST(MethodNumbers, OfTransferAreItsMesh) {
  const Framed prt("prt", with(own_places, {"rays=16", "degree=2", "edge=0.7"}));
  const Numbers numbers = prt.numbers();
  // Each wall of 2 m by 2 m: two triangles whose edges are halved until they are no longer than 0.7 m.
  EXPECT_EQ(numbers.at("probes"), 4);
  EXPECT_GE(numbers.at("triangles"), 6 * 2 * 16);
  EXPECT_LE(numbers.at("triangles"), 6 * 2 * 64);
  EXPECT_GT(numbers.at("vertices"), numbers.at("triangles") / 2);
  EXPECT_LE(numbers.at("vertices"), numbers.at("triangles"));
  EXPECT_GT(prt.method->memory().lookup, prt.numbers()["triangles"] * 12 + prt.numbers()["vertices"] * 12);
  EXPECT_GT(prt.method->memory().update, numbers.at("vertices") * 9 * (4 + 12))
      << "direct and reflected vectors";
}

TEST(MethodNumbers, OfVirtualLightsAreTheirPhotonsAndWhatWasMeasured) {
  const Framed vpl("vpl", {"photons=64", "check_points=16", "clamp=0"});
  const auto lights = std::get<methods::VirtualLights>(vpl.method->light_data());
  const auto count = static_cast<double>(lights.lights.size());
  EXPECT_EQ(vpl.numbers(),
            (Numbers{{"photons", 64}, {"vpls", count}, {"lost_energy", 0}, {"lights_per_point", count}}));
  EXPECT_EQ(vpl.method->memory().lookup, lights.lights.size() * sizeof(methods::vpl::Vpl));
  EXPECT_EQ(lights.params.kind, methods::vpl::VplKind::point);
  EXPECT_EQ(lights.params.least_distance, 0);
  const Framed unmeasured("vpl", {"photons=64", "check_points=0", "kind=sphere", "clamp=0.1", "depth=2"});
  EXPECT_EQ(unmeasured.numbers(), (Numbers{{"photons", 64}, {"vpls", 64}}));
  const auto spheres = std::get<methods::VirtualLights>(unmeasured.method->light_data());
  EXPECT_EQ(spheres.params.kind, methods::vpl::VplKind::sphere);
  EXPECT_FLOAT_EQ(spheres.params.least_distance, 0.1f * std::sqrt(3.0f)) << "of the room's radius";
  EXPECT_GT(spheres.lights[0].radius, 0);
  EXPECT_GT(Framed("vpl", {"photons=64", "check_points=16", "clamp=0.5"}).numbers()["lost_energy"], 0.01);
  EXPECT_LT(
      Framed("vpl", {"photons=64", "check_points=16", "cluster_error=0.2"}).numbers()["lights_per_point"],
      count);
}

TEST(MethodNumbers, OfVoxelsAreTheirGridAndWhatIsRelit) {
  const scene::Scene rooms = scene::make_builtin("two-rooms");
  Framed vct("vct", {"resolution=32", "bounces=1", "samples=2"}, rooms);
  const Numbers first = vct.numbers();
  EXPECT_EQ(first.at("levels"), 4) << "32, 16, 8 and 4 voxels";
  const auto cones = std::get<methods::VoxelCones>(vct.method->light_data());
  EXPECT_EQ(cones.cones.cones, 16);
  EXPECT_EQ(first.at("bricks"), static_cast<double>(cones.voxels->bricks(0)));
  EXPECT_EQ(first.at("voxel_size"), static_cast<double>(cones.voxels->grid().voxel));
  EXPECT_EQ(vct.method->memory().lookup, cones.voxels->bytes());
  EXPECT_LE(first.at("voxels"), first.at("bricks") * 64);
  EXPECT_GE(first.at("patches"), first.at("voxels"));
  EXPECT_LT(first.at("gather_points"), first.at("patches"));
  EXPECT_GE(first.at("points_relit"), first.at("patches")) << "at first all, one to two each and group";
  EXPECT_LE(first.at("points_relit"),
            2 * first.at("patches") * static_cast<double>(vct.source.light_groups().size()));
  vct.frame(0.5f);
  EXPECT_GT(vct.numbers()["points_relit"], 0);
  EXPECT_LT(vct.numbers()["points_relit"], first.at("points_relit")) << "what the door may shadow";
}

TEST(MethodNumbers, OfDdgiAreItsProbesRaysAndFrames) {
  Framed ddgi("ddgi", {"probes=27", "rays=16", "warmup=3"});
  Numbers numbers = ddgi.numbers();
  EXPECT_EQ(numbers.at("probes"), 27);
  EXPECT_EQ(numbers.at("active"), 27);
  EXPECT_NEAR(numbers.at("spacing"), 2.0 / 3, 0.02)
      << "2 m in three, of which points were found nearly to the rim";
  EXPECT_EQ(numbers.at("rays_per_frame"), 27 * 16);
  EXPECT_EQ(numbers.at("frames"), 3);
  // Maps as in libs/methods/ddgi/README.md; a ray is a radiance and a distance.
  EXPECT_EQ(ddgi.method->memory().lookup, 27u * (12 + 1 + 64 * 12 + 256 * 8));
  EXPECT_EQ(ddgi.method->memory().update, 27u * (16 * 16 + 1));
  ddgi.frame();
  EXPECT_EQ(ddgi.numbers()["frames"], 4) << "one frame each from then on";
}

TEST(MethodNumbers, OfDdgiHoldTheRaysThatFollowADoor) {
  const scene::Scene rooms = scene::make_builtin("two-rooms");
  Framed ddgi("ddgi", {"probes=27", "rays=16", "warmup=1"}, rooms);
  const Numbers still = ddgi.numbers();
  EXPECT_EQ(still.at("rays_per_frame"), 16 * still.at("active")) << "where all begin is not of a frame";
  ddgi.frame(0.5f);
  const Numbers moved = ddgi.numbers();
  // 32 rays look around each probe, once before and once after each of two steps.
  EXPECT_EQ(moved.at("rays_per_frame"), 16 * moved.at("active") + 3 * 32 * moved.at("probes"));
  ddgi.frame(0.5f);
  EXPECT_EQ(ddgi.numbers()["rays_per_frame"], 16 * moved.at("active"));
}

TEST(MethodNumbers, OfTheAmbientTermAreItsColour) {
  const Framed once("ambient", {"points=256"}), twice("ambient", {"points=256", "factor=2"});
  const rays::SurfacePoint anywhere{vec3(0.5f), {0, 0, 1}};
  const vec3 light = once.method->light().irradiance(anywhere);
  EXPECT_EQ(once.numbers(), (Numbers{{"red", static_cast<double>(light.r)},
                                     {"green", static_cast<double>(light.g)},
                                     {"blue", static_cast<double>(light.b)}}));
  EXPECT_EQ(once.method->light().glossy(anywhere, {0, 1, 0}, 0.5f), light / pi);
  EXPECT_EQ(twice.method->light().irradiance(anywhere), 2.0f * light);
  EXPECT_EQ(once.method->memory().lookup, 12u);
  EXPECT_EQ(once.method->memory().update, 0u);
  const Framed none("direct", {});
  EXPECT_EQ(none.method->light().irradiance(anywhere), vec3(0));
  EXPECT_EQ(none.method->light().glossy(anywhere, {0, 1, 0}, 0.5f), vec3(0));
  EXPECT_EQ(none.method->memory().lookup + none.method->memory().update, 0u);
  EXPECT_TRUE(none.numbers().empty());
}

}  // namespace
}  // namespace ssphh
