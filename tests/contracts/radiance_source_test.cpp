/// Contracts with implementations of rays::RadianceSource and bake::BakeCrew.

#include <ssphh/bake/bake.h>
#include <ssphh/bake/gen.h>
#include <ssphh/bake/viz.h>
#include <ssphh/study/leak.h>

#include "contract.h"
#include "probe_sets.h"

namespace ssphh::test {
namespace {

/// Answers in empty space, with one thing wrong.
class UnrulyRadiance final : public rays::RadianceSource {
 public:
  enum class Fault { none, groups, face_size, channels, not_finite, spheres, emitter, chunk, estimates };
  explicit UnrulyRadiance(Fault fault) : fault_(fault) {}

  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::vector<rays::GroupRadiance> incident_radiance(const rays::CubeRequest& request,
                                                     const Control&) const override {
    rays::GroupRadiance radiance{image::CubeMap(request.face_size), image::CubeMap(request.face_size)};
    if (fault_ == Fault::face_size) radiance.emitted = image::CubeMap(request.face_size + 1);
    if (fault_ == Fault::channels)
      radiance.emitted.faces[2] = image::Image(request.face_size, request.face_size, 4);
    if (fault_ == Fault::not_finite) radiance.reflected.faces[4].pixels[0] = nan;
    return std::vector<rays::GroupRadiance>(fault_ == Fault::groups ? 3 : 1, radiance);
  }
  std::vector<image::CubeMap> ghost_radiance(const rays::CubeRequest& request,
                                             std::span<const rays::GhostSphere> ghosts, const GhostSink& sink,
                                             const Control&) const override {
    const std::size_t count = fault_ == Fault::spheres ? 0 : ghosts.size();
    if (sink && fault_ == Fault::emitter) sink(0, {99, vec3(0, 1, 0), vec3(0, 1, 0), vec3(1)});
    if (sink && fault_ == Fault::chunk) sink(ghost_chunk_count, {0, vec3(0, 1, 0), vec3(0, 1, 0), vec3(1)});
    image::CubeMap map(request.face_size);
    if (fault_ == Fault::not_finite) map.faces[0].pixels[0] = infinity;
    return std::vector<image::CubeMap>(count, map);
  }
  std::vector<rays::IrradianceEstimate> surface_irradiance(std::span<const rays::SurfacePoint> points,
                                                           const rays::PathParams&,
                                                           const Control&) const override {
    return std::vector<rays::IrradianceEstimate>(fault_ == Fault::estimates ? 0 : points.size());
  }
  bool visible(const vec3&, const vec3&) const override { return true; }
  std::uint64_t rays_traced() const override { return 0; }

 private:
  Fault fault_;
  std::vector<std::string> groups_{"lamp"};
};

using Fault = UnrulyRadiance::Fault;

void gen(Fault fault, int degree = 2) {
  bake::gen(UnrulyRadiance(fault), {vec3(0), 4, {}}, degree);
}
void viz(Fault fault, std::size_t probe = 0, bool matrix = true) {
  bake::viz(UnrulyRadiance(fault), sound_set(), probe, {vec3(0), 4, {}}, {.matrix = matrix});
}

bake::BakeParams without_viz() {
  bake::BakeParams params;
  params.face_size = 4;
  params.viz = false;
  return params;
}

std::vector<Contract> of_sources_of_radiance() {
  return {
      refuses("Gen", "FromASourceOfOtherGroups", [] { gen(Fault::groups); }, {"radiance source", "groups"}),
      refuses("Gen", "FromASourceOfOtherFaces", [] { gen(Fault::face_size); }, {"size"}),
      refuses("Gen", "FromASourceOfUnevenFaces", [] { gen(Fault::channels); }, {"channels"}),
      refuses("Gen", "FromASourceWithoutNumbers", [] { gen(Fault::not_finite); }, {"lamp", "not finite"}),
      refuses("Gen", "OfDegreeEleven", [] { gen(Fault::none, 11); }, {"0..10"}),
      refuses("Viz", "FromASourceOfOtherSpheres", [] { viz(Fault::spheres); }, {"radiance source", "sphere"}),
      refuses("Viz", "FromASourceWhosePathComesFromNoSphere", [] { viz(Fault::emitter); },
              {"radiance source"}),
      refuses("Viz", "FromASourceWhosePathIsOfNoChunk", [] { viz(Fault::chunk); }, {"radiance source"}),
      refuses("Viz", "FromASourceWithoutNumbers", [] { viz(Fault::not_finite); }, {"not finite"}),
      refuses("Viz", "OfNoProbe", [] { viz(Fault::none, 3); }, {"VIZ", "no probe"}),
      refuses("BakeStage", "OfNoProbe",
              [] {
                bake::bake_stage(UnrulyRadiance(Fault::none), sound_set(), {}, {bake::BakeStage::gen, 3});
              },
              {"bake", "no probe"}),
      refuses("Bake", "OfAnEmptySet",
              [] {
                bake::BakeReport report;
                bake::bake(UnrulyRadiance(Fault::none), {}, {}, {}, report);
              },
              {"no probes"}),
      refuses("Bake", "ByACrewThatDoesAnotherProbe",
              [] {
                struct Stray : bake::BakeCrew {
                  void run(const probes::ProbeSet&, const bake::BakeParams&,
                           std::span<const bake::ProbeStage>,
                           const std::function<void(bake::ProbeStageResult)>& done, const Control&) override {
                    done({{bake::BakeStage::gen, 99}, 0, 0, {{{}, sh::RadianceSh(2)}}, {}});
                  }
                } crew;
                bake::BakeReport report;
                bake::bake(UnrulyRadiance(Fault::none), sound_set(), without_viz(), {}, report, {}, &crew);
              },
              {"crew", "probe"}),
      refuses("Bake", "ByACrewThatLeavesProbesOut",
              [] {
                struct Idle : bake::BakeCrew {
                  void run(const probes::ProbeSet&, const bake::BakeParams&,
                           std::span<const bake::ProbeStage>,
                           const std::function<void(bake::ProbeStageResult)>&, const Control&) override {}
                } crew;
                bake::BakeReport report;
                bake::bake(UnrulyRadiance(Fault::none), sound_set(), without_viz(), {}, report, {}, &crew);
              },
              {"crew"}),
      refuses("Bake", "ByACrewWhoseLightIsOfAnotherDegree",
              [] {
                struct Coarse : bake::BakeCrew {
                  void run(const probes::ProbeSet&, const bake::BakeParams&,
                           std::span<const bake::ProbeStage> stages,
                           const std::function<void(bake::ProbeStageResult)>& done, const Control&) override {
                    for (const bake::ProbeStage& stage : stages)
                      done({stage, 0, 0, {{{}, sh::RadianceSh(4)}}, {}});
                  }
                } crew;
                bake::BakeReport report;
                bake::bake(UnrulyRadiance(Fault::none), sound_set(), without_viz(), {}, report, {}, &crew);
              },
              {"crew", "degree"}),
      refuses(
          "TraceTruth", "FromASourceThatLeavesPointsOut",
          [] { study::trace_truth(UnrulyRadiance(Fault::estimates), std::vector<rays::SurfacePoint>(2)); },
          {"radiance source", "each point"}),
      refuses("TraceTruth", "WithoutPoints", [] { study::trace_truth(UnrulyRadiance(Fault::none), {}); },
              {"no points"}),
      refuses("LeakRatio", "OfOtherNumbers", [] { study::leak_ratio(std::vector<vec3>(2), {}); },
              {"each point"}),
  };
}

SSPHH_CONTRACTS(RadianceSource, of_sources_of_radiance());

}  // namespace
}  // namespace ssphh::test
