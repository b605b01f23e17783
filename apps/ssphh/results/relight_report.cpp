#include "results/relight_report.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include <ssphh/core/file.h>

#include "results/lookup_figures.h"
#include "results/percentile.h"

namespace ssphh::app {
namespace {

using transport::RelightReport;
using Value = std::function<double(const RelightReport&)>;

constexpr std::pair<const char*, double RelightReport::*> stages[] = {
    {"pose", &RelightReport::pose_ms},
    {"direct", &RelightReport::direct_ms},
    {"solve", &RelightReport::solve_ms},
    {"project", &RelightReport::project_ms}};

/// Of all frames but the first, which lights everything; of that one if there is no other.
std::vector<double> of_frames(const RelightRun& run, const Value& value) {
  std::vector<double> values;
  for (std::size_t i = run.updates.size() > 1 ? 1 : 0; i < run.updates.size(); ++i)
    values.push_back(value(run.updates[i]));
  return values;
}

double mean(const RelightRun& run, const Value& value) {
  const std::vector<double> values = of_frames(run, value);
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

std::size_t over_budget(const RelightRun& run) {
  const std::vector<double> times = of_frames(run, &RelightReport::total_ms);
  return static_cast<std::size_t>(
      std::ranges::count_if(times, [&](double ms) { return ms > 1000 / run.fps; }));
}

/// Mean and largest of the frames' mean errors, and the frame of the largest.
struct KeyedError {
  double mean = 0, most = 0;
  int worst = 0;
};

KeyedError keyed_error(const KeyedRun& keyed) {
  KeyedError result;
  for (const FrameError& e : keyed.errors) {
    const double error = study::worst_channel(e.error).mean_relative;
    result.mean += error / static_cast<double>(keyed.errors.size());
    if (error > result.most) result.most = error, result.worst = e.frame;
  }
  return result;
}

json::Value keyed_json(const KeyedRun& keyed) {
  json::Value frames = json::Value::array();
  for (const FrameError& e : keyed.errors)
    frames.push_back({{"frame", e.frame}, {"mean_error", study::worst_channel(e.error).mean_relative}});
  const KeyedError error = keyed_error(keyed);
  return {{"keys", keyed.keys},
          {"find_ms", keyed.find_ms},
          {"blend_median_ms", percentile(keyed.blend_ms, 0.5)},
          {"mean_error", error.mean},
          {"most_error", error.most},
          {"worst_frame", error.worst},
          {"frames", std::move(frames)}};
}

}  // namespace

json::Value relight_json(const RelightRun& run) {
  json::Value stage_times = json::Value::object();
  for (const auto& [name, ms] : stages) {
    const std::vector<double> times = of_frames(run, ms);
    stage_times[name] = {{"median_ms", percentile(times, 0.5)}, {"p99_ms", percentile(times, 0.99)}};
  }
  stage_times["pose"]["rays"] = mean(run, &RelightReport::pose_rays);
  stage_times["direct"]["rays"] = mean(run, &RelightReport::direct_rays);
  stage_times["solve"]["iterations"] =
      mean(run, [](const transport::RelightReport& r) { return static_cast<double>(r.solve.iterations); });

  json::Value errors = json::Value::array();
  for (const FrameError& e : run.errors) {
    json::Value one = {{"frame", e.frame}, {"seconds", e.frame / run.fps}};
    one.update(to_json(e.error));
    errors.push_back(std::move(one));
  }
  json::Value frame_ms = json::Value::array();
  for (const transport::RelightReport& r : run.updates) frame_ms.push_back(r.total_ms());
  const std::vector<double> times = of_frames(run, &RelightReport::total_ms);
  const auto unconverged = std::ranges::count_if(
      run.updates, [](const transport::RelightReport& r) { return !r.solve.converged; });
  json::Value object = {
      {"frames", run.updates.size()},
      {"frames_asked", run.frames_asked},
      {"cancelled", run.cancelled},
      {"fps", run.fps},
      {"build_ms", run.build_ms},
      {"first_ms", run.updates.empty() ? 0 : run.updates.front().total_ms()},
      {"median_ms", percentile(times, 0.5)},
      {"p99_ms", percentile(times, 0.99)},
      {"over_budget", over_budget(run)},
      {"unconverged", unconverged},
      {"stages", std::move(stage_times)},
      {"rays_per_frame", mean(run, &RelightReport::pose_rays) + mean(run, &RelightReport::direct_rays)},
      {"frame_ms", std::move(frame_ms)},
      {"error", std::move(errors)}};
  if (run.keyed.keys > 0) object["keyed"] = keyed_json(run.keyed);
  return object;
}

std::string relight_text(const RelightRun& run) {
  std::string text = fmt::format("network built in {:.0f} ms, first frame {:.1f} ms\n", run.build_ms,
                                 run.updates.empty() ? 0 : run.updates.front().total_ms());
  text += fmt::format("{:<10}{:>12}{:>12}{:>14}", "stage", "median ms", "p99 ms", "rays a frame");
  for (const auto& [stage, ms] : stages) {
    const std::vector<double> times = of_frames(run, ms);
    const std::string name = stage;
    const double rays = name == "pose"     ? mean(run, &RelightReport::pose_rays)
                        : name == "direct" ? mean(run, &RelightReport::direct_rays)
                                           : 0;
    text += fmt::format("\n{:<10}{:>12.2f}{:>12.2f}", name, percentile(times, 0.5), percentile(times, 0.99));
    if (rays > 0) text += fmt::format("{:>14.0f}", rays);
  }
  const std::vector<double> times = of_frames(run, &RelightReport::total_ms);
  text += fmt::format("\n{:<10}{:>12.2f}{:>12.2f}{:>14.0f}", "frame", percentile(times, 0.5),
                      percentile(times, 0.99),
                      mean(run, &RelightReport::pose_rays) + mean(run, &RelightReport::direct_rays));
  text += fmt::format("\n{} of {} frames took longer than 1/{:g} s", over_budget(run), times.size(), run.fps);
  if (const KeyedRun& keyed = run.keyed; keyed.keys > 0) {
    const KeyedError error = keyed_error(keyed);
    text += fmt::format(
        "\n{} keys found in {:.0f} ms; blended in {:.2f} ms (median); against exact posing: mean error "
        "{:.2f} %, in "
        "the worst frame ({}) {:.2f} %",
        keyed.keys, keyed.find_ms, percentile(keyed.blend_ms, 0.5), 100 * error.mean, error.worst,
        100 * error.most);
  }
  if (!run.errors.empty()) {
    text += fmt::format("\n\n{:>5}{:>9}{:>9}{:>7}{:>7}{:>11}{:>9}{:>9}{:>9}{:>10}{:>9}", "frame", "seconds",
                        "ratio R", "G", "B", "mean rel.", "median", "95 %", "noise", "relMSE", "colour");
    for (const FrameError& e : run.errors) {
      const study::RelativeError worst = study::worst_channel(e.error);
      text +=
          fmt::format("\n{:>5}{:>9.2f}  {} {:>10.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>9.4f} {:>8.3f}", e.frame,
                      e.frame / run.fps, ratio_columns(e.error), worst.mean_relative, worst.median_relative,
                      worst.p95_relative, worst.noise, worst.relmse, e.error.chromaticity.mean_error);
    }
  }
  if (run.cancelled) {
    text += fmt::format("\ncancelled: {} of {} frames and {} errors were done", run.updates.size(),
                        run.frames_asked, run.errors.size());
  }
  return text;
}

namespace {

using study::LookupError;

struct Curve {
  const char* name;
  const char* color;
  double (*value)(const LookupError&);
};

/// A panel of a plot: axes, curves and their names.
std::string panel(const RelightRun& run, double top, double low, double high,
                  const std::vector<Curve>& curves) {
  constexpr double left = 60, width = 620, height = 150;
  const double first = run.errors.front().frame / run.fps, last = run.errors.back().frame / run.fps;
  const auto x = [&](double seconds) {
    return left + width * (seconds - first) / std::max(last - first, 1e-9);
  };
  const auto y = [&](double value) {
    return top + height * (1 - std::clamp((value - low) / (high - low), 0.0, 1.0));
  };
  std::string svg;
  for (int i = 0; i <= 4; ++i) {
    const double value = low + (high - low) * i / 4;
    svg += fmt::format(
        "<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='#ddd'/>"
        "<text x='{:.1f}' y='{:.1f}' text-anchor='end'>{:.3g}</text>\n",
        left, y(value), left + width, y(value), left - 6, y(value) + 4, value);
    const double seconds = first + (last - first) * i / 4;
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:.3g} s</text>\n", x(seconds),
                       top + height + 16, seconds);
  }
  double name_x = left;
  for (const Curve& curve : curves) {
    std::string points, dots;
    for (const FrameError& e : run.errors) {
      const double value = curve.value(e.error);
      if (!std::isfinite(value)) continue;
      points += fmt::format("{:.1f},{:.1f} ", x(e.frame / run.fps), y(value));
      dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2' fill='{}'/>", x(e.frame / run.fps), y(value),
                          curve.color);
    }
    svg += fmt::format("<polyline points='{}' fill='none' stroke='{}'/>{}\n", points, curve.color, dots);
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' fill='{}'>{}</text>\n", name_x, top - 8, curve.color,
                       curve.name);
    name_x += 220;
  }
  return svg;
}

}  // namespace

void write_error_curve(const std::filesystem::path& path, const RelightRun& run) {
  const std::vector<Curve> ratios = {
      {"looked up / path traced: red", "#b03a2e", [](const LookupError& e) { return e.channels[0].ratio; }},
      {"green", "#1e8449", [](const LookupError& e) { return e.channels[1].ratio; }},
      {"blue", "#1b6ca8", [](const LookupError& e) { return e.channels[2].ratio; }}};
  const std::vector<Curve> errors = {
      {"mean relative error, worst channel", "#b03a2e",
       [](const LookupError& e) { return study::worst_channel(e).mean_relative; }},
      {"of which the truth's noise", "#999999",
       [](const LookupError& e) { return study::worst_channel(e).noise; }},
      {"root of relMSE", "#7d3c98",
       [](const LookupError& e) { return std::sqrt(std::max(study::worst_channel(e).relmse, 0.0)); }}};
  double off = 0.05, most = 0.05;
  for (const FrameError& e : run.errors) {
    const double ratio = study::worst_channel(e.error).ratio;
    if (std::isfinite(ratio)) off = std::max(off, std::abs(ratio - 1));
    for (const Curve& curve : errors) most = std::max(most, curve.value(e.error));
  }
  write_file(path,
             "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 720 440' font-family='sans-serif' "
             "font-size='12'>\n<rect width='720' height='440' fill='white'/>\n" +
                 panel(run, 40, 1 - 1.1 * off, 1 + 1.1 * off, ratios) +
                 panel(run, 250, 0, 1.1 * most, errors) + "</svg>\n");
}

}  // namespace ssphh::app
