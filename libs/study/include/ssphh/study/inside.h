#pragma once
/// Whether a place is in a room or under the sky.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::study {

/// At most this share of the sky is free over what is inside, as an irradiance meter that faces up would
/// weigh it.
inline constexpr float inside_sky = 0.25f;

/// 1 for points that are inside, 0 for those outside. It is asked of the air before a point: half-way along
/// each of 16 cosine-distributed rays that meet something, how much of the sky is free, +Y being up. Inside
/// is where that is at most inside_sky in the mean, and over an eighth of the rays meet anything. So a
/// window's sill and the floor behind a glass door, which see much of the sky themselves, are inside with
/// their room; roofs, outside walls, a plain, a street and a court wider than high are outside, and what is
/// under their eaves mostly is.
std::vector<std::uint8_t> inside(const rays::TransportSource& source,
                                 std::span<const rays::SurfacePoint> points, float time);

}  // namespace ssphh::study
