#pragma once
/// `bounce`: probes as the only unknowns. S = D + B S, where D is the direct light that probe rays see and B
/// looks the rest up from the probes around each ray's hit (docs/methods/transport.md). One application is
/// the paper's HIER in a form that is linear transport; solved, it has every bounce. The lookup's bias is
/// amplified by the bounces, so `surfel` is better; this form needs no surfels beyond those that carry direct
/// light.

#include <memory>
#include <vector>

#include <ssphh/sh/coefficients.h>
#include <ssphh/transport/network.h>

namespace ssphh::transport {

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

  /// Reflected light of every probe from the patches' direct irradiance. `warm`: begins with what `reflected`
  /// holds, the answer of a similar light, instead of darkness; not with a given number of applications.
  /// Allocates nothing from the second call on. Not from two threads at once.
  BounceReport solve(std::span<const Irradiance4> direct, std::vector<sh::RadianceSh>& reflected,
                     bool warm = false);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace ssphh::transport
