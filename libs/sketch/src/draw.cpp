#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/sketch/draw.h>

#include "beam.h"
#include "hits.h"

namespace ssphh::sketch {
namespace {

constexpr int tile_size = 16;

/// Indices of the marks that a rectangle may show.
struct Marks {
  std::vector<std::uint32_t> lines, discs, boxes, balls, lobes;

  bool empty() const {
    return lines.empty() && discs.empty() && boxes.empty() && balls.empty() && lobes.empty();
  }
};

/// What one sample of a pixel shows.
struct Sample {
  std::size_t pixel;  ///< y · width + x
  Hit hit;
};

class Drawing {
 public:
  Drawing(image::Image& picture, const Sketch& sketch, const Eye& eye, const DrawParams& params)
      : picture_(picture), sketch_(sketch), eye_(eye), params_(params) {
    const Ray first = eye.ray(0.5f, 0.5f);
    const Ray last =
        eye.ray(static_cast<float>(picture.width) - 0.5f, static_cast<float>(picture.height) - 0.5f);
    parallel_ = first.direction == last.direction && first.origin != last.origin;
    for (const Line& line : sketch.lines) widest_ = std::max(widest_, line.width);
    const auto number = [](std::vector<std::uint32_t>& list, std::size_t count) {
      list.resize(count);
      std::iota(list.begin(), list.end(), 0U);
    };
    number(all_.lines, sketch.lines.size()), number(all_.discs, sketch.discs.size());
    number(all_.boxes, sketch.boxes.size()), number(all_.balls, sketch.balls.size());
    number(all_.lobes, sketch.lobes.size());
    tables_ = lobe_tables(sketch.lobes);
  }

  void tile(int x0, int y0) const {
    const int x1 = std::min(x0 + tile_size, picture_.width), y1 = std::min(y0 + tile_size, picture_.height);
    const Marks near =
        within(Beam::of(eye_, rectangle(x0, y0, x1, y1), margin(x0, y0, x1, y1), parallel_), all_);
    if (near.empty()) return;
    std::vector<Sample> samples;
    std::vector<Ray> rays;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) take(x, y, near, samples, rays);
    if (samples.empty()) return;
    std::vector<float> distances(rays.size(), std::numeric_limits<float>::infinity());
    if (eye_.surfaces) eye_.surfaces(rays, distances);
    blend(samples, distances);
  }

 private:
  static vec4 rectangle(int x0, int y0, int x1, int y1) {
    return {static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1), static_cast<float>(y1)};
  }

  /// How far lines reach beyond their rays where pixels are largest.
  float margin(int x0, int y0, int x1, int y1) const {
    float most = 0;
    for (const int x : {x0, (x0 + x1) / 2, x1 - 1}) {
      for (const int y : {y0, (y0 + y1) / 2, y1 - 1}) most = std::max(most, pixel_size(x, y));
    }
    return 0.5f * widest_ * most;
  }

  Marks within(const Beam& beam, const Marks& among) const {
    Marks out;
    const auto keep = [](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to,
                         const auto& meets) { std::ranges::copy_if(from, std::back_inserter(to), meets); };
    keep(among.lines, out.lines,
         [&](std::uint32_t i) { return beam.meets_line(sketch_.lines[i].a, sketch_.lines[i].b); });
    keep(among.discs, out.discs,
         [&](std::uint32_t i) { return beam.meets_ball(sketch_.discs[i].center, sketch_.discs[i].radius); });
    keep(among.boxes, out.boxes, [&](std::uint32_t i) {
      const Box& box = sketch_.boxes[i];
      return beam.meets_ball(0.5f * (box.min + box.max), 0.5f * glm::length(box.max - box.min));
    });
    keep(among.balls, out.balls,
         [&](std::uint32_t i) { return beam.meets_ball(sketch_.balls[i].center, sketch_.balls[i].radius); });
    keep(among.lobes, out.lobes, [&](std::uint32_t i) {
      return beam.meets_ball(sketch_.lobes[i].center, sketch_.lobes[i].scale * tables_[i].most());
    });
    return out;
  }

  /// Angle between the rays of a pixel and its neighbours, or their distance.
  float pixel_size(int x, int y) const {
    const float cx = static_cast<float>(x) + 0.5f, cy = static_cast<float>(y) + 0.5f;
    const Ray ray = eye_.ray(cx, cy), right = eye_.ray(cx + 0.25f, cy), down = eye_.ray(cx, cy + 0.25f);
    const auto apart = [&](const Ray& other) {
      return parallel_ ? glm::length(other.origin - ray.origin)
                       : glm::length(glm::cross(other.direction, ray.direction));
    };
    return 4 * std::max(apart(right), apart(down));
  }

  std::optional<Hit> nearest(const Ray& ray, float pixel, const Marks& marks) const {
    std::optional<Hit> best;
    const auto take = [&](const std::optional<Hit>& hit) {
      if (hit && (!best || hit->distance < best->distance)) best = hit;
    };
    for (const auto i : marks.lines) take(hit(sketch_.lines[i], ray, pixel, parallel_));
    for (const auto i : marks.discs) take(hit(sketch_.discs[i], ray));
    for (const auto i : marks.boxes) take(hit(sketch_.boxes[i], ray));
    for (const auto i : marks.balls) take(hit(sketch_.balls[i], ray));
    for (const auto i : marks.lobes) take(hit(sketch_.lobes[i], tables_[i], ray));
    return best;
  }

  void take(int x, int y, const Marks& near, std::vector<Sample>& samples, std::vector<Ray>& rays) const {
    const float pixel = pixel_size(x, y);
    const Marks marks =
        within(Beam::of(eye_, rectangle(x, y, x + 1, y + 1), 0.5f * widest_ * pixel, parallel_), near);
    if (marks.empty()) return;
    const auto fx = static_cast<float>(x), fy = static_cast<float>(y),
               n = static_cast<float>(params_.samples);
    for (int j = 0; j < params_.samples; ++j) {
      for (int i = 0; i < params_.samples; ++i) {
        const Ray ray =
            eye_.ray(fx + (static_cast<float>(i) + 0.5f) / n, fy + (static_cast<float>(j) + 0.5f) / n);
        const std::optional<Hit> met = nearest(ray, pixel, marks);
        if (!met) continue;
        samples.push_back({static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                               static_cast<std::size_t>(x),
                           *met});
        rays.push_back(ray);
      }
    }
  }

  void blend(const std::vector<Sample>& samples, const std::vector<float>& distances) const {
    const auto in_pixel = static_cast<float>(params_.samples * params_.samples);
    for (std::size_t i = 0; i < samples.size();) {
      const std::size_t pixel = samples[i].pixel;
      vec3 color(0);
      float covered = 0;
      for (; i < samples.size() && samples[i].pixel == pixel; ++i) {
        const Hit& met = samples[i].hit;
        // Rays that meet the very surface a mark lies on differ from it by rounding.
        constexpr float rounding = 1e-3f;
        const bool hidden = distances[i] < met.distance * (1 - rounding) - met.slack;
        const float opacity = (hidden ? params_.hidden : 1) / in_pixel;
        color += opacity * (met.light ? 1 : params_.white) * met.color;
        covered += opacity;
      }
      float* out = picture_.pixels.data() + pixel * static_cast<std::size_t>(picture_.channels);
      for (int c = 0; c < 3; ++c) out[c] = (1 - covered) * out[c] + color[c];
    }
  }

  image::Image& picture_;
  const Sketch& sketch_;
  const Eye& eye_;
  const DrawParams& params_;
  bool parallel_ = false;
  float widest_ = 0;
  Marks all_;
  std::vector<LobeTable> tables_;
};

}  // namespace

void draw(image::Image& picture, const Sketch& sketch, const Eye& eye, const DrawParams& params,
          const Control& control) {
  image::require_whole(picture, "sketch");
  require(picture.channels >= 3, "sketch", "the picture must be RGB");
  require(eye.ray != nullptr, "sketch", "the eye has no rays");
  require(params.samples >= 1 && params.samples <= 16, "sketch", "samples must be 1..16");
  const Drawing drawing(picture, sketch, eye, params);
  if (sketch.empty()) return;
  const int across = (picture.width + tile_size - 1) / tile_size,
            down = (picture.height + tile_size - 1) / tile_size;
  parallel_for(
      static_cast<std::size_t>(across) * static_cast<std::size_t>(down), 1,
      [&](std::size_t i) {
        const auto tile = static_cast<int>(i);
        drawing.tile(tile % across * tile_size, tile / across * tile_size);
      },
      control);
}

}  // namespace ssphh::sketch
