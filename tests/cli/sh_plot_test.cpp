// `ssphh sh plot`: lobes have the shape, the side and the colour of their functions.

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>

#include <ssphh/core/parallel.h>
#include <ssphh/image/io.h>

#include "commands/sh.h"
#include "commands/sh_file.h"
#include "error_message.h"
#include "here.h"
#include "temp_dir.h"

namespace ssphh::app {
namespace {

using testing::HasSubstr;

constexpr int cell = 48;

class ShPlot : public testing::Test {
 protected:
  image::Image sheet(int degree) const {
    return run_sh_plot({.degree = degree, .size = cell, .output = dir_ / "o.png"}).picture;
  }
  image::Image of_file(const std::vector<vec3>& values, int degree) const {
    std::ofstream(dir_ / "f.json") << print(sh_to_json(values, degree));
    return run_sh_plot({.file = dir_ / "f.json", .size = cell, .output = dir_ / "o.png"}).picture;
  }
  const test::TempDir dir_;
};

/// 1 where a pixel is blue, −1 where it is orange, 0 where it is white.
int sign(const image::Image& picture, int x, int y) {
  const vec3 color = picture.rgb(x, y);
  if (color == vec3(1)) return 0;
  return color.z > color.x ? 1 : -1;
}

TEST_F(ShPlot, TheConstantIsARoundDiscToAPixel) {
  const image::Image picture = sheet(0);
  ASSERT_EQ(picture.width, cell);
  ASSERT_EQ(picture.height, cell);
  for (int y = 0; y < cell; ++y) {
    for (int x = 0; x < cell; ++x) {
      const double off = std::hypot(x + 0.5 - cell / 2, y + 0.5 - cell / 2);
      if (off < 0.46 * cell - 1) {
        EXPECT_EQ(sign(picture, x, y), 1) << x << ' ' << y;
      }
      if (off > 0.46 * cell + 1) {
        EXPECT_EQ(sign(picture, x, y), 0) << x << ' ' << y;
      }
    }
  }
}

TEST_F(ShPlot, RowsAreDegreesAndColumnsOrders) {
  const image::Image picture = sheet(2);
  ASSERT_EQ(picture.width, 5 * cell);
  ASSERT_EQ(picture.height, 3 * cell);
  for (int l = 0; l <= 2; ++l) {
    for (int m = -2; m <= 2; ++m) {
      int marked = 0;
      for (int y = 0; y < cell; ++y)
        for (int x = 0; x < cell; ++x) marked += sign(picture, (m + 2) * cell + x, l * cell + y) != 0;
      if (std::abs(m) <= l) {
        EXPECT_GT(marked, cell * cell / 10) << l << ' ' << m;
      }
      if (std::abs(m) > l) {
        EXPECT_EQ(marked, 0) << l << ' ' << m;
      }
    }
  }
}

TEST_F(ShPlot, Y10IsPositiveAboveTheEquator) {
  const image::Image picture = sheet(1);
  int above = 0, below = 0;
  for (int y = 0; y < cell; ++y) {
    for (int x = 0; x < cell; ++x) {
      const int s = sign(picture, cell + x, cell + y);
      if (y < cell / 2 - 4) {
        EXPECT_GE(s, 0) << x << ' ' << y;
      }
      if (y >= cell / 2 + 4) {
        EXPECT_LE(s, 0) << x << ' ' << y;
      }
      above += s > 0, below += s < 0;
    }
  }
  EXPECT_GT(above, cell * cell / 10);
  EXPECT_GT(below, cell * cell / 10);
}

TEST_F(ShPlot, BodiesOfRevolutionAboutThePoleAreTheirMirrorImages) {
  const int degree = 4;
  const image::Image picture = sheet(degree);
  for (int l = 0; l <= degree; ++l) {
    for (int y = 0; y < cell; ++y) {
      for (int x = 0; x < cell; ++x) {
        const vec3 left = picture.rgb(degree * cell + x, l * cell + y);
        const vec3 right = picture.rgb(degree * cell + cell - 1 - x, l * cell + y);
        // A pixel's samples may fall on either side of an edge.
        EXPECT_LT(glm::length(left - right), 0.3f) << l << ' ' << x << ' ' << y;
      }
    }
  }
}

TEST_F(ShPlot, SilhouettesArePointSymmetric) {
  // |Y(−ω)| = |Y(ω)|, and the rays are parallel.
  const int degree = 3;
  const image::Image picture = sheet(degree);
  for (int m = -degree; m <= degree; ++m) {
    int differ = 0, marked = 0;
    for (int y = 0; y < cell; ++y) {
      for (int x = 0; x < cell; ++x) {
        const auto shown = [&](int u, int v) {
          return sign(picture, (m + degree) * cell + u, degree * cell + v) != 0;
        };
        marked += shown(x, y);
        differ += shown(x, y) != shown(cell - 1 - x, cell - 1 - y);
      }
    }
    EXPECT_GT(marked, 100) << m;
    EXPECT_LE(differ, marked / 50) << m;
  }
}

TEST_F(ShPlot, AFilesLuminanceStandsInTheWorldWithYUp) {
  // A third of green alone along +y: up, blue; along −y orange.
  const image::Image picture = of_file({vec3(0), {0, 0.3f, 0}, vec3(0), vec3(0)}, 1);
  ASSERT_EQ(picture.width, 4 * cell);
  EXPECT_EQ(sign(picture, 2 * cell, cell), 1);
  EXPECT_EQ(sign(picture, 2 * cell, 3 * cell), -1);
  // Nothing is a lobe without extent.
  const image::Image none = of_file({vec3(0)}, 0);
  EXPECT_EQ(none.rgb(2 * cell, 2 * cell), vec3(1));
}

TEST_F(ShPlot, TheSameBitsForAnyNumberOfThreads) {
  set_thread_count(1);
  const image::Image alone = sheet(3);
  set_thread_count(0);
  EXPECT_EQ(alone.pixels, sheet(3).pixels);
}

TEST_F(ShPlot, SaysWhatItDrew) {
  const std::string out = dir_ / "o.png";
  EXPECT_EQ(
      test::text_here({"sh", "plot", "--degree", "1", "--size", "16", "-o", out}),
      out + ": 48 × 32, degree 1, Y_lm: row l from the top, m from -l to l; blue positive, orange negative");
  EXPECT_EQ(image::read_image(out).width, 48);
  const json::Value object = test::json_here({"sh", "plot", "--degree", "1", "--size", "16", "-o", out});
  EXPECT_EQ(object["width"].number(), 48);
  EXPECT_EQ(object["degree"].number(), 1);
}

TEST_F(ShPlot, RefusesWhatItCannotDo) {
  EXPECT_THAT(test::message_of([&] { run_sh_plot({.output = "o.txt"}); }), HasSubstr("o.txt"));
  EXPECT_THAT(test::message_of([&] { run_sh_plot({.file = dir_ / "none.json", .output = dir_ / "o.png"}); }),
              HasSubstr("none.json"));
}

}  // namespace
}  // namespace ssphh::app
