#include "photons.h"

#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

namespace ssphh::methods::vpl {
namespace {

struct Flying {
  rays::Photon photon;
  SampleSequence numbers;
};

/// Of how many photons each group sends: in proportion to its scaled flux, one at least of what shines.
std::vector<int> share_out(const rays::DirectLight& lights, std::span<const vec3> group_scales, int photons) {
  std::vector<double> flux;
  double all = 0;
  for (std::size_t g = 0; g < group_scales.size(); ++g) {
    // A blue light through a blue scale must not be forgotten for its luminance alone.
    const double scale = static_cast<double>(max_component(group_scales[g]));
    flux.push_back(scale > 0 ? scale * static_cast<double>(lights.flux(static_cast<int>(g))) : 0);
    all += flux.back();
  }
  std::vector<int> count;
  for (const double f : flux)
    count.push_back(f > 0 ? std::max(1, static_cast<int>(std::lround(f / all * photons))) : 0);
  return count;
}

std::vector<Flying> emit(const rays::DirectLight& lights, std::span<const vec3> group_scales,
                         const PhotonParams& params) {
  const std::vector<int> count = share_out(lights, group_scales, params.photons);
  std::vector<Flying> flying;
  for (std::size_t g = 0; g < count.size(); ++g) {
    for (int i = 0; i < count[g]; ++i) {
      SampleSequence numbers(hash_combine(params.seed, g), static_cast<std::uint32_t>(i));
      const float emitter = numbers.next();
      const vec2 place = numbers.next2(), direction = numbers.next2();
      const auto photon = lights.emit(static_cast<int>(g), {emitter, place, direction});
      if (!photon) continue;
      flying.push_back({*photon, numbers});
      flying.back().photon.power *= group_scales[g] / static_cast<float>(count[g]);
    }
  }
  return flying;
}

}  // namespace

std::vector<Vpl> trace_photons(const rays::DirectLight& lights, std::span<const vec3> group_scales,
                               const rays::PosedWorld& surfaces, const PhotonParams& params,
                               const Control& control) {
  const float lift = 1e-4f * surfaces.bounds().radius();
  std::vector<Vpl> vpls;
  std::vector<Flying> flying = emit(lights, group_scales, params), next;
  std::vector<rays::RayQuery> rays;
  std::vector<rays::RayHit> hits;
  for (int depth = 2; depth <= params.depth && !flying.empty(); ++depth) {
    control.check();
    rays.clear();
    for (const Flying& f : flying) rays.push_back({f.photon.origin, f.photon.direction});
    hits.resize(rays.size());
    surfaces.intersect(rays, hits);
    next.clear();
    for (std::size_t i = 0; i < flying.size(); ++i) {
      const rays::RayHit& hit = hits[i];
      if (hit.escaped()) continue;
      Flying& f = flying[i];
      const vec3 arrived = f.photon.power * hit.through * f.photon.range_share(hit.distance);
      const vec3 left = arrived * hit.albedo;
      const vec3 position = rays[i].origin + hit.distance * rays[i].direction + lift * hit.normal;
      if (!(max_component(left) > 0)) continue;
      vpls.push_back({position, hit.normal, left});

      const float survives = std::min(max_component(left) / max_component(arrived), 1.0f);
      const vec2 u = f.numbers.next2();
      if (!(f.numbers.next() < survives)) continue;
      f.photon = {position, Frame::around(hit.normal).to_world(sample_cosine_hemisphere(u)), left / survives};
      next.push_back(f);
    }
    std::swap(flying, next);
  }
  return vpls;
}

}  // namespace ssphh::methods::vpl
