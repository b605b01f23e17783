// `ssphh probe preview --edges`: a row for each neighbour, with what HIER multiplies and sums up.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/image/io.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/sh/reconstruct.h>

#include "error_message.h"
#include "here.h"
#include "results/label.h"
#include "results/probe_sheet.h"
#include "sloped_light.h"
#include "temp_dir.h"

namespace ssphh::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Three probes, each of which sees the others: the last one best.
probes::ProbeSet three_probes() {
  probes::ProbeSet set;
  set.degree = 1;
  set.light_groups = {{.name = "lamp"}};
  for (int i = 0; i < 3; ++i) {
    const auto x = static_cast<float>(i);
    probes::Probe probe;
    probe.name = std::string(1, static_cast<char>('a' + i));
    probe.groups = {{{}, test::sloped_light(1 + x, 0.5f)}};
    for (int from = 0; from < 3; ++from) {
      if (from == i) continue;
      const float transfer = 0.125f * static_cast<float>(1 + from);
      probe.edges.push_back(
          {.from = from, .transfer = transfer, .h = test::sloped_light(transfer, 0.05f), .matrix = {}});
    }
    set.probes.push_back(probe);
  }
  probes::merge_groups(set);
  probes::hier(set, {});
  return set;
}

constexpr int width = 16, gap = 4;

/// Pixel (x, y) of the picture in a row and a column.
vec3 pixel(const ProbeSheet& sheet, int row, int column, int x, int y) {
  const int above = label_height() + 2;
  return sheet.image.rgb(column * (width + gap) + x, row * (above + width / 2 + gap) + above + y);
}

void expect_picture(const ProbeSheet& sheet, int row, int column, const sh::RadianceSh& light) {
  const float factor = std::exp2(sheet.columns[column].exposure);
  for (int y = 0; y < width / 2; ++y) {
    for (int x = 0; x < width; ++x) {
      const vec3 d = image::equirect_direction((static_cast<float>(x) + 0.5f) / width,
                                               (static_cast<float>(y) + 0.5f) / (width / 2));
      const vec3 wanted = glm::max(factor * sh::eval(light, d), vec3(0));
      EXPECT_LT(glm::length(pixel(sheet, row, column, x, y) - wanted), 1e-4f * (1 + glm::length(wanted)))
          << row << ' ' << column << ' ' << x << ' ' << y;
    }
  }
}

TEST(EdgeSheet, HasARowForEachNeighbourStrongestFirst) {
  const probes::ProbeSet set = three_probes();
  const ProbeSheet sheet = edge_sheet(set, "a", width, 0);
  EXPECT_THAT(sheet.rows, ElementsAre("c", "b"));
  const probes::Probe& a = set.probes[0];
  sh::RadianceSh sum = a.self;
  for (int row = 0; row < 2; ++row) {
    const probes::Edge& edge = a.edges[row == 0 ? 1 : 0];
    const sh::RadianceSh& source = set.probes[edge.from].self;
    sh::RadianceSh product(1);
    // The paper's ⊗: coefficient by coefficient, over √4π.
    for (int k = 0; k < 4; ++k) product[k] = edge.h[k] * source[k] / std::sqrt(4 * pi);
    sum += product;
    expect_picture(sheet, row, 0, a.self);
    expect_picture(sheet, row, 1, edge.h);
    expect_picture(sheet, row, 2, source);
    expect_picture(sheet, row, 3, product);
    expect_picture(sheet, row, 4, sum);
  }
  expect_picture(sheet, 1, 4, set.hierarchy->sum[0]);
  EXPECT_EQ(sheet.columns[0].exposure, sheet.columns[4].exposure);
  EXPECT_EQ(sheet.columns[2].exposure, sheet.columns[4].exposure);
}

TEST(EdgeSheet, HasTheNeighboursThatHierTook) {
  probes::ProbeSet set = three_probes();
  probes::hier(set, {probes::HierOperator::mean, 1, 0});
  EXPECT_THAT(edge_sheet(set, "c", width, 0).rows, ElementsAre("b"));
  expect_picture(edge_sheet(set, "c", width, 0), 0, 4, set.hierarchy->sum[2]);
}

TEST(EdgeSheet, EveryPictureHasItsName) {
  const ProbeSheet sheet = edge_sheet(three_probes(), "a", 64, 0);
  const int step = label_height() + 2 + 32 + gap;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 5; ++column) {
      int dark = 0;
      for (int y = 0; y < label_height(); ++y)
        for (int x = 0; x < 64; ++x)
          dark += sheet.image.rgb(column * (64 + gap) + x, row * step + 1 + y).x < 0.1f;
      EXPECT_GT(dark, 20) << row << ' ' << column;
    }
  }
}

TEST(EdgeSheet, RefusesWhatHasNoEdges) {
  probes::ProbeSet set = three_probes();
  EXPECT_THAT(test::message_of([&] { edge_sheet(set, "bb", width, 0); }),
              testing::AllOf(HasSubstr("--edges bb: there is no such probe"), HasSubstr("did you mean")));
  probes::hier(set, {probes::HierOperator::mean, 0, 0});
  EXPECT_THAT(test::message_of([&] { edge_sheet(set, "a", width, 0); }),
              HasSubstr("none of the probe's neighbours"));
  set.hierarchy.reset();
  EXPECT_THAT(test::message_of([&] { edge_sheet(set, "a", width, 0); }), HasSubstr("run `ssphh hier`"));
}

TEST(EdgeSheet, TheToolWritesItAndSaysWhatItShows) {
  const test::TempDir dir;
  const std::string file = dir / "a.sphl", out = dir / "o.png";
  probes::write_probe_file(three_probes(), file);
  const json::Value object =
      test::json_here({"probe", "preview", file, "--edges", "b", "--width", "64", "-o", out});
  EXPECT_EQ(object["rows"], json::Value({"c", "a"}));
  EXPECT_EQ(object["columns"].size(), 5u);
  EXPECT_EQ(image::read_image(out).width, 5 * (64 + gap) - gap);
  EXPECT_THAT(test::text_here({"probe", "preview", file, "--edges", "b", "--width", "64", "-o", out}),
              HasSubstr("one row per neighbour of b, columns from the left: self (exposure"));
}

TEST(Label, StaysWithinItsWidthAndThePicture) {
  image::Image picture(30, 12);
  write_label(picture, 20, 4, 100, "Wide words", vec3(1));
  write_label(picture, 0, -3, 14, "WWWW", vec3(1));
  int left = 0, right = 0;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 30; ++x) {
      if (x >= 14 && x < 20) {
        EXPECT_EQ(picture.rgb(x, y), vec3(0));
      }
      (x < 14 ? left : right) += picture.rgb(x, y).x > 0.5f;
    }
  }
  EXPECT_GT(left, 5);
  EXPECT_GT(right, 5);
}

}  // namespace
}  // namespace ssphh::app
