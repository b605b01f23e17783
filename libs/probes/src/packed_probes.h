#pragma once

#include <array>
#include <optional>

#include <ssphh/probes/lookup.h>
#include <ssphh/probes/lookup_constants.h>

namespace ssphh::probes {

/// Floats of a vector, and the next multiple of that.
inline constexpr std::size_t packed_lanes = 8;
constexpr std::size_t whole_lanes(std::size_t count) {
  return (count + packed_lanes - 1) / packed_lanes * packed_lanes;
}

/// What both lookups need of a set, laid out for one call per pixel sample.
class PackedProbes {
 public:
  /// `of_moving`: of each probe what more lights things that move, but for mirrors; or none.
  PackedProbes(const ProbeSet& set, const LookupParams& params,
               std::span<const sh::RadianceSh> of_moving = {});
  /// Takes the light of the same probes. Throws Error for others and as the constructor does, changes nothing
  /// then.
  void swap_light(const ProbeSet& set, std::span<const sh::RadianceSh> of_moving = {});

  int count() const { return static_cast<int>(positions_.size()); }

  const std::vector<vec3>& positions() const { return positions_; }
  const vec3& position(int probe) const { return positions_[probe]; }
  /// L(ω), not negative. `basis` holds Y_k(ω), perhaps scaled by band.
  vec3 radiance(int probe, const float* basis) const { return radiance_.dot(probe, basis); }
  /// E(n) of what moves or stands still, not negative.
  vec3 irradiance(int probe, const float* basis, bool moves = false) const {
    const vec3 e = irradiance_.dot(probe, basis);
    if (!more_of_moving_) return e;
    return e + (moves ? 1 : still_share_of_sky) * more_of_moving_->dot(probe, basis);
  }

  /// Y_k(n) for irradiance(), Y_k(ω) for radiance(), and the same for a glossy lobe; zeros after these.
  using Basis = std::array<float, whole_lanes(sh::max_coefficient_count)>;
  void irradiance_basis(const vec3& n, Basis& basis) const;
  void radiance_basis(const vec3& direction, Basis& basis) const;
  void glossy_basis(const vec3& direction, float roughness, Basis& basis) const;

 private:
  /// Functions of all probes, laid out so that one is evaluated by whole vectors.
  struct Functions {
    Functions(std::size_t probes, int degree);
    void set(std::size_t probe, std::span<const vec3> coefficients);
    vec3 dot(int probe, const float* basis) const;

    int degree;
    std::size_t stride;         ///< floats of a channel: coefficients, then zeros
    std::vector<float> values;  ///< probe after probe, in each channel after channel
  };

  void pack(std::span<const sh::RadianceSh> of_moving);

  LookupParams params_;
  std::vector<sh::RadianceSh> light_;  ///< scratch
  std::vector<vec3> positions_;
  Functions radiance_, irradiance_;
  std::optional<Functions> more_of_moving_;      ///< irradiance
  std::vector<sh::RadianceSh> light_of_moving_;  ///< scratch
};

}  // namespace ssphh::probes
