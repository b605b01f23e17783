#pragma once
/// Bakes on a farm: GEN and VIZ, the crew of bake::bake, and tiles of transport.

#include <ssphh/bake/bake.h>
#include <ssphh/bake/tiled_transport.h>
#include <ssphh/farm/dispatch.h>
#include <ssphh/scene/scene.h>

namespace ssphh::farm {

/// Hands out the scene and has probes, or tiles of them, done by workers, each once, in any order. Those
/// whose result is in options.results are taken from there, whatever bake they come from.
class FarmCrew final : public bake::BakeCrew, public bake::TileCrew {
 public:
  /// Keeps references to both; the scene is `scene` posed at `time`.
  FarmCrew(const FarmOptions& options, const scene::Scene& scene, float time)
      : options_(options), scene_(scene), time_(time) {}

  FarmCrew(const FarmOptions&, const scene::Scene&&, float) = delete;  // they would be gone
  FarmCrew(const FarmOptions&&, const scene::Scene&, float) = delete;
  FarmCrew(const FarmOptions&&, const scene::Scene&&, float) = delete;

  void run(const probes::ProbeSet& set, const bake::BakeParams& params,
           std::span<const bake::ProbeStage> stages, const std::function<void(bake::ProbeStageResult)>& done,
           const Control& control) override;

  void run_tiles(const probes::ProbeSet& set, std::span<const probes::Tile> tiles,
                 std::span<const std::size_t> which, const bake::TiledParams& params,
                 const std::function<void(std::size_t, probes::ProbeSet, bake::TransportBakeReport)>& done,
                 const Control& control) override;

  const FarmReport& report() const { return report_; }

 private:
  const FarmOptions& options_;
  const scene::Scene& scene_;
  float time_;
  FarmReport report_;
};

}  // namespace ssphh::farm
