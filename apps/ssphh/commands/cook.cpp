#include "commands/cook.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/file.h>
#include <ssphh/core/parallel.h>
#include <ssphh/runtime/runtime.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "options/probe_options.h"

namespace ssphh::app {
namespace {

void expect(ssphh_runtime_result result) {
  if (result != SSPHH_RUNTIME_OK) throw Error("cooked file", ssphh_runtime_message(result));
}

/// A cooked file, opened as a program does.
struct Opened {
  explicit Opened(const std::vector<std::byte>& bytes) {
    expect(ssphh_runtime_size_needed(bytes.data(), bytes.size(), &size));
    memory.resize(size);
    expect(ssphh_runtime_open(bytes.data(), bytes.size(), memory.data(), size, &runtime));
  }
  std::vector<std::byte> memory;
  std::size_t size = 0;
  ssphh_runtime* runtime = nullptr;
};

double grey(const vec3& v) {
  return (static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z)) / 3;
}

/// Looks all places up in one batch, on one thread.
double microseconds_each(const ssphh_runtime* runtime, unsigned flags,
                         const std::vector<rays::SurfacePoint>& points, std::vector<vec3>& light) {
  std::vector<ssphh_runtime_place> places;
  for (const auto& [x, n, moves] : points) places.push_back({{x.x, x.y, x.z}, {n.x, n.y, n.z}});
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    expect(ssphh_runtime_irradiance_batch(runtime, flags, places.data(), places.size(), &light[0].x));
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    best = std::min(best, took.count());
  }
  return best / static_cast<double>(points.size());
}

CookAgreement compare(const ssphh_runtime* runtime, unsigned flags, const probes::IrradianceLookup& full,
                      const std::vector<rays::SurfacePoint>& points) {
  CookAgreement agreement{points.size()};
  if (points.empty()) return agreement;
  std::vector<vec3> truth(points.size()), cooked(points.size());
  parallel_for(points.size(), 16, [&](std::size_t i) { truth[i] = full.irradiance(points[i]); });
  agreement.microseconds = microseconds_each(runtime, flags, points, cooked);
  double sum = 0, sum_cooked = 0;
  std::vector<double> differences;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += grey(truth[i]);
    sum_cooked += grey(cooked[i]);
    differences.push_back(grey(glm::abs(cooked[i] - truth[i])));
  }
  if (!(sum > 0)) return agreement;
  std::ranges::sort(differences);
  const double mean = sum / static_cast<double>(points.size());
  const auto share = [&](std::size_t percent) {
    return differences[differences.size() * percent / 100] / mean;
  };
  agreement.ratio = sum_cooked / sum;
  for (const double d : differences) agreement.mean += d / sum;
  agreement.half = share(50), agreement.p90 = share(90), agreement.p99 = share(99);
  return agreement;
}

}  // namespace

CookResult run_cook(const CookOptions& o, const Control& control) {
  if (!o.output.ends_with(".sphlc"))
    throw Error(o.output, "a cooked file is named .sphlc", "write -o NAME.sphlc");
  const probes::ProbeSet set = probes::read_probe_file(o.input);
  cook::CookParams params = o.params;
  std::optional<probes::ProbeSet> places;
  if (!o.places_of.empty()) {
    if (o.scene.source.empty()) throw Error("--places-of", "needs --scene");
    places = probes::read_probe_file(o.places_of);
    params.places = &*places;
  }
  CookResult result;
  result.probe_file_bytes = std::filesystem::file_size(o.input);
  result.probes = set.probes.size();
  for (const probes::LightGroup& group : set.light_groups) result.groups.push_back(group.name);
  if (o.scene.source.empty()) {
    result.cooked = cook::cook(set, nullptr, params, control);
    result.memory = Opened(result.cooked.bytes).size;
  } else {
    const scene::Scene scene = load_lit_scene(o.scene);
    const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
    const trace::TransportScene rays(geometry, scene);
    require_same_scene(o.input, set, scene, rays.light_groups(), {}, o.force);
    const cook::CookScene cook_scene{scene, rays};
    result.cooked = cook::cook(set, &cook_scene, params, control);
    const Opened opened(result.cooked.bytes);
    result.memory = opened.size;
    if (o.points > 0) {
      const float time = set.generator.time;
      const trace::PathTracer tracer(geometry, scene, time);
      const probes::IrradianceLookup full(set, tracer);
      const std::vector<rays::SurfacePoint> points = study::reachable_points(
          rays, viewpoints(scene, rays, {&set, 1}, time), time, {o.points, o.seed}, control);
      result.on_surfaces = compare(opened.runtime, SSPHH_RUNTIME_STILL, full, points);
      std::vector<rays::SurfacePoint> open = study::points_in_the_open(rays, points, time, o.seed);
      for (rays::SurfacePoint& point : open) point.moves = true;
      result.in_the_open = compare(opened.runtime, SSPHH_RUNTIME_OPEN, full, open);
    }
  }
  result.bytes = result.cooked.bytes.size();
  write_file(o.output, result.cooked.bytes);
  result.cooked.bytes = {};
  return result;
}

json::Value to_json(const CookResult& r, const CookOptions& o) {
  json::Value object = {{"output", o.output},
                        {"bytes", r.bytes},
                        {"probe_file_bytes", r.probe_file_bytes},
                        {"memory", r.memory},
                        {"groups", r.groups},
                        {"probes", r.probes},
                        {"points", r.cooked.points},
                        {"cells", r.cooked.cells},
                        {"entries", r.cooked.entries},
                        {"light_bytes", r.cooked.light_bytes},
                        {"list_bytes", r.cooked.list_bytes},
                        {"sight_bytes", r.cooked.sight_bytes},
                        {"lost", r.cooked.lost}};
  const auto agreement = [&](const char* name, const std::optional<CookAgreement>& a) {
    if (a)
      object[name] = {{"points", a->points},
                      {"ratio", a->ratio},
                      {"mean", a->mean},
                      {"half", a->half},
                      {"p90", a->p90},
                      {"p99", a->p99},
                      {"microseconds", a->microseconds}};
  };
  agreement("on_surfaces", r.on_surfaces), agreement("in_the_open", r.in_the_open);
  return object;
}

std::string to_text(const CookResult& r, const CookOptions& o) {
  std::string text = fmt::format(
      "{}: {} bytes (probe file {}): light {}, lists {}, sight {}\n"
      "groups       {}\n"
      "probes       {}\n"
      "surfaces     {} points in {} cells\n"
      "memory       {} bytes to open it",
      o.output, r.bytes, r.probe_file_bytes, r.cooked.light_bytes, r.cooked.list_bytes, r.cooked.sight_bytes,
      fmt::join(r.groups, ", "), r.probes, r.cooked.points, r.cooked.cells, r.memory);
  const auto agreement = [&](const char* name, const std::optional<CookAgreement>& a) {
    if (a && a->points > 0)
      text += fmt::format(
          "\n{}  ratio {:.4f}, differences {:.2g} % in the mean, half within {:.2g}, 90 % within {:.2g}, 99 "
          "% within "
          "{:.2g} %; {:.2f} us a lookup",
          name, a->ratio, 100 * a->mean, 100 * a->half, 100 * a->p90, 100 * a->p99, a->microseconds);
  };
  if (r.on_surfaces) text += "\nagainst the full lookup, which sends rays, in shares of its mean irradiance";
  agreement("on surfaces", r.on_surfaces), agreement("in the open", r.in_the_open);
  for (const std::string& line : r.cooked.lost) text += "\nnot carried: " + line;
  return text;
}

void add_cook_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "cook", "Write a probe file's light for a shipped program", run_cook);
  add_probe_file(command, "FILE", o.input, "Probe file").required();
  add_scene_options(command, o.scene, false, "--scene");
  command["--scene"].required(false);
  command.option("-o,--output", o.output, "Cooked file to write: .sphlc").required();
  command
      .option("--sight", o.params.sight_size,
              "Texels of a side of the six faces by which a probe is known to be hidden; 0: all are seen")
      .range(0, 256);
  add_probe_file(
      command, "--places-of", o.places_of,
      "Take the points of surfaces from this probe file, so that its cooked file's light can be swapped for "
      "this one's");
  command
      .option(
          "--points", o.points,
          "Compare the file with the full lookup at so many places on surfaces and in the open; 0: do not")
      .range(0, 1 << 20);
  add_force_option(command, o.force);
  command.footer(
      "The library ssphh::runtime looks the file up in place, without rays: docs/cooked-files.md. What hides "
      "what\n"
      "is that of --scene in the pose of the bake.");
}

}  // namespace ssphh::app
