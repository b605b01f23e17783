#include "options/render_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/nearest_word.h>
#include <ssphh/methods/method_list.h>

#include "options/method_options.h"
#include "options/probe_options.h"

namespace ssphh::app {

std::vector<methods::Drawing> drawings_of(const RenderOptions& o) {
  std::vector<methods::Drawing> drawings;
  for (const std::string& name : o.draw) {
    const auto drawing = parse_enum<methods::Drawing>(name);
    if (!drawing)
      throw Error("--draw " + name, "is nothing that can be drawn",
                  nearest_hint(name, names_of<methods::Drawing>()));
    drawings.push_back(*drawing);
  }
  return drawings;
}

std::string method_of(const RenderOptions& o) {
  if (!o.method.empty()) return o.method;
  return !o.probes.empty() || o.backend == RenderBackend::gl ? "ssphh" : "path";
}

void add_render_options(Command command, RenderOptions& o) {
  add_scene_options(command, o.scene);
  add_farm_options(command, o.farm);

  std::vector<std::string> names = {"path"};
  std::string description = "How indirect light is found: path (path tracing, the ground truth);";
  for (const methods::MethodEntry& entry : methods::all_methods()) {
    names.emplace_back(entry.name);
    description += fmt::format(" {} ({});", entry.name, entry.about);
  }
  description += " default: ssphh with --probes or --backend gl, else path";
  command.option("--method", o.method, description).one_of(names);
  add_method_parameters(command, o.parameters);
  command
      .option("-o,--output", o.output, "Picture: .exr or .hdr (linear radiance), .png or .jpg (tone mapped)")
      .required();
  command.option("--png", o.png, "Also write a tone-mapped PNG here");
  add_tev_option(command, o.tev,
                 "Show the picture in the viewer tev that listens there, after each of --passes");
  add_size_options(command, o.width, o.height, 65536);
  add_camera_option(command, o.camera);
  command.choice(
      "--projection", o.projection,
      "camera; or the whole sphere at its position: equirect, or cube (6×1 strip, width = 6 × height)");
  add_at_option(command, o.at);

  const Command paths = command.under("Light paths");
  add_max_depth_option(paths, o.max_depth);
  paths.option("--passes", o.passes, "Progressive passes; Ctrl-C keeps the finished ones").range(1, 1000000);
  paths.option("--spp", o.spp, "Samples per pixel and pass").range(1, 65536);
  paths.flag("--resume", o.resume, "Continue from OUT.state, left by a cancelled run of the same command");

  const Command probes = command.under("Method ssphh");
  add_keyed_probes(probes, "--probes", o.probes,
                   "Probe file (.sphl or .sphl.json); none: probes are placed and lit for this picture");
  add_lookup_option(probes, o.lookup.method);
  probes.choice("--backend", o.backend,
                "cpu: traced, any number of samples; gl: a frame of the real-time renderer (methods ssphh, "
                "vct, vpl, direct), up to 4×4 samples per pixel (docs/methods/realtime.md)");
  probes
      .option("--occlusion", o.occlusion,
              "With --backend gl: dim SPHLs' light in corners by what stands within so many metres; 0: off")
      .range(0.0f, 100.0f);
  probes
      .option("--indirect-scale", o.indirect_scale,
              "With --backend gl: look indirect light up at every n-th pixel each way, and interpolate where "
              "that shows no difference (docs/methods/realtime.md)")
      .range(1, 8);
  add_weights_option(probes, o.lookup.weights);
  add_layer_option(probes, o.lookup.layer);

  add_force_option(probes, o.force);

  const Command output = command.under("Output");
  std::vector<std::string> aovs = names_of<trace::RenderLayer>();
  for (const trace::RenderLayer layer : {trace::RenderLayer::color, trace::RenderLayer::coverage})
    std::erase(aovs, name_of(layer));
  output.choices("--aov", o.aovs, ',',
                 fmt::format("Extra float images beside the output: {}", fmt::join(aovs, " ")), aovs);
  output
      .option("--draw", o.draw,
              "Draw over the picture what the method holds: tetrahedra, hierarchy, links, surfels, photons, "
              "voxels or transfer; dimmed where surfaces hide it")
      .separated_by(',')
      .kind("WHAT");
  add_exposure_option(output, o.exposure,
                      "Exposure of tone-mapped output in stops; auto: what suits the picture");
  output.choice("--tonemap", o.tonemap, "clip at white, or filmic");
}

}  // namespace ssphh::app
