#include "frame_export.h"

#include <utility>

#include <fmt/format.h>

#include "app.h"
#include "model/frame_files.h"

namespace ssphh::viewer {

FrameExport::FrameExport(App& app, std::filesystem::path folder, double fps)
    : folder_(std::move(folder)),
      path_(app.bookmarks),
      fps_(fps),
      before_{"", 0, app.document.time, app.view},
      count_(1 + static_cast<int>(path_.duration() * fps)) {
  if (path_.empty()) throw Error(folder_.string(), "there are no bookmarks to draw", "add some with B");
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (!std::filesystem::is_directory(folder_))
    throw Error(folder_.string(), "cannot make this folder for the frames");
  // Turns of the window are as many as light in the background takes: the frames count.
  app.follows_exposure = false;
  app.walking = app.path_plays = app.settings.play = false;
  app.go_to(key());
}

CameraKey FrameExport::key() const {
  return at(path_, path_.keys.front().time + static_cast<float>(frame_ / fps_));
}

bool FrameExport::step(App& app) {
  if (!(app.view == key().view)) app.go_to(key());
  app.redraw();
  if (!app.current()) return false;
  if (frame_ == 0) {
    if (app.take_exposure()) return false;
  } else if (!std::exchange(followed_, true)) {
    if (app.follow_exposure()) return false;
  }
  if (!app.settled()) return false;
  app.screenshot((folder_ / frame_name(frame_)).string(), false);
  ++frame_;
  followed_ = false;
  if (frame_ < count_) {
    app.go_to(key());
    return false;
  }
  remove_frames_from(folder_, count_);
  return true;
}

void FrameExport::end(App& app) const {
  app.follows_exposure = true;
  app.go_to(before_);
}

void export_frames(App& app, const std::filesystem::path& folder, double fps) {
  stop_frames(app);
  FrameExport frames(app, folder, fps);
  app.frames.emplace(std::move(frames));
}

void continue_frames(App& app) {
  if (!app.frames) return;
  try {
    if (!app.frames->step(app)) return;
    const std::string where = std::filesystem::absolute(app.frames->folder()).string();
    const int count = app.frames->count();
    stop_frames(app);
    app.say(fmt::format("wrote {} frames in {}", count, where));
  } catch (const std::exception& e) {
    stop_frames(app);
    app.complain(e.what());
  }
}

void stop_frames(App& app) {
  if (!app.frames) return;
  const FrameExport frames = *std::exchange(app.frames, std::nullopt);
  if (app.scene_open()) frames.end(app);
}

}  // namespace ssphh::viewer
