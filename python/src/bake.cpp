#include <filesystem>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/probes/probe_file.h>

#include "probes_argument.h"
#include "work.h"

namespace ssphh::python {
namespace {

using pipeline::BakeSettings;
using ProbesHandle = std::shared_ptr<probes::ProbeSet>;

/// Takes what was given, and notes the name of it.
template <class T>
void take(const std::optional<T>& given, T& value, const char* name = nullptr,
          std::vector<std::string>* names = nullptr) {
  if (!given) return;
  value = *given;
  if (names) names->emplace_back(name);
}

template <class E>
void take_word(const std::optional<std::string>& given, std::optional<E>& value, const char* name) {
  if (given) value = enum_named<E>(name, *given);
}

/// The limits of the tool's options.
template <class T>
void require_within(const std::optional<T>& given, T least, T most, const char* name) {
  if (given && !(*given >= least && *given <= most))
    throw Error(name, fmt::format("{} is not in {}..{}", *given, least, most));
}

/// A probe file to write, with the checkpoint of an interrupted bake beside it; empty: none.
std::string output_of(const py::object& output) {
  if (output.is_none()) return {};
  const std::string path = path_of(output);
  probes::probe_file_format(path);  // refused before any work
  return path;
}

using OptionalInt = std::optional<int>;
using OptionalFloat = std::optional<float>;
using OptionalWord = std::optional<std::string>;

ProbesHandle bake_probes(const LoadedScene& scene, const py::object& output, const py::object& probes,
                         int degree, const OptionalWord& op, const OptionalWord& quality, double max_memory,
                         std::uint64_t seed, OptionalInt face, OptionalInt max_depth, OptionalInt passes,
                         OptionalInt spp, const std::string& gen, const OptionalWord& viz,
                         OptionalInt neighbors, OptionalFloat threshold, const OptionalWord& viz_source,
                         const OptionalWord& viz_paths, OptionalInt viz_max_depth, OptionalInt viz_passes,
                         OptionalInt viz_spp, bool viz_transfer, OptionalInt directions,
                         OptionalFloat surfel_size, OptionalInt link_rays, OptionalInt records, bool fit,
                         float clearance, int refine, int max_probes, bool resume,
                         const py::object& progress) {
  BakeSettings o;
  if (quality) pipeline::set_effort(o, enum_named<bake::Quality>("quality", *quality));
  sh::require_degree(degree, "degree");
  require_within(neighbors, -1, 65536, "neighbors");
  require_within(records, 0, static_cast<int>(transport::most_records), "records");
  require_within(threshold, 0.0f, std::numeric_limits<float>::max(), "threshold");
  if (max_memory != 0) require_within(std::optional(max_memory), 0.01, 1e6, "max_memory");
  o.degree = degree;
  o.seed = seed;
  o.max_memory = max_memory;
  o.neighbors = neighbors;
  o.records = records;
  o.params.gen = enum_named<probes::GenMode>("gen", gen);
  o.params.viz_params.matrix = viz_transfer;
  o.transport.fit = fit;
  take_word(op, o.op, "operator");
  if (viz) o.viz = *viz == "off" ? probes::VizMethod::none : enum_named<probes::VizMethod>("viz", *viz);
  take(face, o.params.face_size, "face", &o.of_paths);
  take(max_depth, o.params.path.max_depth, "max_depth", &o.of_paths);
  take(passes, o.params.path.passes, "passes", &o.of_paths);
  take(spp, o.params.path.spp, "spp", &o.of_paths);
  take(directions, o.transport.transport.directions, "directions", &o.of_transport);
  take(surfel_size, o.transport.transport.surfel_size, "surfel_size", &o.of_transport);
  take(link_rays, o.transport.transport.link_rays, "link_rays", &o.of_transport);
  take(threshold, o.threshold, "threshold", &o.of_viz);
  if (neighbors) o.of_viz.emplace_back("neighbors");
  if (viz_source) {
    o.viz_source = enum_named<probes::VizSource>("viz_source", *viz_source);
    o.of_viz.emplace_back("viz_source");
  }
  if (viz_paths) {
    o.params.viz_params.paths = enum_named<rays::PathSet>("viz_paths", *viz_paths);
    o.of_viz_paths.emplace_back("viz_paths");
  }
  const auto note = [&](const OptionalInt& given, OptionalInt& value, const char* name) {
    value = given;
    if (given) o.of_viz_paths.emplace_back(name);
  };
  note(viz_max_depth, o.viz_max_depth, "viz_max_depth");
  note(viz_passes, o.viz_passes, "viz_passes");
  note(viz_spp, o.viz_spp, "viz_spp");
  const std::string path = output_of(output);
  const std::filesystem::path checkpoint = path.empty() ? "" : path + ".checkpoint";
  const pipeline::PlaceOptions places{places_in_words(probes), clearance, refine, max_probes};
  return run(progress, [&](const Control& control) {
    if (!resume && !path.empty()) pipeline::remove_checkpoint(checkpoint);
    const bool tiles = probes::is_tile_folder(path);
    if (tiles) o.tiles = path;
    pipeline::SceneBake baked =
        pipeline::bake_scene(scene.geometry(), scene.scene(), scene.time(), places, o, checkpoint, control);
    if (tiles) baked.set = probes::read_probe_file(path);
    if (!path.empty() && !tiles) probes::write_probe_file(baked.set, path);
    if (!path.empty()) pipeline::remove_checkpoint(checkpoint);
    return std::make_shared<probes::ProbeSet>(std::move(baked.set));
  });
}

}  // namespace

void add_bake(py::module_& m) {
  const py::none none;
  m.def("bake", &bake_probes,
        "Finds the light at every probe of a scene, as `ssphh bake` does, to the same bits.", "scene"_a,
        "output"_a = none, py::kw_only(), "probes"_a = none, "degree"_a = 9, "operator"_a = none,
        "quality"_a = none, "max_memory"_a = 0.0, "seed"_a = 0, "face"_a = none, "max_depth"_a = none,
        "passes"_a = none, "spp"_a = none, "gen"_a = name_of(probes::GenMode::full), "viz"_a = none,
        "neighbors"_a = none, "threshold"_a = none, "viz_source"_a = none, "viz_paths"_a = none,
        "viz_max_depth"_a = none, "viz_passes"_a = none, "viz_spp"_a = none, "viz_transfer"_a = false,
        "directions"_a = none, "surfel_size"_a = none, "link_rays"_a = none, "records"_a = none,
        "fit"_a = false, py::arg_v("clearance", 0.04f, "0.04"), "refine"_a = 1, "max_probes"_a = 65536,
        "resume"_a = true, "progress"_a = none);
}

}  // namespace ssphh::python
