#pragma once
/// What stands behind the panels: the real-time picture, the ground truth, or their difference, as textures.

#include <memory>
#include <optional>

#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/texture.h>
#include <ssphh/realtime/renderer.h>

#include "average_gl.h"
#include "model/comparison.h"
#include "model/reference.h"

namespace ssphh::viewer {

/// An 8-bit picture that ImGui shows.
class PictureTexture {
 public:
  void upload(const image::Rgba8& picture);
  unsigned id() const { return texture_.id(); }
  int width() const { return texture_.width(); }
  int height() const { return texture_.height(); }

 private:
  gl::Texture texture_;
};

class Picture {
 public:
  /// The real-time picture's size [pixels]; makes the target anew when it changed. What was shown stays until
  /// a picture of the new size is whole.
  void resize(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  /// Draws a frame; keeps its linear light for comparisons when `linear` is asked for.
  const realtime::FrameStats& draw(realtime::Renderer& renderer, const scene::CameraPose& camera,
                                   const realtime::FrameSettings& settings, bool linear);
  /// The same in pieces: begin(), then step() while it is true and there is time. One that does not join the
  /// mean ends it.
  void begin(realtime::Renderer& renderer, const scene::CameraPose& camera,
             const realtime::FrameSettings& settings, bool joins_mean = false);
  bool step(realtime::Renderer& renderer, bool linear);
  /// The renderer's last frame, that of step(), with another tone, alone in the mean.
  void show_again(realtime::Renderer& renderer, const image::ToneMap& tone);
  unsigned framebuffer() const { return framebuffer_.id(); }
  /// Takes what stands in the framebuffer into a mean that is shown in its place.
  void average();
  /// Pictures in the mean that is shown; 0: what stands in the framebuffer is.
  int averaged() const { return average_ ? average_->count() : 0; }
  unsigned realtime_texture() const { return shown().id(); }
  /// Of the last draw() with `linear`; empty before.
  const image::Image& linear() const { return linear_; }
  void forget_linear() { linear_ = {}; }
  /// What is shown, balls included, in its own size, which resize() changes when the next picture is whole;
  /// empty before the first. Row 0 on top.
  image::Rgba8 pixels() const;

  /// What is shown in place of the real-time picture: its luminance in false colours, or marks over it.
  void take_instead(image::Rgba8 picture);
  const PictureTexture& instead_texture() const { return instead_; }
  const image::Rgba8& instead_pixels() const { return instead_picture_; }

  /// Makes what the settings ask for of the truth so far: tone-mapped, in false colours, or the difference.
  /// Does nothing without a truth of the picture's size.
  void update_truth(const ReferenceImage& truth, const Settings& settings);
  void forget_truth() { have_truth_ = false; }
  bool has_truth() const { return have_truth_; }
  unsigned truth_texture() const { return truth_.id(); }
  const image::Rgba8& truth_pixels() const { return truth_picture_; }
  /// Of the difference that is shown.
  const std::optional<Difference>& shown_difference() const { return difference_; }

 private:
  int width_ = 0, height_ = 0;
  const gl::Texture& shown() const {
    return averaged() > 0 || mean_stays_ ? average_->mean() : whole_ ? color_ : before_;
  }

  gl::Texture color_, depth_;
  gl::Texture before_;       ///< of another size
  bool whole_ = false;       ///< `color_` holds a picture
  bool mean_stays_ = false;  ///< is shown until the next picture is whole
  std::unique_ptr<AverageGl> average_;
  gl::Framebuffer framebuffer_;
  image::Image linear_;
  PictureTexture truth_, instead_;
  image::Rgba8 instead_picture_;
  image::Rgba8 truth_picture_;
  bool have_truth_ = false;
  std::optional<Difference> difference_;
};

/// EV and curve of what is shown: surfaces' colours, normals and the like are no light, which an automatic EV
/// and curves are for.
image::ToneMap shown_tone(const Settings& settings);

/// How the renderer shall draw for these settings.
realtime::FrameSettings frame_settings(const Settings& settings);

/// Whether a real-time picture drawn for `a` also serves `b`.
bool same_picture(const Settings& a, const Settings& b);
/// Whether it does once it is shown with b's exposure and curve.
bool same_but_for_tone(const Settings& a, Settings b);

/// Whether the settings show path-traced light.
bool needs_truth(const Settings& settings);

}  // namespace ssphh::viewer
