#pragma once
/// Light that surfaces get of a probe set, as a picture of the set has it.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <ssphh/core/held.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::pipeline {

/// Irradiance at surface points: what a lookup of the set holds, and light straight from emitters of the
/// groups that it leaves out, each at the set's scale. Safe to call from several threads. Keeps references to
/// the tracer.
class SurfaceLight {
 public:
  /// `source` and `tracer` are of one scene, at `time` [s]. Throws Error as probes::make_lookup does.
  SurfaceLight(const trace::TransportScene& source, const trace::PathTracer& tracer,
               const probes::ProbeSet& set, const probes::LookupParams& params, float time);

  /// [W/m²] at the point's side, by its normal, of what the lookup holds: it is smooth.
  vec3 held(const rays::SurfacePoint& at) const { return lookup_->irradiance(at); }
  /// The rest, straight from emitters, by so many samples of each with an extent: shadows have edges. The
  /// same bits at every call. Throws Error for less than 1 sample.
  vec3 direct(const rays::SurfacePoint& at, int samples) const;
  /// Light groups whose direct light the lookup holds.
  const std::vector<std::string>& held_groups() const { return held_; }

 private:
  Held<rays::IndirectLight> lookup_;
  std::vector<std::string> held_;
  std::unique_ptr<rays::DirectLight> direct_;
  std::vector<std::pair<int, vec3>> groups_;
};

}  // namespace ssphh::pipeline
