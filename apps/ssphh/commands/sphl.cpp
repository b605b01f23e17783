#include "commands/sphl.h"

#include <fmt/format.h>

#include <ssphh/core/stopwatch.h>
#include <ssphh/scene/thing_alone.h>
#include <ssphh/sh/window.h>

#include "commands/command.h"
#include "results/json_values.h"

namespace ssphh::app {

SphlSampleResult run_sphl_sample(const SphlSampleOptions& o, const Control& control) {
  const Stopwatch watch;
  const scene::Scene scene = load_scene(o.scene);
  const int node = scene::find_node(scene, o.node);
  trace::ThingEmissionParams params = o.params;
  params.path.seed = o.seed;

  SphlSampleResult result;
  scene_io::EmissionFile& file = result.file;
  file.scene = scene.name, file.node = o.node, file.radius = 0;
  if (o.frames > 1) file.emission.rate = o.rate, file.emission.start = o.scene.time;
  file.emission.repeat = o.repeat && o.frames > 1;
  for (int i = 0; i < o.frames; ++i) {
    const float time = o.scene.time + static_cast<float>(i) / o.rate;
    const trace::ThingEmission seen = trace::thing_emission(scene, node, time, params, control);
    file.emission.frames.push_back(seen.intensity);
    file.radius = std::max(file.radius, seen.radius);
    result.center += seen.center / static_cast<float>(o.frames);
    result.paths += seen.paths;
  }
  scene_io::write_emission_file(file, o.output);
  const sh::IntensitySh& first = file.emission.frames[0];
  result.flux = static_cast<double>(4 * pi * luminance(scene::mean_intensity(first)));
  sh::RadianceSh shape;
  for (const vec3& value : first.values) shape.values.emplace_back(luminance(value));
  result.least = sh::minimum(shape).x / luminance(scene::mean_intensity(first));
  result.seconds = watch.seconds();
  return result;
}

json::Value to_json(const SphlSampleResult& r, const SphlSampleOptions& o) {
  return {{"output", o.output},
          {"node", o.node},
          {"degree", o.params.degree},
          {"frames", o.frames},
          {"rate", o.frames > 1 ? o.rate : 0},
          {"center", to_json(r.center)},
          {"radius", r.file.radius},
          {"flux", r.flux},
          {"least", r.least},
          {"paths", r.paths},
          {"seconds", r.seconds}};
}

std::string to_text(const SphlSampleResult& r, const SphlSampleOptions& o) {
  const std::string frames =
      o.frames > 1 ? fmt::format(", {} frames at {:g} per second", o.frames, o.rate) : std::string();
  return fmt::format(
      "{}: light of \"{}\", degree {}{}; {:.4g} W, darkest direction {:+.3f} of the mean; {} paths in {:.2f} "
      "s\n"
      "in an overlay: {{\"node\": \"{}\", \"position\": [{:.4g}, {:.4g}, {:.4g}], \"radius\": {:.3g}, "
      "\"emission\": {{\"file\": \"{}\"}}}}",
      o.output, o.node, o.params.degree, frames, r.flux, r.least, r.paths, r.seconds, o.node, r.center.x,
      r.center.y, r.center.z, r.file.radius, std::filesystem::path(o.output).filename().string());
}

void add_sphl_commands(Command app, Context& context) {
  Command group = add_group(app, "sphl", "SPHLs that are lamps: sample the light of things");
  auto [command, o] = add_command(group, context, "sample",
                                  "What a thing sends out, as an SPHL of other scenes", run_sphl_sample);
  add_scene_options(command, o.scene);
  command.option("--node", o.node, "The thing: meshes and lamps at this node and below it, alone in the dark")
      .required();
  command.option("-o,--output", o.output, "Emission file to write").required();
  command.option("--degree", o.params.degree, "Of the spherical harmonics").range(0, sh::max_degree);
  command.option("--frames", o.frames, "Moments to sample, from --time on").range(1, 10000);
  command.option("--rate", o.rate, "Moments per second").range(1e-3f, 1e3f);
  command.flag("--repeat", o.repeat, "After the last moment comes the first");
  command.option("--size", o.params.image_size, "Pixels along a side of the view from each direction")
      .range(1, 4096);
  command.option("--spp", o.params.path.spp, "Paths per pixel").range(1, 1 << 20);
  command.option("--max-depth", o.params.path.max_depth, "Scattering events on the thing itself")
      .range(0, 1000);
}

}  // namespace ssphh::app
