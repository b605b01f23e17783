#include "mirrors.h"

#include <algorithm>

namespace ssphh::transport {

std::vector<MirrorSight> follow_mirrors(const rays::TransportSource& source,
                                        std::span<const rays::RayQuery> rays,
                                        std::span<const rays::RayHit> hits) {
  // Of what several mirrors pass on there is little, and a moving part may come into any of the ways.
  const int most = source.part_count() > 1 ? 1 : 3;
  std::vector<MirrorSight> sights;
  std::vector<rays::MirroredRay> mirrored = source.mirrored(0, rays, hits);
  std::vector<vec3> from;
  for (const rays::MirroredRay& m : mirrored) from.push_back(rays[m.of].origin);
  for (int times = 1; !mirrored.empty(); ++times) {
    std::vector<rays::RayQuery> next(mirrored.size());
    std::ranges::transform(mirrored, next.begin(), &rays::MirroredRay::ray);
    std::vector<rays::RayHit> met(next.size());
    source.intersect(0, next, met);
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (met[i].escaped()) continue;
      sights.push_back({mirrored[i].of,
                        from[i],
                        {next[i].origin, next[i].direction, met[i].distance},
                        met[i].normal,
                        met[i].albedo,
                        mirrored[i].share * met[i].through});
    }
    if (times == most) break;
    std::vector<rays::MirroredRay> again = source.mirrored(0, next, met);
    std::vector<vec3> again_from;
    for (rays::MirroredRay& m : again) {
      again_from.push_back(next[m.of].origin);
      m.share *= mirrored[m.of].share;
      m.of = mirrored[m.of].of;
    }
    mirrored = std::move(again);
    from = std::move(again_from);
  }
  std::ranges::stable_sort(sights, {}, &MirrorSight::of);
  return sights;
}

}  // namespace ssphh::transport
