#pragma once
/// Places on the surfaces within a cell, and which of them a point may light.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include <ssphh/rays/surface_point.h>

namespace ssphh::probes {

/// Numbers lie by kind, and loops over them have no branches: all places of a cell, for each point near it,
/// are what lists cost.
class SurfaceSamples {
 public:
  /// Of a point at one of the places.
  enum Verdict : std::int32_t { out_of_reach, outweighed, asked };

  void clear();
  /// `local`: where the position is in the cell, from 0 to 1.
  void add(const vec3& position, const vec3& normal, const vec3& local);

  std::size_t size() const { return verdicts_.size(); }
  vec3 position(std::size_t i) const { return {numbers_[0][i], numbers_[1][i], numbers_[2][i]}; }
  /// Of one side; the other's is −normal.
  vec3 normal(std::size_t i) const { return {numbers_[3][i], numbers_[4][i], numbers_[5][i]}; }
  /// The bit of the part of the cell, cut so, in which it lies.
  std::uint64_t part(std::size_t i, int cut) const { return std::uint64_t{1} << parts_[i][cut]; }
  /// 1 where a normal faces the other side's way.
  std::size_t side(std::size_t i, const vec3& n) const { return glm::dot(normal(i), n) < 0; }

  /// Whether a point may light the places, and is not outweighed there by those counted in.
  void judge(const rays::SurfacePoint& point, float spacing);
  Verdict verdict(std::size_t i) const { return static_cast<Verdict>(verdicts_[i]); }
  /// Finds what a point counts at the places.
  void weigh(const rays::SurfacePoint& point, float spacing, int cover);
  /// Counts in the point that was weighed last, whether it is seen from there or, unless that is `known`,
  /// seems to be.
  void count_in(std::size_t i, std::size_t side, float spacing, bool seen, bool known) {
    asked_[side][i] += weights_[i];
    if (weights_[i] > 0) finest_[side][i] = std::min(finest_[side][i], spacing);
    if (!seen) return;
    if (known) finest_seen_[side][i] = std::min(finest_seen_[side][i], spacing);
    numbers_[6 + side][i] += weights_[i];
  }

  /// Whether points that face this side's way are seen from there, not much coarser ones than the finest that
  /// may light it, and count for something beside those that are not. What sees none lies within a body, or
  /// in its very edge, and has no say: far points of a plain would be seen from under a house.
  bool alive(std::size_t i, std::size_t side) const {
    constexpr float least = 0.005f, most_coarser = 8;
    return finest_seen_[side][i] < far && finest_seen_[side][i] <= most_coarser * finest_[side][i] &&
           numbers_[6 + side][i] >= least * asked_[side][i];
  }

  /// What `find` tells of a side, asked once.
  template <class Find>
  bool narrow(std::size_t i, std::size_t side, const Find& find) {
    std::uint8_t& known = narrow_[side][i];
    if (known == 0) known = find() ? 2 : 1;
    return known == 2;
  }
  /// What `find` tells of the height above a side, not less than 0, asked once.
  template <class Find>
  float headroom(std::size_t i, std::size_t side, const Find& find) {
    float& known = headroom_[side][i];
    if (known < 0) known = find();
    return known;
  }

 private:
  static constexpr float far = std::numeric_limits<float>::infinity();
  /// Position, normal, and the weight of what is counted on either side.
  std::array<std::vector<float>, 8> numbers_;
  std::vector<std::array<std::uint8_t, 4>> parts_;          ///< of each cut
  std::array<std::vector<std::uint8_t>, 2> narrow_;         ///< of each side; 0 where nobody asked
  std::array<std::vector<float>, 2> headroom_;              ///< of each side; under 0 where nobody asked
  std::array<std::vector<float>, 2> finest_, finest_seen_;  ///< spacings of each side's points [m]
  std::vector<std::int32_t> verdicts_;
  std::vector<float> weights_;
  std::array<std::vector<float>, 2> asked_;  ///< weight on either side of all, seen or not
};

}  // namespace ssphh::probes
