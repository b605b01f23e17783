// The picture as a file: what is seen in 8 bits, or its light.

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>

#include "app.h"

namespace ssphh::viewer {
namespace {

/// What is seen without panels, of all views; empty before the first picture.
image::Rgba8 shown_pixels(const App& app) {
  const Settings& settings = app.settings;
  const Picture& picture = app.picture;
  image::Rgba8 pixels;
  if (needs_truth(settings) && settings.show != Show::wipe) {
    pixels = picture.truth_pixels();
  } else {
    pixels = app.shows_instead() ? picture.instead_pixels() : picture.pixels();
    const image::Rgba8& truth = picture.truth_pixels();
    const bool same_size = truth.width == pixels.width && truth.height == pixels.height;
    if (settings.show == Show::wipe && picture.has_truth() && same_size) {
      const auto from = static_cast<int>(settings.wipe * static_cast<float>(pixels.width));
      for (int y = 0; y < pixels.height; ++y) {
        const auto row = 4 * static_cast<std::ptrdiff_t>(y) * pixels.width;
        std::copy(truth.rgba.begin() + row + 4 * from, truth.rgba.begin() + row + 4 * pixels.width,
                  pixels.rgba.begin() + row + 4 * from);
      }
    }
  }
  if (app.others.empty() || app.frames) return pixels;
  // All views where they stand
  const auto at = [&](float window) { return static_cast<int>(std::lround(window * settings.scale)); };
  image::Rgba8 all{at(app.area.width), at(app.area.height), {}};
  all.rgba.assign(4 * static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height), 255);
  const auto put = [&](const Pane& pane, const image::Rgba8& part) {
    const int left = at(pane.viewport.x - app.area.x), top = at(pane.viewport.y - app.area.y);
    for (int y = 0; y < std::min(part.height, all.height - top); ++y) {
      const auto from = part.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(y) * part.width;
      std::copy_n(from, 4 * std::min(part.width, all.width - left),
                  all.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(top + y) * all.width + left));
    }
  };
  put(app, pixels);
  for (const Pane& other : app.others) put(other, other.picture.pixels());
  return all;
}

}  // namespace

void App::screenshot(const std::string& file, bool with_panels) {
  if (is_linear_picture(file)) {
    screen.linear_file.emplace().file = file;
    if (by_hand()) say(fmt::format("writing {} …", file));
    return redraw();
  }
  if (with_panels) {
    window_shot_ = file;
    return redraw();
  }
  const image::Rgba8 pixels = shown_pixels(*this);
  if (pixels.rgba.empty())
    throw Error(file, "there is no picture yet", "try again when one stands in the window");
  write_file(file, image::encode_png(pixels));
  written("wrote", file);
}

/// Of a picture that stands still all those for smooth edges are in it.
void App::write_linear() {
  if (!screen.linear_file) return;
  const LinearFile& asked = *screen.linear_file;
  const bool moves = settings.play || path_plays;
  const int wanted = smooths() && !moves ? smooth_pictures : 1;
  if (!asked.begun || (screen.coarse && !moves) || screen.waiting_maps > 0 || asked.mean.count() < wanted)
    return;
  const auto light = linear_shown(settings, asked.mean.mean(), reference.image());
  if (!light) return;
  const std::string file = std::exchange(screen.linear_file, std::nullopt)->file;
  try {
    image::write_image(file, *light);
    written("wrote", file);
  } catch (const std::exception& e) {
    complain(e.what());
  }
}

}  // namespace ssphh::viewer
