#pragma once
/// The ground truth of one view, or what another method makes of it, traced in the background pass after
/// pass.

#include <memory>

#include <ssphh/image/image.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/trace/render_state.h>
#include <ssphh/trace/scene_geometry.h>

#include "background_job.h"

namespace ssphh::viewer {

struct ReferenceParams {
  std::shared_ptr<const scene::Scene> scene;  ///< with its edits
  trace::SharedGeometry geometry;             ///< of its surfaces; null: it is built
  float time = 0;
  scene::CameraPose camera;
  int width = 0, height = 0;
  std::string method = "path";  ///< or one of methods::all_methods(), with its default parameters
  int max_depth = rays::usual_max_depth;
  int passes = 256;  ///< one sample per pixel each
};

struct ReferenceImage {
  std::shared_ptr<const image::Image> color;     ///< radiance, mean of the passes
  std::shared_ptr<const image::Image> indirect;  ///< path depth ≥ 2 of it
  int passes = 0;
};

class Reference {
 public:
  /// Begins anew for what `params` asks.
  void start(const ReferenceParams& params);
  void stop() { job_.cancel(); }
  /// Moves a finished pass into image(). True when there is a new one.
  bool poll() { return job_.poll(); }
  const ReferenceImage& image() const { return image_; }
  /// Forgets the picture.
  void clear();
  JobStatus status() const { return job_.status(); }
  /// Why the last picture failed, once; empty: it did not.
  std::string take_error() { return job_.take_error(); }

 private:
  ReferenceImage image_;
  BackgroundJob job_;
};

}  // namespace ssphh::viewer
