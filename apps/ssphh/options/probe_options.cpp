#include "options/probe_options.h"

#include <ssphh/probes/keyed_files.h>
#include <ssphh/probes/tile_folder.h>

namespace ssphh::app {
namespace {

std::string probe_file_problem(const std::string& name) {
  try {
    probes::probe_file_format(name);
    return {};
  } catch (const Error& e) {
    return e.what();
  }
}

std::string probe_keys_problem(const std::string& text) {
  try {
    probes::read_probe_keys(text);
    return {};
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace

Option add_probe_keys(const Command& command, const std::string& names, std::string& files,
                      const std::string& help) {
  return command.option(names, files, help).check(probe_keys_problem, ".sphl|.sphl.json|.tiles");
}

Option add_keyed_probes(const Command& command, const std::string& names, std::string& files,
                        const std::string& help) {
  return add_probe_keys(
      command, names, files,
      help +
          "; several, as a.sphl@0,b.sphl@1, are keys whose light is blended at --time [s] (without @: at "
          "that of their bake)");
}

Option add_probe_file(const Command& command, const std::string& names, std::string& file,
                      const std::string& help) {
  return command.option(names, file, help).check(probe_file_problem, ".sphl|.sphl.json|.tiles");
}

Option add_probe_output(const Command& command, const std::string& names, std::string& file,
                        const std::string& help) {
  const auto problem = [](const std::string& name) -> std::string {
    return probes::is_tile_folder(name) ? "only a bake writes tiles: choose a name that ends in .sphl"
                                        : probe_file_problem(name);
  };
  return command.option(names, file, help).check(problem, ".sphl|.sphl.json");
}

Option add_probe_files(const Command& command, const std::string& names, std::vector<std::string>& files,
                       const std::string& help) {
  return command.option(names, files, help).check(probe_file_problem, ".sphl|.sphl.json|.tiles");
}

Option add_force_option(Command command, bool& force) {
  return command.flag("--force", force,
                      "Go on with a warning where the probes were baked in another scene or pose");
}

Option add_lookup_option(Command command, probes::LookupMethod& method) {
  return command.choice("--lookup", method,
                        "irradiance: blend of visible SPHLs; light: nearest visible SPHL, as the paper");
}

Option add_weights_option(Command command, std::optional<probes::WeightMethod>& weights) {
  return command.choice(
      "--weights", weights,
      "How --lookup irradiance finds light: surface (records of `bake --records`, with SPHLs for what moves; "
      "the default where a file has any), fitted (SPHLs by weights of `bake --fit`, with mls for what moves; "
      "else the default), mls (moving least squares over SPHLs; else the default), trilinear (SPHLs on a "
      "grid), distance (nearest visible ones)");
}

Option add_layer_option(Command command, probes::ProbeLayer& layer) {
  return command.choice("--light", layer,
                        "sum: own and neighbours' light where HIER was run; self: own light only",
                        {"sum", "self"});
}

Option add_truth_path_options(const Command& command, int& spp, int& max_depth) {
  const Option paths = command.option("--truth-spp", spp, "Paths per point").range(2, 1 << 22);
  command.option("--max-depth", max_depth, "Scattering events of a path").range(2, 1000);
  return paths;
}

}  // namespace ssphh::app
