#pragma once
/// `bounce`: probes as the only unknowns. S = D + B S, where D is the direct light that probe rays see and B
/// looks the rest up from the probes around each ray's hit (docs/methods/transport.md). One application is
/// the paper's HIER in a form that is linear transport; solved, it has every bounce. The lookup's bias is
/// amplified by the bounces, so `surfel` is better; this form needs no surfels beyond those that carry direct
/// light.

#include <vector>

#include <ssphh/probes/lookup_weights.h>
#include <ssphh/sh/coefficients.h>
#include <ssphh/transport/network.h>

namespace ssphh::transport {

struct BounceParams {
  probes::WeightParams weights{.method = probes::WeightMethod::trilinear};
  int irradiance_degree = 2;  ///< bands of the probes' irradiance that surfaces look up
  int applications = 0;       ///< of B; 0: until it changes no probe by more than the tolerance
  float tolerance = 1e-3f;    ///< of a probe's band 0, relative to the largest one's
  int max_iterations = 200;
};

struct BounceReport {
  int iterations = 0;
  double contraction = 0;  ///< ratio of two late changes (largest band 0): an estimate of B's spectral radius
  bool converged = true;
  std::size_t edges = 0;  ///< pairs of probes that B couples
};

class BounceOperator {
 public:
  /// Finds the lookup weights at every probe ray's hit, in the network's pose. Keeps references to both.
  /// Poses blended in time are not followed: rays see what TransportNetwork::seen() says.
  BounceOperator(const TransportNetwork& network, const rays::TransportSource& source, int degree,
                 const BounceParams& params = {});
  BounceOperator(const TransportNetwork&&, const rays::TransportSource&, int,
                 const BounceParams& = {}) = delete;
  BounceOperator(const TransportNetwork&, const rays::TransportSource&&, int,
                 const BounceParams& = {}) = delete;
  BounceOperator(const TransportNetwork&&, const rays::TransportSource&&, int,
                 const BounceParams& = {}) = delete;
  ~BounceOperator();

  /// Follows the network to its pose: weights are found anew at rays that see something else and at those
  /// whose way to a probe some part may cross. Equals a new operator to the bit. Returns the number of rays.
  std::size_t update_pose();

  /// Reflected light of every probe from the surfels' direct irradiance. `warm`: begins with what `reflected`
  /// holds, the answer of a similar light, instead of darkness; not with a given number of applications.
  BounceReport solve(std::span<const Irradiance4> direct, std::vector<sh::RadianceSh>& reflected,
                     bool warm = false) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace ssphh::transport
