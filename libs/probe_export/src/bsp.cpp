#include "bsp.h"

#include <algorithm>

namespace ssphh::probe_export {
namespace {

/// A plane through a point is off it by no more than this share of the extent.
constexpr float rounding = 1e-5f;
/// Faces tried at a node.
constexpr std::size_t most_tried = 24;

struct Plane {
  vec3 normal;
  float offset;
};

/// A face as one number: 4 · tetrahedron + the corner opposite.
using Face = std::int64_t;

class Builder {
 public:
  Builder(std::span<const vec3> points, std::span<const std::array<std::int32_t, 4>> tetrahedra)
      : points_(points), tetrahedra_(tetrahedra) {
    vec3 low = points[0], high = points[0];
    for (const vec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
    tolerance_ = rounding * max_component(high - low);
  }

  std::vector<BspNode> build() {
    std::vector<std::int32_t> all(tetrahedra_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int32_t>(i);
    if (all.size() == 1) {
      nodes_.push_back({{0, 1, 0}, 0, -1, -1});
    } else {
      child(all);
    }
    return std::move(nodes_);
  }

 private:
  const vec3& corner(std::int32_t t, int k) const {
    const std::int32_t index = tetrahedra_[t][k];
    return points_[index];
  }

  /// Of the face opposite of corner k, which is under it.
  Plane plane_of(Face face) const {
    const auto t = static_cast<std::int32_t>(face / 4);
    const int k = static_cast<int>(face % 4);
    const glm::dvec3 a(corner(t, (k + 1) % 4)), b(corner(t, (k + 2) % 4)), c(corner(t, (k + 3) % 4));
    glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    if (glm::dot(n, glm::dvec3(corner(t, k)) - a) > 0) n = -n;
    return {vec3(n), static_cast<float>(glm::dot(n, (a + b + c) / 3.0))};
  }

  /// 1: over, −1: under, 0: cut.
  int side(std::int32_t t, const Plane& plane) const {
    float low = 0, high = 0;
    for (int k = 0; k < 4; ++k) {
      const float d = glm::dot(plane.normal, corner(t, k)) - plane.offset;
      low = std::min(low, d), high = std::max(high, d);
    }
    if (low < -tolerance_ && high > tolerance_) return 0;
    return high > -low ? 1 : -1;
  }

  bool used(Face face) const { return std::ranges::find(path_, face) != path_.end(); }

  /// The face that leaves least on its fuller side; −1 where the first tetrahedron has none left: all of
  /// them are on the way here, so that this place is within it.
  Face choose(const std::vector<std::int32_t>& some) const {
    Face best = -1;
    std::size_t best_cost = some.size() * 4;
    const std::size_t step = std::max<std::size_t>(1, some.size() / most_tried);
    for (std::size_t i = 0; i < some.size(); i += step) {
      for (int k = 0; k < 4; ++k) {
        // One face of each where there are many to try.
        if (some.size() > most_tried && k != static_cast<int>(i / step % 4)) continue;
        const Face face = Face{some[i]} * 4 + k;
        if (used(face)) continue;
        const Plane plane = plane_of(face);
        std::size_t over = 0, under = 0;
        for (const std::int32_t t : some) {
          const int s = side(t, plane);
          over += s >= 0, under += s <= 0;
        }
        const std::size_t cost = std::max(over, under) * 2 + std::min(over, under);
        if (cost < best_cost) best = face, best_cost = cost;
      }
    }
    return best;
  }

  /// One whose faces are all on the way here.
  const std::int32_t* enclosing(const std::vector<std::int32_t>& some) const {
    for (const std::int32_t& t : some) {
      int count = 0;
      for (int k = 0; k < 4; ++k) count += used(Face{t} * 4 + k);
      if (count == 4) return &t;
    }
    return nullptr;
  }

  std::int32_t child(const std::vector<std::int32_t>& some) {
    if (some.empty()) return BspNode::empty;
    if (some.size() == 1) return -(some[0] + 1);
    if (const std::int32_t* t = path_.size() < 4 ? nullptr : enclosing(some)) return -(*t + 1);
    const Face face = choose(some);
    if (face < 0) return -(some[0] + 1);
    const Plane plane = plane_of(face);
    std::vector<std::int32_t> over, under;
    for (const std::int32_t t : some) {
      // By definition, so that rounding cannot lose it.
      const int s = t == face / 4 ? -1 : side(t, plane);
      if (s >= 0) over.push_back(t);
      if (s <= 0) under.push_back(t);
    }
    const auto index = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({plane.normal, plane.offset, BspNode::empty, BspNode::empty});
    path_.push_back(face);
    const std::int32_t above = child(over), below = child(under);
    path_.pop_back();
    nodes_[index].over = above;
    nodes_[index].under = below;
    return index;
  }

  std::span<const vec3> points_;
  std::span<const std::array<std::int32_t, 4>> tetrahedra_;
  float tolerance_;
  std::vector<Face> path_;
  std::vector<BspNode> nodes_;
};

}  // namespace

std::vector<BspNode> make_bsp(std::span<const vec3> points,
                              std::span<const std::array<std::int32_t, 4>> tetrahedra) {
  if (tetrahedra.empty()) return {};
  return Builder(points, tetrahedra).build();
}

}  // namespace ssphh::probe_export
