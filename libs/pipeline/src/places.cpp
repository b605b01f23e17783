#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/core/parse_number.h>
#include <ssphh/core/require.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/pipeline/places.h>
#include <ssphh/probes/tile_folder.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::pipeline {
namespace {

/// Sets spacing or count. Returns what is wrong with the text; empty: nothing.
std::string parse(const std::string& text, place::PlaceParams& params) {
  constexpr std::string_view prefix = "auto:";
  if (text == "scene" || text == "auto") return {};
  if (text.starts_with(prefix)) {
    const std::string_view metres = std::string_view(text).substr(prefix.size());
    params.spacing = parse_number<float>(metres).value_or(0);
    if (params.spacing > 0) return {};
    return fmt::format("\"{}\" is no spacing: give metres over 0, as in auto:0.7", metres);
  }
  params.count = parse_number<int>(text).value_or(0);
  if (params.count > 0) return {};
  return fmt::format("\"{}\" is none of: scene, auto, auto:METRES, a number of probes over 0", text);
}

}  // namespace

std::string places_problem(const std::string& text) {
  place::PlaceParams ignored;
  return parse(text, ignored);
}

bool is_probe_file(const PlaceOptions& options) {
  return options.probes.ends_with(".sphl") || options.probes.ends_with(".sphl.json") ||
         probes::is_tile_folder(options.probes);
}

std::optional<PlaceResult> place_for(const trace::SharedGeometry& geometry, const scene::Scene& scene,
                                     float time, const PlaceOptions& options, const std::string& fallback,
                                     const Control& control) {
  require(std::isfinite(time), "time", "it must be a finite number of seconds");
  place::PlaceParams params = place::place_params(scene, time);
  std::string probes = options.probes.empty() ? fallback : options.probes;
  if (probes.empty()) {
    probes = params.manual.empty() ? "auto" : "scene";
    if (params.manual.empty()) log_info("the scene has no SPHLs, so --probes auto finds places");
  }
  if (probes == "scene") return std::nullopt;
  if (const std::string problem = parse(probes, params); !problem.empty()) throw Error("--probes", problem);
  params.clearance = options.clearance;
  params.levels = options.levels;
  params.max_probes = options.max_probes;

  const Stopwatch watch;
  const trace::TransportScene source(geometry, scene);
  PlaceResult result;
  result.placement = place::place_probes(source, params, control);
  result.seconds = watch.seconds();
  for (const std::string& warning : result.placement.warnings) log_warning("{}", warning);
  return result;
}

}  // namespace ssphh::pipeline
