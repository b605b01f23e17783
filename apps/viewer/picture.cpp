#include "picture.h"

#include <cmath>

#include "model/reading.h"

namespace ssphh::viewer {

void PictureTexture::upload(const image::Rgba8& picture) {
  if (picture.width != width() || picture.height != height()) {
    texture_ = gl::Texture(gl::Format::rgba8, picture.width, picture.height);
    texture_.set_filter(true);
  }
  texture_.upload(std::as_bytes(std::span(picture.rgba)));
}

void Picture::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width, height_ = height;
  if (averaged() > 0 || mean_stays_) {
    before_ = average_->take();
    mean_stays_ = false;
  } else if (whole_) {
    before_ = std::move(color_);
  }
  whole_ = false;
  color_ = gl::Texture(gl::Format::rgba8, width, height);
  color_.set_filter(true);
  depth_ = gl::Texture(gl::Format::depth32f, width, height);
  const gl::Texture* const colors[] = {&color_};
  framebuffer_ = gl::Framebuffer(colors, &depth_);
  linear_ = {};
  have_truth_ = false;
}

void Picture::average() {
  if (!average_) average_ = std::make_unique<AverageGl>();
  average_->add(color_);
}

void Picture::begin(realtime::Renderer& renderer, const scene::CameraPose& camera,
                    const realtime::FrameSettings& settings, bool joins_mean) {
  if (average_ && !joins_mean) {
    mean_stays_ = mean_stays_ || averaged() > 0;
    average_->clear();
  }
  renderer.begin(camera, settings, {width_, height_, framebuffer_.id(), 0, 0});
}

bool Picture::step(realtime::Renderer& renderer, bool linear) {
  if (renderer.step()) return true;
  whole_ = true;
  mean_stays_ = false;
  if (linear) linear_ = renderer.read_back();
  return false;
}

void Picture::show_again(realtime::Renderer& renderer, const image::ToneMap& tone) {
  if (average_) average_->clear();
  renderer.show_again(tone);
}

const realtime::FrameStats& Picture::draw(realtime::Renderer& renderer, const scene::CameraPose& camera,
                                          const realtime::FrameSettings& settings, bool linear) {
  begin(renderer, camera, settings);
  while (step(renderer, linear)) {
  }
  return renderer.stats();
}

image::Rgba8 Picture::pixels() const {
  const gl::Texture& texture = shown();
  image::Rgba8 out{texture.width(), texture.height(), {}};
  const auto row = 4 * static_cast<std::size_t>(out.width), rows = static_cast<std::size_t>(out.height);
  if (row == 0) return out;
  std::vector<float> values(row * rows);
  texture.read(values, 4);
  out.rgba.resize(values.size());
  for (std::size_t y = 0; y < rows; ++y) {
    // OpenGL's row 0 is the lowest one.
    const float* from = values.data() + (rows - 1 - y) * row;
    std::uint8_t* to = out.rgba.data() + y * row;
    for (std::size_t i = 0; i < row; ++i)
      to[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(std::lround(from[i] * 255));
  }
  return out;
}

void Picture::take_instead(image::Rgba8 picture) {
  instead_picture_ = std::move(picture);
  instead_.upload(instead_picture_);
}

void Picture::update_truth(const ReferenceImage& truth, const Settings& settings) {
  if (!truth.color || truth.color->width != width_ || truth.color->height != height_) return;
  difference_.reset();
  if (settings.debug == DebugView::leak) {
    if (linear_.empty()) return;
    difference_ = leak_picture(*truth.indirect, linear_);
    truth_picture_ = difference_->picture;
  } else if (settings.show == Show::truth || settings.show == Show::wipe) {
    const image::ToneMap tone = shown_tone(settings);
    truth_picture_ = settings.false_color ? false_color(*truth.color, tone.exposure)
                                          : image::to_display(*truth.color, tone);
  } else {
    if (linear_.empty()) return;
    difference_ = difference(*truth.color, linear_, settings.show, settings.block);
    truth_picture_ = difference_->picture;
  }
  truth_.upload(truth_picture_);
  have_truth_ = true;
}

image::ToneMap shown_tone(const Settings& settings) {
  using enum DebugView;
  const DebugView view = settings.debug;
  const bool light = view == none || view == direct || view == indirect || view == leak;
  return {settings.auto_exposure && !light ? 0 : settings.exposure,
          light ? settings.curve : image::ToneCurve::clip, 0};
}

realtime::FrameSettings frame_settings(const Settings& settings) {
  realtime::FrameSettings out;
  out.lookup = settings.lookup;
  out.weights = settings.weights;
  out.tone = shown_tone(settings);
  out.indirect_scale = needs_truth(settings) ? 1 : settings.indirect_scale;
  using enum realtime::View;
  constexpr realtime::View views[] = {lit, direct, indirect, albedo, normal, shadow, chosen_sphl, indirect};
  out.view = views[static_cast<int>(settings.debug)];  // in the order of DebugView
  return out;
}

bool same_picture(const Settings& a, const Settings& b) {
  return a.antialias == b.antialias && shown_tone(a).exposure == shown_tone(b).exposure &&
         a.auto_exposure == b.auto_exposure && a.curve == b.curve && a.debug == b.debug &&
         a.indirect_scale == b.indirect_scale && a.lookup == b.lookup && a.weights == b.weights &&
         a.layer == b.layer && a.degree == b.degree && a.hier == b.hier && a.hier_params == b.hier_params &&
         a.balls == b.balls && a.lobes == b.lobes && a.ball == b.ball && a.ball_size == b.ball_size;
}

bool same_but_for_tone(const Settings& a, Settings b) {
  b.exposure = a.exposure, b.auto_exposure = a.auto_exposure, b.curve = a.curve;
  return same_picture(a, b);
}

bool needs_truth(const Settings& settings) {
  return settings.show != Show::realtime || settings.debug == DebugView::leak;
}

}  // namespace ssphh::viewer
