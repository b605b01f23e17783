#include "commands/relight.h"

#include "commands/command.h"
#include "commands/relight_animation.h"
#include "options/picture_options.h"
#include "options/probe_options.h"

namespace ssphh::app {
namespace {

void add_transport_options(const Command& transport, RelightOptions& o) {
  transport.choice("--operator", o.params.op,
                   "surfel: light goes from surface patch to patch until it settles; bounce: from probe to "
                   "probe, each surface looking up the probes around it",
                   {"surfel", "bounce"});
  transport.option("--degree", o.params.degree, "Highest band of the probes' functions")
      .range(0, sh::max_degree);
  transport.option("--directions", o.params.transport.directions, "Rays of a probe").range(16, 65536);
  transport
      .option("--surfel-size", o.params.transport.surfel_size,
              "Edge of a surface patch [m]; 0: a twentieth of the scene's radius, at most 0.5 where probes "
              "are near each other, and more far from "
              "probes where that would make too many")
      .non_negative();
  transport
      .option("--poses", o.params.poses,
              "Blend doors and the like between so many poses found beforehand, 2 or more; 0: pose exactly")
      .range(0, 1 << 16);
  transport
      .option("--key-frames", o.key_frames,
              "Blend the light of all frames between so many moments of the run, 2 or more, as a game plays "
              "keyed "
              "bakes, and tell its error against exact posing; 0: every frame has its own")
      .range(0, 1 << 16);
  transport.option("--link-rays", o.params.transport.link_rays, "Rays of a surface patch").range(8, 65536);
}

void add_truth_options(const Command& truth, RelightOptions& o) {
  truth
      .option("--truth", o.truth, "Path trace every so-many-th frame and report the lookup's error; 0: never")
      .range(0, 1 << 20);
  truth.option("--points", o.points, "Surface points at which the error is measured").range(1, 1 << 24);
  add_truth_path_options(truth, o.truth_spp, o.max_depth);
  truth.choice(
      "--weights", o.weights,
      "How light is found: surface (records of surfaces that follow lamps and doors, and probes for what "
      "moves), or by probes alone: distance, trilinear, mls; fitted to the light transport, once for the "
      "run, at --fit-frames of its frames");
  truth
      .option("--fit-frames", o.fit_frames,
              "With --weights fitted: frames, evenly spaced over the run, whose light and poses they fit")
      .range(1, 256);
}

void add_output_options(const Command& output, RelightOptions& o) {
  output.option("-o,--output", o.output,
                "Folder for frame-0000.png and so on, and for error.svg with --truth");
  output.option("--pictures", o.pictures, "Draw every so-many-th frame; 0: none").range(0, 1 << 20);
  output.choice("--format", o.format, "Of the frames: png (tone mapped) or exr (linear)");
  add_camera_option(output, o.camera);
  add_size_options(output, o.width, o.height, 16384);
  output.option("--spp", o.spp, "Samples per pixel").range(1, 65536);
  add_exposure_option(output, o.exposure,
                      "Of .png frames, in stops; auto: what suits the first that is not black");
  add_probe_output(output, "--save", o.save,
                   "Write the probes of the last frame here; with --key-frames those of every key, numbered: "
                   "door-0.sphl ...");
}

}  // namespace

void add_relight_command(Command app, Context& context) {
  auto [command, o] = add_command(
      app, context, "relight", "Move lamps and doors and keep the probes lit, frame by frame", run_relight);
  add_scene_options(command, o.scene);
  add_place_options(command, o.place, true);
  add_force_option(command, o.force);
  command.option("--animate", o.animate, animation_help).repeatable();
  command.option("--frames", o.frames, "Frames; their keys go from the first to the last").range(1, 1 << 20);
  command.option("--fps", o.fps, "Frames a second: the curve's time axis, and the time a frame may take")
      .range(0.001, 10000.0);
  add_transport_options(command.under("Transport"), o);
  add_truth_options(command.under("Truth"), o);
  add_output_options(command.under("Output"), o);
  add_farm_options(command, o.farm);
  command.footer(
      "Frames are timed first, one after the other; truth, pictures and --save come after. A "
      "farm draws the pictures; light is found by this process.");
}

}  // namespace ssphh::app
