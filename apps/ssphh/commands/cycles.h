#pragma once
/// Blender's Cycles beside our path tracer: as `truth` and `bake` run it.

#include <chrono>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <ssphh/bake/bake.h>
#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/farm/job.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/scene/scene.h>
#include <ssphh/trace/path_tracer.h>

namespace ssphh::app {

using farm::Renderer;

struct CyclesOptions {
  std::filesystem::path work;        ///< folder of exported scenes, pictures and Blender's log
  int threads = 0;                   ///< 0: all
  std::chrono::seconds limit{3600};  ///< of each run of Blender
};

/// Throws Error that says where it was looked for, where no Blender is on PATH.
void require_blender();

/// Runs an exported render.py with these arguments; what Blender says is appended to blender.log in the
/// folder. Throws Error where it fails; Cancelled when asked to stop.
void run_blender(const std::filesystem::path& script, std::vector<std::string> arguments,
                 const CyclesOptions& options, const Control& control);

/// Blender's own kind of seed, a signed 32-bit number.
std::string blender_seed(std::uint64_t seed);

/// The light that arrives at a point, by Cycles: a cube of pictures for each light group, or for each ghost
/// sphere. What is no light it asks `ours`, as it does for the names of light groups. Calls share the work
/// folder, so they come one at a time.
class CyclesSource : public rays::RadianceSource {
 public:
  /// Keeps references to both. Throws Error as require_blender() does.
  CyclesSource(const scene::Scene& scene, float time, const rays::RadianceSource& ours,
               const CyclesOptions& options);

  const std::vector<std::string>& light_groups() const override { return ours_.light_groups(); }
  std::vector<rays::GroupRadiance> incident_radiance(const rays::CubeRequest& request,
                                                     const Control& control) const override;
  /// Throws Error where paths are asked for, one by one or of diffuse surfaces alone.
  std::vector<image::CubeMap> ghost_radiance(const rays::CubeRequest& request,
                                             std::span<const rays::GhostSphere> ghosts, const GhostSink& sink,
                                             const Control& control) const override;
  bool visible(const vec3& a, const vec3& b) const override { return ours_.visible(a, b); }
  float backface_fraction(const vec3& position) const override { return ours_.backface_fraction(position); }

 private:
  rays::GroupRadiance render(const scene::Scene& lit, const rays::CubeRequest& request,
                             const Control& control) const;
  scene::Scene with_group_alone(std::size_t group) const;

  const scene::Scene& scene_;
  float time_;
  const rays::RadianceSource& ours_;
  CyclesOptions options_;
};

/// Does the units of a bake by Cycles, one after the other.
class CyclesCrew : public bake::BakeCrew {
 public:
  /// Keeps a reference to the scene. Throws Error as require_blender() does.
  CyclesCrew(const trace::SharedGeometry& geometry, const scene::Scene& scene, float time,
             const CyclesOptions& options)
      : ours_(geometry, scene, time), source_(scene, time, ours_, options) {}
  void run(const probes::ProbeSet& set, const bake::BakeParams& params,
           std::span<const bake::ProbeStage> stages, const std::function<void(bake::ProbeStageResult)>& done,
           const Control& control) override;

 private:
  trace::PathTracer ours_;
  CyclesSource source_;
};

}  // namespace ssphh::app
