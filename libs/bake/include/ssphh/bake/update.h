#pragma once
/// Updates: after a change of the scene only the probes whose light has changed are baked anew. Which these
/// are is found by trials: few paths from each probe, of the same random numbers before and after, so that
/// paths that meet no change give the same light to the bit (docs/methods/update.md).

#include <optional>
#include <span>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/light_scope.h>
#include <ssphh/probes/baseline.h>

namespace ssphh::bake {

/// Light of one probe by about a thirty-second of its bake's paths, half of them in each half. A pure
/// function of the scene, the set's generator and the probe's place and index.
probes::Trial trial(const rays::RadianceSource& source, const probes::ProbeSet& set, std::size_t probe,
                    const Control& control = {});

/// Noise of the light that the set's bake finds, relative to it: half the difference of the trial's two
/// halves, as far as the bake's more paths reduce it. 0 in darkness.
float bake_noise(const probes::Trial& trial, const probes::GeneratorInfo& generator);

/// How much of a probe's light has changed, relative to the brighter of the two, with the norm over light
/// groups, bands and channels. The square of the change is estimated without bias, as the product of what the
/// halves say, which do not share their noise; where that is negative the change is 0. 0 where both are dark.
float changed_share(const probes::Trial& before, const probes::Trial& now);

/// Trials of all probes of a set that bake() has filled: those of its baseline.
std::vector<probes::Trial> make_trials(const rays::RadianceSource& source, const probes::ProbeSet& set,
                                       const Control& control = {});

/// What an update has to do.
struct UpdatePlan {
  /// To be baked, ascending: whose light has changed by more than the tolerance, or that the scope names.
  std::vector<std::uint32_t> probes;
  std::vector<float> changed;         ///< of every probe: changed_share(); 0 where nothing was compared
  std::vector<probes::Trial> trials;  ///< of every probe, as it is now
  float noise = 0;                    ///< bake_noise() of the median probe
  float tolerance = 0;                ///< share of its light by which a kept probe may have changed
  double seconds = 0;
};

/// Least share of light that counts as a change where none is given: nobody sees one per cent.
inline constexpr float usual_tolerance = 0.01f;

/// Compares the scene with the set's baseline. `tolerance`: none stands for usual_tolerance or the bake's own
/// noise, whichever is more; 0: a trial that differs by any bit counts. Throws Error for a set without
/// baseline or of other light groups than the source's, and for a tolerance below 0.
/// A scope that names probes has these baked, however much they have changed, and compares no others; one
/// that names light groups compares the light of these alone.
UpdatePlan plan_update(const rays::RadianceSource& source, const probes::ProbeSet& set,
                       std::optional<float> tolerance, const LightScope& scope = {},
                       const Control& control = {});

/// Gives a set the light groups of a changed scene: those of a name stay as they are, new ones are dark, and
/// what is gone is left out; of its records and its baseline, too. Drops the hierarchy where the groups
/// change.
void adopt_groups(probes::ProbeSet& set, std::span<const std::string> groups);

/// Takes the trials of `plan.probes` into the set's baseline. Those of the others stay as they were when
/// their light was baked, so that small changes add up until they count.
void renew_trials(probes::ProbeSet& set, const UpdatePlan& plan);

}  // namespace ssphh::bake
