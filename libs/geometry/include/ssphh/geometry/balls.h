#pragma once
/// Which of many balls hold a place, or touch a box.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <ssphh/core/math.h>
#include <ssphh/geometry/box.h>

namespace ssphh::geometry {

/// A tree of boxes around balls of any sizes: the middle of a range splits it across its longest side, down
/// to a few balls.
class Balls {
 public:
  /// Throws Error for a ball that is not finite, or has a negative radius, and for unequal numbers of both.
  Balls(std::span<const vec3> centres, std::span<const float> radii);

  /// Calls `use(ball, squared distance of its centre)` for each ball whose centre is nearer to x than its
  /// radius; in the same order for the same balls and x.
  template <class Use>
  void visit(const vec3& x, const Use& use) const {
    visit(0, items_.size(), Place{x}, use);
  }
  /// Calls `use` so for each ball whose centre is nearer to the box from `low` to `high` than its radius.
  template <class Use>
  void visit_box(const vec3& low, const vec3& high, const Use& use) const {
    visit(0, items_.size(), Region{low, high}, use);
  }
  std::size_t count() const { return items_.size(); }
  std::size_t bytes() const;

 private:
  static constexpr std::size_t leaf = 8, step = leaf / 2;  ///< no two middles are nearer than `step`
  struct Item {
    vec3 centre;
    float radius2;
    std::uint32_t ball;
  };
  struct Box {
    vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
  };
  /// What is asked for: each tells its nearest place to another, and whether a box has none of it.
  struct Place {
    vec3 x;
    const vec3& nearest(const vec3&) const { return x; }
    bool misses(const Box& box) const { return apart(x, x, box.low, box.high); }
  };
  struct Region {
    vec3 low, high;
    vec3 nearest(const vec3& to) const { return glm::clamp(to, low, high); }
    bool misses(const Box& box) const { return apart(low, high, box.low, box.high); }
  };
  Box sort(std::size_t begin, std::size_t end, std::span<const float> radii);

  template <class Asked, class Use>
  void visit(std::size_t begin, std::size_t end, const Asked& asked, const Use& use) const {
    if (end - begin <= leaf) {
      for (std::size_t i = begin; i < end; ++i) {
        const Item& item = items_[i];
        const vec3 d = item.centre - asked.nearest(item.centre);
        if (const float d2 = glm::dot(d, d); d2 < item.radius2) use(item.ball, d2);
      }
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    if (asked.misses(boxes_[middle / step])) return;
    visit(begin, middle, asked, use);
    visit(middle, end, asked, use);
  }

  std::vector<Item> items_;
  std::vector<Box> boxes_;  ///< at the middle of each range that is split, over `step`
};

}  // namespace ssphh::geometry
