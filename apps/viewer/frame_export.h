#pragma once
/// A camera path as a sequence of pictures.

#include <filesystem>

#include "model/camera_path.h"

namespace ssphh::viewer {

class App;

/// Frames of the bookmarks of now, each once its light is complete, in a folder.
class FrameExport {
 public:
  /// Makes the folder and goes to the first frame. Throws Error where there is no path or no folder can be.
  FrameExport(App& app, std::filesystem::path folder, double fps);
  /// Call after every turn of the App, which shows the path meanwhile; writes a frame once it is whole. True
  /// once all are there; frames of an older, longer export are gone then.
  bool step(App& app);
  /// Back to the view and exposure of before.
  void end(App& app) const;
  int done() const { return frame_; }
  int count() const { return count_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  CameraKey key() const;

  std::filesystem::path folder_;
  CameraPath path_;
  double fps_;
  CameraKey before_;
  int frame_ = 0, count_;
  bool followed_ = false;  ///< the exposure went its way of this frame
};

/// Begins to draw the frames in the window, as App::frames. As FrameExport().
void export_frames(App& app, const std::filesystem::path& folder, double fps);
/// A turn of it; tells when it is done, and what went wrong.
void continue_frames(App& app);
void stop_frames(App& app);

}  // namespace ssphh::viewer
