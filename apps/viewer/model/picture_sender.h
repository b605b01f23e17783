#pragma once
/// Pictures that another program shows, handed to it in the background: it may be slow, or not there.

#include <functional>
#include <map>
#include <memory>
#include <string>

#include <ssphh/image/image.h>

#include "background_job.h"

namespace ssphh::viewer {

/// Shows linear radiance under that name somewhere else, in place of what was shown under it before; empty
/// text, or why it is not shown. Called from one thread at a time.
using ShowElsewhere = std::function<std::string(const std::string& name, const image::Image& picture)>;

class PictureSender {
 public:
  explicit PictureSender(ShowElsewhere show) : show_(std::move(show)) {}

  /// Whether there is anybody to show it.
  explicit operator bool() const { return static_cast<bool>(show_); }
  /// Shows it as soon as what is under way is done, unless another one of that name comes before.
  void send(const std::string& name, std::shared_ptr<const image::Image> picture);
  /// Goes on with what waits. Returns why a picture was not shown, once until one is again; empty: nothing to
  /// tell.
  std::string poll();
  bool idle() const { return waiting_.empty() && job_.idle(); }

 private:
  void begin();

  ShowElsewhere show_;
  std::map<std::string, std::shared_ptr<const image::Image>> waiting_;  ///< by name
  std::string problem_;                                                 ///< that was told last
  std::string news_;
  BackgroundJob job_;
};

}  // namespace ssphh::viewer
