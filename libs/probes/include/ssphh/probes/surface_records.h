#pragma once
/// Irradiance kept at points of surfaces that stand still (an irradiance cache: Ward, Rubinstein & Clear, A
/// Ray Tracing Solution for Diffuse Interreflection, SIGGRAPH 1988): plain data, filled by
/// transport::SurfaceGather, stored in probe files.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/vectors.h>
#include <ssphh/rays/surface_point.h>

namespace ssphh::probes {

/// RGB irradiance [W/m²] around a record, by the surface's unit normal. The part that is linear in it is the
/// derivative as the surface turns (Ward & Heckbert, Irradiance Gradients, 1992). It holds to about 45°.
using RecordLight = rays::IrradianceByNormal;

/// A RecordLight in 22 bytes: RGB of E and of its derivatives along both tangents of Frame::around(normal),
/// in 32767ths of `scale`.
struct PackedRecordLight {
  float scale = 0;  ///< the largest of the nine, not negative
  std::array<std::int16_t, 9> values{};

  friend bool operator==(const PackedRecordLight&, const PackedRecordLight&) = default;
};
PackedRecordLight pack(const RecordLight& light, const vec3& normal);
RecordLight unpack(const PackedRecordLight& packed, const vec3& normal);

/// Records with the light that surfaces reflect toward them, every bounce, and apart from it what emitters of
/// some light groups send straight to them. Per light group, unscaled.
struct SurfaceRecords {
  std::vector<rays::SurfacePoint> points;
  std::vector<std::vector<PackedRecordLight>> groups;  ///< reflected, [light group][point]
  /// Likewise direct light; nothing of groups that keep none. May be shorter than `groups`.
  std::vector<std::vector<PackedRecordLight>> direct = {};
  std::vector<RecordLight> light = {};  ///< Σ_g c_g E_g: derived by merge_groups, not stored in files

  bool keeps_direct(std::size_t group) const { return group < direct.size() && !direct[group].empty(); }

  friend bool operator==(const SurfaceRecords&, const SurfaceRecords&);
};

/// Throws Error unless every point stands at a finite place, and every one of `group_count` groups has a
/// light for each, and direct light for each or none.
void require_whole(const SurfaceRecords& records, std::size_t group_count);

/// Sets `light` from the groups, each times its scale, with the direct light of those marked in `with_direct`
/// that keep any. Throws Error as require_whole does.
void merge_groups(SurfaceRecords& records, std::span<const vec3> scales,
                  const std::vector<bool>& with_direct = {});

}  // namespace ssphh::probes
