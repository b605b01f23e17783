#pragma once
/// What methods hold, drawn over the picture as `ssphh render --draw` does: found and drawn in the
/// background.

#include <memory>
#include <vector>

#include <ssphh/image/image.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/methods/drawing.h>
#include <ssphh/scene/query.h>
#include <ssphh/trace/scene_geometry.h>

#include "background_job.h"

namespace ssphh::viewer {

/// The first of methods::all_methods() that has this to draw.
const char* method_drawing(methods::Drawing what);

struct MarksParams {
  std::shared_ptr<const scene::Scene> scene;  ///< with its edits
  trace::SharedGeometry geometry;             ///< of its surfaces; null: it is built
  float time = 0;
  /// Found by method_drawing() with its default parameters.
  std::vector<methods::Drawing> what;
  sketch::Sketch own;  ///< drawn beside them: of the window's own light
  scene::CameraPose camera;
  image::Image picture;  ///< radiance, that they are drawn over
  image::ToneMap tone;
};

class Marks {
 public:
  /// Begins anew. Marks that were found for the same `what` are drawn again, until forget().
  void draw(MarksParams params);
  /// The scene, its light or its pose are others.
  void forget() { found_.reset(); }
  /// True when there is a new picture, or an error.
  bool poll() { return job_.poll(); }
  /// Stops, and has no picture.
  void clear();
  /// Display-ready, once done().
  const image::Rgba8& picture() const { return picture_; }
  bool done() const { return !picture_.rgba.empty(); }
  JobStatus status() const { return job_.status(); }
  /// Why the last picture failed, once; empty: it did not.
  std::string take_error() { return job_.take_error(); }

 private:
  struct Found {
    std::vector<methods::Drawing> what;
    sketch::Sketch marks;
  };
  std::shared_ptr<const Found> found_;
  image::Rgba8 picture_;
  BackgroundJob job_;
};

}  // namespace ssphh::viewer
