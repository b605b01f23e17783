#include "commands/lightmap.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/file.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/image/io.h>
#include <ssphh/image/ktx2.h>
#include <ssphh/lightmap/encode.h>
#include <ssphh/lightmap/light.h>
#include <ssphh/lightmap/lit_scene.h>
#include <ssphh/lightmap/plan.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/surface_light.h>
#include <ssphh/probe_export/target.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "options/probe_options.h"
#include "results/lit_atlas.h"
#include "results/pictures.h"

namespace ssphh::app {
namespace {

/// What textures are made of.
struct Baked {
  const LightmapOptions& options;
  const scene::Scene& scene;
  const trace::TransportScene& source;
  const trace::PathTracer& tracer;
  const lightmap::Texels& texels;
  const lightmap::Places& places;
};

image::Image atlas_of(const Baked& b, const probes::ProbeSet& set, LightmapResult& result,
                      const Control& control) {
  const LightmapOptions& o = b.options;
  const pipeline::SurfaceLight light(b.source, b.tracer, set, lookup_params(o.probes, set, {}), o.scene.time);
  result.direct_groups = o.direct ? b.source.light_groups() : light.held_groups();
  return lit_atlas(light, b.texels, b.places, o.direct ? o.direct_samples : 0, o.divide_by_pi ? 1 / pi : 1,
                   control);
}

/// Encodes first and writes then: what cannot be written leaves nothing.
struct Encoded {
  LightmapFiles names;
  std::vector<std::byte> exr, ktx2, rgbm;
};

Encoded encoded(const image::Image& atlas, const lightmap::Texels& texels, const std::string& stem) {
  const lightmap::Rgbm rgbm = lightmap::encode_rgbm(atlas);
  Encoded out{{"", stem + ".exr", stem + ".ktx2", stem + ".rgbm.png", rgbm.scale},
              image::encode_half_exr(atlas),
              image::encode_ktx2(atlas),
              image::encode_png(rgbm.picture)};
  glm::dvec3 sum(0);
  for (const lightmap::Texel& t : texels.texels) {
    const auto w = static_cast<std::uint32_t>(atlas.width);
    sum += atlas.rgb(static_cast<int>(t.index % w), static_cast<int>(t.index / w));
  }
  out.names.mean = vec3(sum / static_cast<double>(texels.texels.size()));
  return out;
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// extras.ssphh.lightmap of the glTF scene.
json::Value extras_of(const LightmapResult& result, const LightmapOptions& o) {
  json::Value textures = json::Value::array();
  for (const LightmapFiles& files : result.files) {
    json::Value texture = json::Value::object();
    if (!files.group.empty()) texture["light_group"] = files.group;
    texture["exr"] = file_name(files.exr);
    texture["ktx2"] = file_name(files.ktx2);
    texture["rgbm"] = file_name(files.rgbm);
    texture["rgbm_scale"] = files.rgbm_scale;
    textures.push_back(std::move(texture));
  }
  json::Value map = json::Value::object();
  map["version"] = 1;
  map["uv_set"] = 1;
  map["holds"] = o.divide_by_pi ? "irradiance/pi" : "irradiance";
  map["width"] = result.width, map["height"] = result.height;
  map["texels_per_metre"] = result.density;
  map["direct_light_of"] = result.direct_groups;
  map["textures"] = std::move(textures);
  json::Value extras = json::Value::object();
  extras["lightmap"] = std::move(map);
  return extras;
}

std::size_t surface_count(const std::vector<lightmap::Chart>& charts) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < charts.size(); ++i)
    count += i == 0 || charts[i].instance != charts[i - 1].instance;
  return count;
}

}  // namespace

LightmapResult run_lightmap(const LightmapOptions& o, const Control& control) {
  if (!o.output.ends_with(".glb"))
    throw Error("--output " + o.output, "is not the name of a GLB file", "write OUT.glb");
  const std::string stem = o.output.substr(0, o.output.size() - 4) + ".lightmap";
  const Stopwatch all;
  const scene::Scene scene = load_lit_scene(o.scene);
  LightmapResult result;
  // What does not fit is known before anything long begins.
  lightmap::Plan plan = lightmap::plan_lightmap(scene, o.scene.time, o.charts, o.layout, control);
  const lightmap::Charts& charts = plan.charts;
  const lightmap::Layout& layout = plan.layout;
  result.surfaces = surface_count(charts.charts), result.charts = charts.charts.size();
  result.width = layout.width, result.height = layout.height, result.density = layout.density;
  result.notes = charts.notes;

  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const trace::TransportScene source(geometry, scene);
  const trace::PathTracer tracer(geometry, scene, o.scene.time);
  const Stopwatch bake;
  const probes::ProbeSet set =
      o.probes.empty() ? pipeline::bake_surfaces(geometry, scene, o.scene.time, o.quality, o.seed, control)
                       : read_probes_of(scene, o.probes, o.scene.time, o.force);
  result.bake_seconds = bake.seconds();
  if (!probes::has_records(set, lookup_params(o.probes, set, {})))
    result.notes.push_back(
        "the probe file holds no surface records: light is the probes', as away from surfaces");

  const lightmap::Texels texels =
      lightmap::make_texels(plan.scene, o.scene.time, charts.charts, layout, control);
  const lightmap::Places places =
      lightmap::find_places(texels, rays::PosedWorld(source, o.scene.time), control);
  result.texels = texels.texels.size(), result.hidden = places.hidden_count;

  const Baked parts{o, scene, source, tracer, texels, places};
  std::vector<Encoded> textures;
  if (o.groups) {
    std::vector<std::string> names;
    for (const probes::LightGroup& group : set.light_groups) names.push_back(group.name);
    const std::vector<std::string> ends = file_parts(names);
    for (std::size_t g = 0; g < names.size(); ++g) {
      const image::Image atlas = atlas_of(parts, probe_export::only_group(set, names[g]), result, control);
      textures.push_back(encoded(atlas, texels, stem + "-" + ends[g]));
      textures.back().names.group = names[g];
    }
  } else {
    textures.push_back(encoded(atlas_of(parts, set, result, control), texels, stem));
  }
  for (const Encoded& texture : textures) result.files.push_back(texture.names);
  const std::vector<std::byte> glb = scene_io::export_glb(
      lightmap::with_lightmap(std::move(plan.scene), charts.charts, layout), extras_of(result, o));
  for (const Encoded& texture : textures) {
    write_file(texture.names.exr, texture.exr);
    write_file(texture.names.ktx2, texture.ktx2);
    write_file(texture.names.rgbm, texture.rgbm);
  }
  write_file(o.output, glb);
  result.seconds = all.seconds() - result.bake_seconds;
  return result;
}

json::Value to_json(const LightmapResult& r, const LightmapOptions& o) {
  json::Value files = json::Value::array();
  for (const LightmapFiles& f : r.files) {
    files.push_back({{"light_group", f.group.empty() ? json::Value() : json::Value(f.group)},
                     {"exr", f.exr},
                     {"ktx2", f.ktx2},
                     {"rgbm", f.rgbm},
                     {"rgbm_scale", f.rgbm_scale},
                     {"mean", std::array{f.mean.x, f.mean.y, f.mean.z}}});
  }
  return {{"output", o.output},
          {"surfaces", r.surfaces},
          {"charts", r.charts},
          {"texels", r.texels},
          {"hidden", r.hidden},
          {"width", r.width},
          {"height", r.height},
          {"texels_per_metre", r.density},
          {"holds", o.divide_by_pi ? "irradiance/pi" : "irradiance"},
          {"direct_light_of", r.direct_groups},
          {"textures", std::move(files)},
          {"bake_seconds", r.bake_seconds},
          {"seconds", r.seconds},
          {"notes", r.notes}};
}

std::string to_text(const LightmapResult& r, const LightmapOptions& o) {
  std::string text = fmt::format(
      "{}: {} in {}, {} × {} texels, {:.3g} per metre\n{} texels lit, {} of them within or under other "
      "bodies "
      "(light of neighbours)",
      o.output, counted(r.surfaces, "surface"), counted(r.charts, "chart"), r.width, r.height, r.density,
      r.texels, r.hidden);
  for (const LightmapFiles& f : r.files)
    text += fmt::format("\n{} .ktx2 .rgbm.png: {}mean {:.4g} {:.4g} {:.4g}", f.exr,
                        f.group.empty() ? "" : f.group + ", ", f.mean.x, f.mean.y, f.mean.z);
  text += fmt::format("\nholds {}: {}", o.divide_by_pi ? "irradiance / π" : "irradiance",
                      o.direct ? "direct and indirect light" : "indirect light");
  if (!o.direct && !r.direct_groups.empty())
    text += fmt::format(", and direct light of {}", fmt::join(r.direct_groups, ", "));
  text += o.probes.empty()
              ? fmt::format("\nlight baked in {:.1f} s, the rest took {:.1f} s", r.bake_seconds, r.seconds)
              : fmt::format("\n{:.1f} s", r.seconds);
  for (const std::string& note : r.notes) text += "\nnote: " + note;
  return text;
}

void add_lightmap_command(Command app, Context& context) {
  auto [command, o] = add_command(app, context, "lightmap",
                                  "Write the light of still surfaces as textures, and the scene with their "
                                  "coordinates as GLB",
                                  run_lightmap);
  add_scene_options(command, o.scene);
  const Option probes =
      add_probe_file(command, "--probes", o.probes,
                     "Probe file whose light is taken. Default: it is baked first, by surfels");
  command.choice("--quality", o.quality, "Of that bake: draft, good or best").excludes(probes);
  command
      .option("-o,--output", o.output,
              "GLB file to write; OUT.lightmap.exr, .ktx2 and .rgbm.png come beside it")
      .required();
  command
      .option(
          "--size", o.layout.size,
          "Texels along the atlas' width, and the most along its height. Default: 1024, or as far as 4096 "
          "for 8 texels a metre, or what --texels-per-metre needs")
      .range(16, lightmap::most_size);
  command.option("--texels-per-metre", o.layout.density, "Default: as many as fit").range(1e-3, 1e6);
  command.choice(
      "--uvs", o.charts.uvs,
      "Charts: own (made by planes and normals), scene (islands of the second texture coordinates, "
      "an error where they overlap or leave 0 to 1), auto (scene where these are fit)");
  command.flag("--groups", o.groups, "A texture for each light group, OUT.lightmap-GROUP");
  const Option direct = command.flag("--direct", o.direct, "With light straight from emitters");
  command.option("--direct-samples", o.direct_samples, "Rays to each emitter with an extent, per texel")
      .range(1, 1 << 16)
      .needs(direct);
  command.flag(
      "--divide-by-pi", o.divide_by_pi,
      "Write E/π, what a white surface sends out, in place of irradiance E: for engines that multiply "
      "with the colour alone");
  add_force_option(command, o.force);
  command.footer(
      "Only indirect light is written, unless --direct or a light group's mode says otherwise. The textures "
      "are "
      "the\n"
      "same light three times: half floats as OpenEXR and KTX2, and RGBM, scale (8 a rgb)^2, as PNG.");
}

}  // namespace ssphh::app
