#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/type_ptr.hpp>

#include <ssphh/core/stopwatch.h>
#include <ssphh/image/io.h>
#include <ssphh/lightmap/light.h>
#include <ssphh/lightmap/lit_scene.h>
#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/render_scene.h>
#include <ssphh/pipeline/surface_light.h>
#include <ssphh/probe_export/target.h>
#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf_export.h>

#include "commands/web.h"
#include "commands/web_lamps.h"
#include "commands/web_stage.h"
#include "options/probe_options.h"
#include "results/lit_atlas.h"
#include "results/pictures.h"
#include "results/web_folder.h"

namespace ssphh::app {
namespace {

/// What a page may take of a graphics card for its lightmaps, 4 bytes a texel.
constexpr double most_bytes = double{512} * 1024 * 1024;
constexpr int usual_poses = 5;
/// Texels per metre under which a wall may be thinner than one.
constexpr float coarse_density = 8;

struct PageView {
  std::string name;
  scene::CameraPose pose;
  float exposure = 0;
  std::string truth;  ///< file; empty: none
};

/// Perspective cameras, or the view of a scene without any.
std::vector<PageView> views_of(const WebOptions& o, const scene::Scene& scene,
                               std::vector<std::string>& notes) {
  std::vector<PageView> views;
  std::size_t orthographic = 0;
  for (const scene::Camera& camera : scene.cameras) {
    if (camera.orthographic) {
      ++orthographic;
      continue;
    }
    const mat4 world = scene::world_matrix(scene, camera.node, o.scene.time);
    views.push_back({camera.name.empty() ? fmt::format("camera {}", views.size() + 1) : camera.name,
                     {world, camera},
                     0,
                     ""});
  }
  if (orthographic > 0)
    notes.push_back(
        fmt::format("{} orthographic cameras are left out: the page's are perspective", orthographic));
  for (const std::string& wanted : o.cameras) {
    if (std::ranges::find(views, wanted, &PageView::name) != views.end()) continue;
    std::vector<std::string> names;
    for (const PageView& view : views) names.push_back(view.name);
    throw Error("--truth-cameras " + wanted, "is no camera of the scene",
                names.empty() ? "it has none: leave the option out"
                              : fmt::format("there are {}", fmt::join(names, ", ")));
  }
  return views;
}

struct PageGroup {
  std::string name;
  std::vector<std::string> light_groups;  ///< that it holds
  std::vector<std::string> textures;      ///< a file for each pose
};

/// The page lets a glossy surface mirror the mean of its hemisphere, E/π. A lamp is not in the mean: a smooth
/// metal shows it at one spot, so that its E holds so much of direct light.
float direct_share(const scene::Scene& scene, const scene::Instance& instance) {
  const int index = scene::instance_material(scene, instance);
  if (index < 0) return 1;
  const scene::Material& material = scene.materials[index];
  float metallic = material.metallic, roughness = std::abs(material.specular_roughness);
  if (const int t = material.metallic_roughness_texture.texture; t >= 0 && metallic > 0) {
    const std::vector<std::uint8_t>& texels = scene.textures[t].rgba;
    double green = 0, blue = 0;
    for (std::size_t i = 0; i + 3 < texels.size(); i += 4) green += texels[i + 1], blue += texels[i + 2];
    const double whole = 255.0 * static_cast<double>(texels.size()) / 4;
    roughness *= static_cast<float>(green / whole), metallic *= static_cast<float>(blue / whole);
  }
  return 1 - metallic * (1 - roughness * roughness);
}

/// Of each chart.
std::vector<float> direct_shares(const scene::Scene& scene, std::span<const lightmap::Chart> charts) {
  std::vector<float> shares;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const bool known = i > 0 && charts[i].instance == charts[i - 1].instance;
    shares.push_back(known ? shares.back() : direct_share(scene, scene.instances[charts[i].instance]));
  }
  return shares;
}

/// Where a chart takes a share of direct light, that much of `all` over what is without it.
void blend_charts(image::Image& all, const image::Image& without, std::span<const float> shares,
                  std::span<const lightmap::PlacedChart> places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (shares[i] >= 1) continue;
    const glm::ivec2 low = places[i].first - lightmap::gutter;
    const glm::ivec2 high = places[i].first + places[i].count + lightmap::gutter;
    for (int y = std::max(0, low.y); y < std::min(all.height, high.y); ++y)
      for (int x = std::max(0, low.x); x < std::min(all.width, high.x); ++x)
        all.set_rgb(x, y, glm::mix(without.rgb(x, y), all.rgb(x, y), shares[i]));
  }
}

/// Adds the lightmaps of a time.
void add_pose(const LitStage& stage, const probes::ProbeSet& set, float time, std::vector<PageGroup>& groups,
              std::vector<FolderFile>& files, const Control& control) {
  const WebOptions& o = stage.options;
  const trace::TransportScene& source = stage.source;
  const trace::PathTracer tracer(stage.geometry, stage.scene, time);
  const lightmap::Texels texels =
      lightmap::make_texels(stage.plan.scene, time, stage.plan.charts.charts, stage.plan.layout, control);
  const lightmap::Places places = lightmap::find_places(texels, rays::PosedWorld(source, time), control);
  const std::vector<float> shares = direct_shares(stage.scene, stage.plan.charts.charts);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    PageGroup& group = groups[g];
    const probes::ProbeSet lit = o.merge_groups ? set : probe_export::only_group(set, group.name);
    const auto atlas_of = [&](int direct_samples) {
      const pipeline::SurfaceLight light(source, tracer, lit, lookup_params(o.probes, lit, {}), time);
      return lit_atlas(light, texels, places, direct_samples, 1, control);
    };
    image::Image atlas = atlas_of(o.direct_samples);
    if (std::ranges::any_of(shares, [](float share) { return share < 1; }))
      blend_charts(atlas, atlas_of(0), shares, stage.plan.layout.places);
    files.push_back(
        hashed_file(fmt::format("light-{}-{}", g, group.textures.size()), "bin", packed_light(atlas)));
    group.textures.push_back(files.back().name);
  }
}

std::vector<PageGroup> page_groups(const WebOptions& o, const probes::ProbeSet& set) {
  std::vector<std::string> names;
  for (const probes::LightGroup& group : set.light_groups) names.push_back(group.name);
  if (o.merge_groups) return {{"all lights", names, {}}};
  std::vector<PageGroup> groups;
  for (const std::string& name : names) groups.push_back({name, {name}, {}});
  return groups;
}

void check_size(const WebOptions& o, std::size_t groups, std::size_t poses, const lightmap::Layout& layout) {
  const double bytes = 4.0 * layout.width * layout.height * static_cast<double>(groups * poses);
  if (bytes <= most_bytes) return;
  throw Error(
      "--output " + o.output,
      fmt::format("{} light groups in {} poses of {} × {} texels take {:.0f} MB of a graphics card, and "
                  "{:.0f} MB is the most",
                  groups, poses, layout.width, layout.height, bytes / 1e6, most_bytes / 1e6),
      "give a lower --size, fewer --poses, or --merge-groups");
}

std::vector<float> pose_times(const WebOptions& o, const scene::Scene& scene,
                              std::vector<std::string>& notes) {
  const float end = scene::animation_duration(scene);
  if (!o.probes.empty() && o.poses.value_or(1) > 1)
    throw Error("--poses", "a probe file holds the light of one pose",
                "leave out --probes: each pose is baked");
  const int count = end > 0 && o.probes.empty() ? o.poses.value_or(usual_poses) : 1;
  if (end <= 0 && o.poses.value_or(1) > 1) notes.push_back("nothing moves: --poses has nothing to do");
  if (count == 1) return {o.scene.time};
  std::vector<float> times;
  for (int k = 0; k < count; ++k)
    times.push_back(end * static_cast<float>(k) / static_cast<float>(count - 1));
  return times;
}

/// A small picture tells the exposure, unless a truth is made or one was asked for.
void take_pictures(const LitStage& stage, const probes::ProbeSet& set, std::vector<PageView>& views,
                   std::vector<FolderFile>& files, const Control& control) {
  const WebOptions& o = stage.options;
  const auto picture = [&](const PageView& view, int width, int height, int spp, const char* method) {
    trace::RenderParams params;
    params.width = width, params.height = height;
    params.camera = view.pose;
    params.path.spp = spp, params.path.seed = o.seed;
    trace::RenderState state;
    const bool paths = std::string_view(method) == "path";
    pipeline::render_scene(stage.geometry, stage.scene, o.scene.time,
                           {.method = method, .probes = paths ? nullptr : &set, .probes_name = o.probes},
                           params, state, control);
    return trace::resolve(state.color, state.passes_done);
  };
  for (std::size_t i = 0; i < views.size(); ++i) {
    PageView& view = views[i];
    SharedExposure exposure(o.exposure, o.tonemap);
    const bool truth =
        o.truth && (o.cameras.empty() || std::ranges::find(o.cameras, view.name) != o.cameras.end());
    if (truth) {
      const image::Image image = picture(view, o.width, o.height, *o.truth, "path");
      view.exposure = exposure.of(image);
      const image::ToneMap map{.exposure = view.exposure, .curve = o.tonemap};
      files.push_back(
          hashed_file(fmt::format("truth-{}", i), "png", image::encode_png(image::tone_map(image, map))));
      view.truth = files.back().name;
    } else {
      view.exposure = o.exposure ? *o.exposure : exposure.of(picture(view, 160, 90, 16, "ssphh"));
    }
  }
}

json::Value views_json(const WebOptions& o, const std::vector<PageView>& views) {
  json::Value list = json::Value::array();
  for (const PageView& view : views) {
    json::Value entry = {{"name", view.name},
                         {"world", json::Value(std::span(glm::value_ptr(view.pose.world), 16))},
                         {"yfov", view.pose.camera.yfov},
                         {"exposure", view.exposure}};
    if (!view.truth.empty())
      entry["truth"] = {
          {"file", view.truth}, {"width", o.width}, {"height", o.height}, {"samples", *o.truth}};
    list.push_back(std::move(entry));
  }
  return list;
}

json::Value light_json(const lightmap::Layout& layout, const std::vector<PageGroup>& groups) {
  json::Value list = json::Value::array();
  for (const PageGroup& group : groups) {
    list.push_back({{"name", group.name},
                    {"light_groups", json::Value(group.light_groups)},
                    {"textures", json::Value(group.textures)}});
  }
  json::Value out = json::Value::object();
  out["width"] = layout.width, out["height"] = layout.height;
  out["groups"] = std::move(list);
  return out;
}

std::string title_of(const WebOptions& o) {
  const std::string& source = o.scene.source;
  return source.starts_with("builtin:") ? source.substr(8) : std::filesystem::path(source).stem().string();
}

/// The scene as the page reads it: every emitter with the name of its group.
scene::Scene named_emitters(scene::Scene scene) {
  for (scene::Instance& instance : scene.instances) {
    const int material = scene::instance_material(scene, instance);
    if (material >= 0 && scene.materials[material].emissive())
      instance.light_group = scene::light_group(scene, instance);
  }
  for (scene::Light& light : scene.lights) light.group = scene::light_group(light);
  return scene;
}

}  // namespace

std::string page_folder() {
  std::error_code failed;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  return (program.parent_path().parent_path() / "share/ssphh/web").string();
}

WebResult run_web(const WebOptions& o, const Control& control) {
  const Stopwatch all;
  // What cannot be is said before anything long begins.
  std::vector<FolderFile> files = read_page(o.page.empty() ? page_folder() : o.page);
  check_folder(o.output, o.replace);
  WebResult result;
  const scene::Scene scene = load_lit_scene(o.scene);
  std::vector<PageView> views = views_of(o, scene, result.notes);
  result.times = pose_times(o, scene, result.notes);
  lightmap::ChartParams params = o.charts;
  params.moving = true;
  const lightmap::Plan plan = lightmap::plan_lightmap(scene, o.scene.time, params, o.layout, control);
  const lightmap::Layout& layout = plan.layout;
  check_size(o, o.merge_groups ? 1 : scene::light_groups(scene).size(), result.times.size(), layout);

  std::vector<FolderFile> made;
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const LitStage stage{o, scene, geometry, trace::TransportScene(geometry, scene), plan};
  WebLamps lamps = find_web_lamps(stage, result.times, made, control);
  if (views.empty())
    views.push_back({"view", pipeline::camera_of(scene, "", o.scene.time, stage.geometry), 0, ""});
  std::vector<PageGroup> groups;
  probes::ProbeSet shown;  // of the pose nearest to --time
  float away = INFINITY;
  for (const float time : result.times) {
    const Stopwatch bake;
    probes::ProbeSet set =
        o.probes.empty() ? pipeline::bake_surfaces(stage.geometry, scene, time, o.quality, o.seed, control)
                         : read_probes_of(scene, o.probes, time, o.force);
    result.bake_seconds += bake.seconds();
    if (groups.empty()) groups = page_groups(o, set);
    add_pose(stage, set, time, groups, made, control);
    const Stopwatch moving;
    add_lamp_pose(stage, set, time, lamps, made, control);
    result.lamp_seconds += moving.seconds();
    if (std::abs(time - o.scene.time) < away) away = std::abs(time - o.scene.time), shown = std::move(set);
  }
  take_pictures(stage, shown, views, made, control);
  FolderFile glb =
      hashed_file("scene", "glb",
                  scene_io::export_glb(named_emitters(scene::area_lamps_as_meshes(
                      lightmap::with_lightmap(plan.scene, plan.charts.charts, layout), o.scene.time))));

  json::Value manifest = json::Value::object();
  manifest["format"] = "ssphh-web", manifest["version"] = 1;
  manifest["title"] = title_of(o);
  manifest["scene"] = glb.name;
  manifest["tone_curve"] = name_of(o.tonemap);
  manifest["time"] = o.scene.time;
  manifest["times"] = json::Value(result.times);
  manifest["cameras"] = views_json(o, views);
  manifest["lightmap"] = light_json(layout, groups);
  if (!lamps.lamps.empty()) manifest["movable"] = to_json(lamps);
  if (scene.environment) manifest["environment_group"] = scene::light_group(*scene.environment);
  files.push_back(std::move(glb));
  for (FolderFile& file : made) files.push_back(std::move(file));
  json::Value list = json::Value::array();
  for (const FolderFile& file : files) {
    list.push_back({{"name", file.name}, {"bytes", file.data.size()}});
    result.files.push_back({file.name, file.data.size()});
  }
  manifest["files"] = std::move(list);
  const std::string text = json::print(manifest) + "\n";
  const auto bytes = std::as_bytes(std::span(text));
  files.push_back({web_manifest, {bytes.begin(), bytes.end()}});
  result.files.push_back({web_manifest, text.size()});
  control.check();
  write_folder(o.output, files, o.replace);

  for (const WebFile& file : result.files) result.bytes += file.bytes;
  for (const PageView& view : views) result.cameras.push_back(view.name);
  for (const PageGroup& group : groups) result.groups.push_back(group.name);
  for (const WebLamp& lamp : lamps.lamps) result.movable.push_back({lamp.name, lamp.lattice.places.size()});
  result.width = layout.width, result.height = layout.height, result.density = layout.density;
  if (layout.density < coarse_density)
    result.notes.push_back(fmt::format(
        "{:.2g} texels per metre: shadows are blurred over {:.2g} m, and light leaks through walls "
        "that are thinner; give a higher --size",
        layout.density, 1 / layout.density));
  if (!o.movable.empty() && lamps.lamps.empty())
    result.notes.push_back("no lamp of the scene can be dragged: --movable all has nothing to do");
  result.notes.insert(result.notes.end(), plan.charts.notes.begin(), plan.charts.notes.end());
  result.seconds = all.seconds() - result.bake_seconds - result.lamp_seconds;
  return result;
}

}  // namespace ssphh::app
