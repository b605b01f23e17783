#pragma once
/// Indirect irradiance by iteration: E = F (ρ ∘ (E_direct + E)) over sparse links
/// (docs/methods/transport.md).

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <ssphh/core/contraction.h>
#include <ssphh/core/math.h>
#include <ssphh/transport/transport_params.h>

namespace ssphh::transport {

/// Share `weight` of what a surfel's cosine rays meet is patch `patch`.
struct Link {
  std::uint32_t patch;
  float weight;
};

/// F, a row per surfel: links that never change and those that moving parts touch. A row's weights sum to at
/// most 1; the rest escapes or is lost.
struct LinkRows {
  struct Row {
    std::span<const Link> fixed, moving;
  };
  std::vector<Row> rows;
  /// Patches that a row has, of its direct light and albedo: those of row i are [i · patches, …).
  std::size_t patches = 1;

  std::size_t patch_count() const { return patches * rows.size(); }
  std::size_t link_count() const;
};

/// Bounds of the spectral radius of F ρ, ρ the largest channel's albedo of each patch: the factor by which
/// one bounce shrinks light.
Contraction contraction(const LinkRows& links, std::span<const vec3> albedo, int steps = 16);

/// What a bounce leaves of light at most: no material reflects more, and what is enclosed has an end.
inline constexpr float most_albedo = 0.999f;

/// The bound to accelerate with: the upper one, but at most this. Where a white pocket holds its light for
/// hundreds of bounces, a bound that covers it lets steps everywhere else overshoot by many times what is
/// left to find; with this one the pocket still converges, only more slowly than the rest.
inline constexpr double most_chebyshev_bound = 0.98;
double chebyshev_bound(const Contraction& contraction);

/// out_i = Σ_p F_ip radiosity_p: one bounce. Sizes are those of patches and rows.
void bounce_once(const LinkRows& links, std::span<const Irradiance4> radiosity, std::span<Irradiance4> out);

/// Solves for `indirect`, of each row, under direct light of each patch. It holds the first guess (zero, or
/// the last frame's answer, which is then scaled as the direct light's sum has changed since this solver's
/// last call) on entry. Chebyshev's semi-iteration for eigenvalues within ±`contraction_bound` (Golub & Varga
/// 1961; Saad, Iterative Methods, §12.3); plain iteration when the bound is 1 or more. Where steps make
/// no progress, they begin anew for a smaller bound. Rows are computed independently of each other: the same
/// bits for any number of threads. Allocates nothing from the second call of a size on.
class Solver {
 public:
  SolveReport solve(const LinkRows& links, std::span<const vec3> albedo, std::span<const Irradiance4> direct,
                    double contraction_bound, const SolveParams& params, std::vector<Irradiance4>& indirect);

  /// The same bounce by bounce, to the bit: begin(), then iterate() until it returns true. What begin() is
  /// given must stay until then. A solve that is given up leaves no trace in later ones.
  void begin(const LinkRows& links, std::span<const vec3> albedo, std::span<const Irradiance4> direct,
             double contraction_bound, const SolveParams& params, std::vector<Irradiance4>& indirect);
  bool iterate();
  const SolveReport& report() const { return report_; }

 private:
  struct Problem {
    const LinkRows* links = nullptr;
    std::span<const vec3> albedo;
    std::span<const Irradiance4> direct;
    double bound = 1;
    SolveParams params;
    std::vector<Irradiance4>* indirect = nullptr;
    glm::dvec3 sum{0};          ///< of the direct light
    double omega = 1;           ///< Chebyshev's
    double slowest = 1;         ///< share that a bounce leaves of light, at most
    double rate = 0;            ///< by which an iteration shrinks what is missing, at least
    int steps = 0;              ///< for this bound
    float residual_before = 1;  ///< some of them ago
  };
  bool finished() const { return report_.converged || report_.iterations >= problem_.params.max_iterations; }
  void bounce();
  void begin_anew();
  /// Sets the radiosity of a row's patches.
  void set_radiosity(std::size_t row, const Irradiance4& indirect, std::vector<Irradiance4>& radiosity) const;

  Problem problem_;
  SolveReport report_;
  std::vector<Irradiance4> radiosity_, next_radiosity_, previous_;
  std::vector<float> block_residual_, block_largest_;
  std::vector<double> block_change_, block_sum_;  ///< of E
  std::optional<glm::dvec3> last_sum_;            ///< of the direct light that was solved last
};

}  // namespace ssphh::transport
