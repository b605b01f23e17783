#pragma once
/// A small report with pictures, without running anything.

#include <cmath>

#include <ssphh/report/measure.h>
#include <ssphh/report/report.h>

// What all tests share is found as test::name beside these, too.
namespace ssphh::test {}
namespace ssphh::report::test {
using namespace ssphh::test;

inline image::Image example_picture(float warmth) {
  image::Image image(32, 18);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float u = static_cast<float>(x) / 32, v = static_cast<float>(y) / 18;
      image.set_rgb(x, y, vec3(u * warmth, 0.5f * v, 0.001f + 3 * u * v) + 0.3f * std::sin(9 * u + 7 * v));
    }
  }
  return image;
}

inline Report example_report() {
  Report report;
  report.plan = parse_plan(R"({
    "title": "A <small> report", "about": "x & y", "variables": {"spp": 4},
    "scenes": [{"name": "s", "title": "Scene", "scene": "builtin:x", "exposure": 0.5,
                "insets": [{"name": "corner", "at": [0, 0, 0.5, 0.5]}]}],
    "reference": {"name": "truth", "steps": ["render {scene} -o t.exr"], "picture": "t.exr"},
    "methods": [{"name": "m", "parameters": {"n": [1, 2]}, "steps": ["render {scene} -o o.exr"], "picture": "o.exr"},
                {"name": "bad, \"quoted\"", "steps": ["render {scene} -o o.exr"]}],
    "columns": [{"value": "flip", "title": "FLIP", "better": "less"}, {"value": "render.seconds", "title": "run", "unit": "s"}],
    "charts": [{"x": "n", "y": "relmse", "title": "by n"}],
    "published": {"source": "a paper", "rows": [{"scene": "s", "method": "m, n 2", "values": {"run": 99}}]},
    "block": 4})",
                           "plan", {"render"});
  report.provenance = {"id",           "1.0", "build", "abc", "a machine", "today", "ssphh report plan",
                       {{"s", "hash"}}};
  const LayerPicture truth{example_picture(1), {}};
  ReportCell reference{0, -1, "truth", {}, {}, {}, {}, {}};
  reference.pictures.push_back({"", "", pack_half(truth.picture)});
  report.cells.push_back(std::move(reference));
  for (const int n : {1, 2}) {
    const LayerPicture picture{example_picture(1 + 0.2f * static_cast<float>(n)), {}};
    const LayerMeasure measured = measure_layer(truth, {picture}, {4, report.plan.scenes[0].insets});
    ReportCell cell{0, 0, "m, n " + std::to_string(n), {{"n", std::to_string(n)}}, {}, {}, {}, {}};
    for (const auto& [name, numbers] : measured.values) cell.values[name] = value_of(numbers);
    cell.values["render.seconds"] = value_of({1.0 * n, 2.0 * n, 6.0 * n});
    cell.steps.push_back(
        {"render", "k" + std::to_string(n), "render 'a b' -o o.exr", "then", "here", 0, 2.0, 5u << 20});
    cell.pictures.push_back({"", "", pack_half(picture.picture)});
    cell.pictures.push_back({"", "flip", pack_bytes(measured.flip)});
    report.cells.push_back(std::move(cell));
  }
  report.cells.push_back({0, 1, "bad, \"quoted\"", {}, "it failed </script>", {}, {}, {}});
  return report;
}

}  // namespace ssphh::report::test
