#include "picture_sender.h"

#include <utility>

namespace ssphh::viewer {

void PictureSender::send(const std::string& name, std::shared_ptr<const image::Image> picture) {
  waiting_[name] = std::move(picture);
  if (job_.idle()) begin();
}

void PictureSender::begin() {
  job_.start("showing", [this, show = show_, pictures = std::exchange(waiting_, {})](const Control& control) {
    std::string problem;
    for (const auto& [name, picture] : pictures) {
      control.check();
      if (std::string text = show(name, *picture); !text.empty()) problem = std::move(text);
    }
    return [this, problem] {
      if (problem != problem_) news_ = problem;
      problem_ = problem;
    };
  });
}

std::string PictureSender::poll() {
  job_.poll();
  if (!waiting_.empty() && job_.idle()) begin();
  return std::exchange(news_, {});
}

}  // namespace ssphh::viewer
