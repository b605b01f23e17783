#pragma once
/// Lighting surface points from probes: the paper's `light` and the field's `irradiance`, as
/// rays::IndirectLight for a renderer that computes direct light itself. libs/methods/ssphh/README.md says
/// what each is worth.

#include <memory>
#include <optional>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/held.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::probes {

/// Which part of S'_i lights the surface.
enum class ProbeLayer { self, neighbor, sum };
constexpr auto enum_table(ProbeLayer) {
  using enum ProbeLayer;
  return std::to_array<EnumName<ProbeLayer>>({{self, "self"}, {neighbor, "neighbor"}, {sum, "sum"}});
}

/// Which light of the probes' own part counts: only what surfaces reflected, for a surface that gets direct
/// light from elsewhere; or emitters seen directly as well.
enum class ProbeLight { reflected, all };

/// Bands over it change next to nothing of irradiance: lookups keep no more, on the CPU as on a GPU.
inline constexpr int max_irradiance_degree = 4;

struct LookupParams {
  std::optional<ProbeLayer> layer;  ///< none: sum when the set has a hierarchy, else self
  ProbeLight light = ProbeLight::reflected;
  WeightParams weights;                           ///< irradiance: how probes are blended
  int irradiance_degree = max_irradiance_degree;  ///< irradiance: bands kept; 2 is 1 % worse at worst
  bool dering = true;  ///< irradiance: windows a probe just enough that its E(n) is nowhere negative
};

/// Bands of irradiance that lookups keep of a set of this degree: 0 to max_irradiance_degree.
int irradiance_degree(const LookupParams& params, int set_degree);

/// What of each probe lights surfaces, as `params` choose. Throws Error for an empty set, for layer
/// `neighbor` or `sum` without a hierarchy, for groups that were not merged, and for places and functions
/// that are not finite or not of the set's degree.
std::vector<sh::RadianceSh> surface_light(const ProbeSet& set, const LookupParams& params);
/// Finds it in the memory that `light` has.
void surface_light(const ProbeSet& set, const LookupParams& params, std::vector<sh::RadianceSh>& light);

/// Both are safe to call from several threads, never return a negative or non-finite number for finite input,
/// and copy what they need of the set; `source` (for visibility) must outlive them. Constructors throw Error
/// as surface_light does. Copies share what light does not change: places, weights, what is visible.
///
/// swap_light() makes a lookup that of a set whose light has changed, with the bits that the constructor
/// gives, in a fraction of its time and without allocation (modes of light groups that change apart): the set
/// has the same probes in the same order, of the same degree, and the same records or none, as the one that
/// the lookup was made of. Throws Error for other sets and as the constructor does, and leaves the lookup as
/// it was. Not while another thread looks up in this one: core/snapshots.h holds several.

/// The paper's SPHL as a light (§3): from the nearest visible SPHL above the horizon the radiance L_S(ω)
/// arrives, ω from x to it, as I = L_S(ω)/(N·ω), so that the cosine of the rendering equation cancels and ρ L
/// leaves the surface at every angle: irradiance π L. When there is none, the nearest SPHL's irradiance, "as
/// if the light probe is located around x" (§4).
class LightLookup final : public rays::IndirectLight {
 public:
  LightLookup(const ProbeSet& set, const rays::RadianceSource& source, const LookupParams& params = {});
  LightLookup(const ProbeSet&, const rays::RadianceSource&&, const LookupParams& = {}) = delete;
  ~LightLookup() override;
  LightLookup(LightLookup&&) noexcept;
  LightLookup& operator=(LightLookup&&) noexcept;
  LightLookup(const LightLookup&);
  void swap_light(const ProbeSet& set);
  vec3 irradiance(const rays::SurfacePoint& at) const override;
  std::vector<std::string> direct_groups() const override;
  bool follows_mirrors() const override { return false; }
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override;

 private:
  struct Data;
  Held<Data> data_;
};

/// Whether surfaces that stand still are lit by the set's records: where these are, and hold the light that
/// `params` ask for, every bounce without HIER's.
bool has_records(const ProbeSet& set, const LookupParams& params);
/// What a lookup of the set takes for surfaces that stand still.
WeightMethod chosen_weights(const ProbeSet& set, const LookupParams& params);

/// Irradiance volume: Σ_j v_j E_j(n), the weights by params.weights (and the set's fitted points) or as
/// given, which may name no other probes than the set's. Where the set has records that lie near, they give
/// E instead; glossy light is always the probes'. Throws Error for weights `surface` without records of the
/// light asked for.
class IrradianceLookup final : public rays::IndirectLight {
 public:
  IrradianceLookup(const ProbeSet& set, const rays::RadianceSource& source, const LookupParams& params = {});
  IrradianceLookup(const ProbeSet&, const rays::RadianceSource&&, const LookupParams& = {}) = delete;
  /// `places` are the points of the set's records, in their order; none: the records are not looked up.
  IrradianceLookup(const ProbeSet& set, std::shared_ptr<const LookupWeights> weights,
                   const LookupParams& params = {},
                   std::shared_ptr<const SurfaceInterpolation> places = nullptr);
  ~IrradianceLookup() override;
  IrradianceLookup(IrradianceLookup&&) noexcept;
  IrradianceLookup& operator=(IrradianceLookup&&) noexcept;
  IrradianceLookup(const IrradianceLookup&);
  void swap_light(const ProbeSet& set);
  vec3 irradiance(const rays::SurfacePoint& at) const override;
  /// Of the records; nothing where none lies near in sight, or the point moves.
  std::optional<vec3> recorded_irradiance(const rays::SurfacePoint& at) const;
  /// Of the probes alone, by these weights in place of its own. Throws Error for one that names another
  /// probe.
  vec3 irradiance(const rays::SurfacePoint& at, const ProbeWeights& weights) const;
  std::vector<std::string> direct_groups() const override;
  std::vector<std::string> mirrored_groups() const override;
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override;

 private:
  struct Data;
  Held<Data> data_;
};

enum class LookupMethod { light, irradiance };
constexpr auto enum_table(LookupMethod) {
  using enum LookupMethod;
  return std::to_array<EnumName<LookupMethod>>({{light, "light"}, {irradiance, "irradiance"}});
}

/// A lookup as people choose it, for any set: what a render, a job or a picture of the viewer asks for.
struct LookupSpec {
  LookupMethod method = LookupMethod::irradiance;
  std::optional<WeightMethod> weights = {};  ///< of `irradiance`; none: as WeightParams::method
  ProbeLayer layer = ProbeLayer::sum;  ///< of a set that has a hierarchy; of others the probes' own light

  friend bool operator==(const LookupSpec&, const LookupSpec&) = default;
};

/// What the choice means for `set`.
LookupParams lookup_params(const LookupSpec& spec, const ProbeSet& set);

/// Throws Error as the lookup's constructor does.
std::unique_ptr<rays::IndirectLight> make_lookup(const LookupSpec& spec, const ProbeSet& set,
                                                 const rays::RadianceSource& source);

std::unique_ptr<rays::IndirectLight> make_lookup(LookupMethod method, const ProbeSet& set,
                                                 const rays::RadianceSource& source,
                                                 const LookupParams& params = {});

}  // namespace ssphh::probes
