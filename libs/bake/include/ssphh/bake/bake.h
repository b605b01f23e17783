#pragma once
/// GEN and VIZ of a whole set, one probe after the other, with progress, cancellation and resume.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include <ssphh/bake/viz.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::bake {

struct BakeParams {
  probes::GenMode gen = probes::GenMode::full;  ///< local overrides path.max_depth with 1
  rays::PathParams path;                        ///< of GEN; its seed is also VIZ's
  int face_size = 64;                           ///< texels along a cube face
  bool keep_light = false;                      ///< no GEN: VIZ alone, beside the light that the set holds
  bool viz = true;                              ///< false: the set's edges stay as they are
  VizParams viz_params;
  std::optional<rays::PathParams>
      viz_path;  ///< of VIZ, but for the seed; none: as `path`, whatever `gen` says
  /// GEN and VIZ of these probes alone, ascending; the others keep what the set holds. None: of all.
  std::optional<std::vector<std::uint32_t>> only;
  /// GEN of these light groups alone, ascending; with `only` the others keep what the set holds. None: of
  /// all.
  std::optional<std::vector<std::uint32_t>> only_groups;
};

/// Told of each probe when its GEN or VIZ is done, from one thread at a time: `groups` or `edges` are new,
/// what merge_groups derives is not. Changes no result.
using ProbeDone = std::function<void(std::size_t, const probes::Probe&)>;

/// What a bake took: not part of the set, which must not depend on timing.
struct BakeReport {
  double gen_seconds = 0, viz_seconds = 0;  ///< those of a resumed run's earlier parts included
  std::uint64_t rays = 0;
  std::size_t resumed = 0;  ///< probe stages taken from the checkpoint
  std::vector<std::string> warnings;
};

/// GEN or VIZ of one probe: the unit of a bake.
enum class BakeStage : std::uint8_t { gen, viz };
constexpr auto enum_table(BakeStage) {
  using enum BakeStage;
  return std::to_array<EnumName<BakeStage>>({{gen, "gen"}, {viz, "viz"}});
}

struct ProbeStage {
  BakeStage stage = BakeStage::gen;
  std::uint32_t probe = 0;

  friend bool operator==(const ProbeStage&, const ProbeStage&) = default;
};

struct ProbeStageResult {
  ProbeStage done;
  double seconds = 0;
  std::uint64_t rays = 0;
  std::vector<probes::GroupLight> groups;  ///< of GEN
  std::vector<probes::Edge> edges;         ///< of VIZ
};

/// Sampling effort and seed that the set's generator states for a stage.
rays::PathParams path_of(const probes::GeneratorInfo& generator, BakeStage stage);
/// States them; the seed is one for both.
void set_path(probes::GeneratorInfo& generator, BakeStage stage, const rays::PathParams& path);

/// One unit: a pure function of the scene, the set's generator (path parameters, face size, seed), degree and
/// places, but for the seconds. GEN looks at that probe's place alone, VIZ at all.
ProbeStageResult bake_stage(const rays::RadianceSource& source, const probes::ProbeSet& set,
                            const VizParams& viz_params, const ProbeStage& stage,
                            const Control& control = {});

/// Does the units of a bake somewhere else than in this process.
class BakeCrew {
 public:
  virtual ~BakeCrew() = default;
  /// Does all of `stages`, in any order, and hands each result to `done`, from one thread at a time. Throws
  /// Cancelled, or Error when a unit cannot be done. What answers no stage is refused with an Error.
  virtual void run(const probes::ProbeSet& set, const BakeParams& params, std::span<const ProbeStage> stages,
                   const std::function<void(ProbeStageResult)>& done, const Control& control) = 0;
};

/// Fills the set that INIT made: GEN per light group, then VIZ. Warns about probes without light or inside a
/// body, and about P over 1. With a `checkpoint` path every finished probe is appended to that file, so that
/// the same call after a Cancelled or a killed process continues there and gives the same bits; the caller
/// removes it once the set is safe on disk. A checkpoint of another scene or other parameters is replaced.
/// Throws Error for parameters out of range, an empty set, and light that is to be kept but is of other
/// groups.
/// With a `crew` it traces; the result is the same, bit by bit.
probes::ProbeSet bake(const rays::RadianceSource& source, probes::ProbeSet set, const BakeParams& params,
                      const std::filesystem::path& checkpoint, BakeReport& report,
                      const Control& control = {}, BakeCrew* crew = nullptr, const ProbeDone& on_probe = {});

}  // namespace ssphh::bake
