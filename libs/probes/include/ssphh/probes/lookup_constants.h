#pragma once
/// Numbers that the lookups of the CPU and those of shaders share. They stand here alone: shaders get them by
/// the names of `constants_of_shaders`.

#include <array>

#include <ssphh/probes/candidate_grid.h>
#include <ssphh/probes/lookup.h>

namespace ssphh::probes {

/// Rays toward probes start so far off the surface, in shares of the distance or of the spacing of probes,
/// whichever is less.
inline constexpr float sight_lift = 0.01f;
/// Toward probes that far below the tangent plane of what stands still, as a sine, they start at a share of
/// the distance, for past an edge of the surface they would meet what stands behind; and at so much of the
/// greatest coordinate, for they must not start beyond the surface itself: what tells of sight leaves out a
/// ten-thousandth of the way at its ends, and what may be rounding.
inline constexpr float sight_below = 0.05f, sight_lift_below = 2e-4f, sight_rounding = 4e-6f;
/// What a probe right behind the surface keeps of its weight by distance, beside the wrapped cosine.
inline constexpr float wrapped_floor = 0.05f;
/// A hidden probe that stands in for visible ones counts so much per cosine above the tangent plane, at
/// most 1.
inline constexpr float hidden_slope = 4;
/// Moving least squares look so far [spacings] …
inline constexpr float mls_reach = 2;
/// … give what stands that far this weight, so that the fit never lacks points …
inline constexpr float mls_least_bump = 1e-6f;
/// … and keep the fit flat where the probes do not differ.
inline constexpr float mls_ridge = 0.05f;
/// A tent of trilinear weights that is lower counts for nothing.
inline constexpr float least_tent = 1e-4f;

/// A point of a surface lights places around it within so many of its spacings …
inline constexpr float fitted_reach = 3;
/// … whose normal agrees with its own to this cosine …
inline constexpr float fitted_cosine = 0.7f;
/// … and from whose plane it is no farther than so many of its spacings and …
inline constexpr float fitted_off_plane = 0.5f;
/// … this share of the distance.
inline constexpr float fitted_off_plane_slope = 0.1f;
/// Where points stand nearer to each other, one so many of their spacings away counts half.
inline constexpr float fitted_coarser = 2.5f;
/// Rays between such points start so many spacings above the surface, and this share higher of what it bulges
/// by their normals.
inline constexpr float fitted_lift = 0.02f, fitted_lift_over_bulges = 0.2f;
/// So high they begin once more, where there is room: nothing passes through a slit. In spacings.
inline constexpr float fitted_roof = 0.25f;
/// Over what coarse triangles rise above the surface that they stand for: so many spacings.
inline constexpr float fitted_hop = 0.05f;
/// Classes of what lies close before a point (surface_cover).
inline constexpr int most_cover = 4;
inline constexpr float fitted_ridge = 0.05f;
/// Of their whole weight, points count for less than nothing with no more than this.
inline constexpr float fitted_negative = 0.25f;

/// Where others have records that keep the sky's direct light, a still surface without one is a crack, a rim
/// or small: it gets this share of the sky that probes in the open see.
inline constexpr float still_share_of_sky = 0.5f;

struct ShaderConstant {
  const char* name;
  float value;
  bool whole = false;  ///< an integer
};

inline constexpr std::array constants_of_shaders = {
    ShaderConstant{"MAX_LISTED", CandidateGrid::longest, true},
    ShaderConstant{"MAX_NEAR", max_weights, true},
    ShaderConstant{"MAX_BLEND", blended_probes, true},
    ShaderConstant{"SIGHT_LIFT", sight_lift},
    ShaderConstant{"SIGHT_BELOW", sight_below},
    ShaderConstant{"STILL_SHARE_OF_SKY", still_share_of_sky},
    ShaderConstant{"WRAPPED_FLOOR", wrapped_floor},
    ShaderConstant{"HIDDEN_SLOPE", hidden_slope},
    ShaderConstant{"MLS_REACH", mls_reach},
    ShaderConstant{"MLS_LEAST_BUMP", mls_least_bump},
    ShaderConstant{"MLS_RIDGE", mls_ridge},
    ShaderConstant{"LEAST_TENT", least_tent},
    ShaderConstant{"FITTED_REACH", fitted_reach},
    ShaderConstant{"FITTED_COSINE", fitted_cosine},
    ShaderConstant{"FITTED_OFF_PLANE", fitted_off_plane},
    ShaderConstant{"FITTED_OFF_PLANE_SLOPE", fitted_off_plane_slope},
    ShaderConstant{"FITTED_COARSER", fitted_coarser},
    ShaderConstant{"FITTED_RIDGE", fitted_ridge},
    ShaderConstant{"FITTED_NEGATIVE", fitted_negative},
};

}  // namespace ssphh::probes
