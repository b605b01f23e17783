#include <algorithm>
#include <tuple>

#include <ssphh/core/require.h>
#include <ssphh/lightmap/pack.h>

namespace ssphh::lightmap {
namespace {

/// The upper border of what is placed, from the left to the right: each step reaches to the next one's x.
struct Step {
  int x, y;
};

class Skyline {
 public:
  explicit Skyline(int width) : width_(width), steps_{{0, 0}} {}

  /// The lowest place for a rectangle of that width, of those the leftmost; its y is over `highest` where
  /// there is none.
  Step lowest(int width, int highest) const {
    Step best{0, highest + 1};
    for (std::size_t i = 0; i < steps_.size() && steps_[i].x + width <= width_; ++i) {
      int y = 0;
      for (std::size_t j = i; j < steps_.size() && steps_[j].x < steps_[i].x + width && y < best.y; ++j)
        y = std::max(y, steps_[j].y);
      if (y < best.y) best = {steps_[i].x, y};
    }
    return best;
  }

  void raise(int x, int width, int y) {
    const auto begin = std::ranges::find_if(steps_, [&](const Step& s) { return s.x >= x; }) - steps_.begin();
    std::size_t end = static_cast<std::size_t>(begin);
    int behind = 0;
    while (end < steps_.size() && steps_[end].x < x + width) behind = steps_[end++].y;
    const bool more = x + width < width_ && (end == steps_.size() || steps_[end].x > x + width);
    steps_.erase(steps_.begin() + begin, steps_.begin() + static_cast<std::ptrdiff_t>(end));
    auto at = steps_.insert(steps_.begin() + begin, {x, y});
    if (more) steps_.insert(at + 1, {x + width, behind});
  }

 private:
  int width_;
  std::vector<Step> steps_;
};

}  // namespace

std::optional<Packing> pack(std::span<const glm::ivec2> sizes, int width, int height) {
  for (const glm::ivec2& size : sizes)
    require(size.x > 0 && size.y > 0, "packing", "the size of a rectangle must be over 0");
  std::vector<std::size_t> order(sizes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return std::tuple(-sizes[a].y, -sizes[a].x, a) < std::tuple(-sizes[b].y, -sizes[b].x, b);
  });
  Packing out{std::vector<glm::ivec2>(sizes.size(), glm::ivec2(0)), 0};
  Skyline skyline(width);
  for (const std::size_t i : order) {
    const glm::ivec2 size = sizes[i];
    const Step at = skyline.lowest(size.x, height - size.y);
    if (size.x > width || at.y + size.y > height) return std::nullopt;
    out.at[i] = {at.x, at.y};
    out.height = std::max(out.height, at.y + size.y);
    skyline.raise(at.x, size.x, at.y + size.y);
  }
  return out;
}

}  // namespace ssphh::lightmap
