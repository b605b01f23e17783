#pragma once
/// What a frame shows and how: plain data, changed freely from frame to frame.

#include <ssphh/image/tonemap.h>
#include <ssphh/probes/lookup.h>

namespace ssphh::realtime {

/// What the picture shows in place of the lit scene. All but `lit`, `direct` and `indirect` bypass the tone
/// curve.
enum class View {
  lit,
  direct,    ///< emission and light of lamps, path depth ≤ 1
  indirect,  ///< light looked up from probes, or of the method that takes their place
  albedo,
  normal,      ///< shading normal, 0.5 + 0.5 n
  depth,       ///< along the view axis, 1 m: 1/2, 2 m: 2/3, …
  shadow,      ///< share of the lamps' light that arrives
  chosen_sphl  ///< colour of the probe that counts most; darker where fewer are visible
};

enum class Sky { environment, black };

struct FrameSettings {
  bool direct = true;
  bool indirect = true;
  probes::LookupMethod lookup = probes::LookupMethod::irradiance;
  /// Of lookup `irradiance`. `surface` takes the records that Renderer::set_records prepared, else what
  /// set_fitted did; `fitted` the latter alone. Where there are none, and for what moves, both are mls.
  probes::WeightMethod weights = probes::WeightMethod::surface;
  /// n: indirect light is looked up at every n-th pixel each way, and at those between where the four around
  /// them differ by more than `indirect_tolerance` of the brightest or lie on another surface; interpolated
  /// elsewhere.
  int indirect_scale = 1;
  float indirect_tolerance = 0.1f;
  /// Pixels by which the picture is moved to the right and up: parts of one, for frames that are averaged.
  vec2 shift{0};
  int supersample = 1;  ///< samples per pixel along each side, 1..4
  bool ambient_occlusion = false;
  float occlusion_radius = 0.5f;  ///< metres
  View view = View::lit;
  Sky sky = Sky::environment;
  image::ToneMap tone = {};
  bool wireframe = false;
};

}  // namespace ssphh::realtime
