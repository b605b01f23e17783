#include <algorithm>

#include <ssphh/bake/effort.h>
#include <ssphh/core/require_named.h>

namespace ssphh::bake {

Effort effort_of(Quality quality) {
  require_named("quality of a bake", quality);
  switch (quality) {
    case Quality::draft:
      return {.spp = 4,
              .directions = 512,
              .link_rays = 64,
              .surfels_per_radius = 20,
              .most_surfels = 30000,
              .records = 4096};
    case Quality::good:
      break;
    case Quality::best:
      return {.spp = 64,
              .directions = 4096,
              .link_rays = 256,
              .surfels_per_radius = 56,
              .most_surfels = 300000,
              .records = 65536};
  }
  return {};
}

namespace {

constexpr double other = 64e6, surfel = 2000, ray = 45;

}  // namespace

double network_bytes(double surfels, double rays) {
  return other + surfel * surfels + ray * rays;
}

int surfels_within(std::uint64_t bytes, int link_rays) {
  const double count = (static_cast<double>(bytes) - other) / (surfel + ray * link_rays);
  return static_cast<int>(std::clamp(count, 1000.0, 16e6));
}

}  // namespace ssphh::bake
