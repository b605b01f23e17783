#include "profile_intensity.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/sphere.h>

namespace ssphh::shading {
namespace {

/// Steps by which the mean within a cone is summed.
constexpr int fine_rows = 720, fine_columns = 72;

vec3 direction_of(float z, float turn) {
  return {std::sqrt(glm::max(1 - z * z, 0.0f)) * vec2(std::cos(turn), std::sin(turn)), z};
}

}  // namespace

float ConeFalloff::at(float cosine) const {
  if (!(scale > 0)) return 1;
  const float ramp = glm::clamp(cosine * scale + offset, 0.0f, 1.0f);
  return ramp * ramp;
}

ConeFalloff cone_falloff(const scene::Light& spot) {
  const float cos_outer = std::cos(spot.outer_cone);
  const float scale = 1 / glm::max(0.001f, std::cos(spot.inner_cone) - cos_outer);
  return {scale, -cos_outer * scale};
}

ProfileTable::ProfileTable(const scene::Light& light)
    : table_(light.profile.table),
      axes_(scene::photometric_axes(table_->type)),
      aim_(vec3(0, 0, -1) * axes_),
      scale_(1 / scene::greatest_candela(*table_)) {
  const bool spot = light.type == scene::LightType::spot;
  if (spot) cone_ = cone_falloff(light);
  const std::size_t height = table_->polar.size(), columns = table_->turn.size();
  for (const float polar : table_->polar) z_.push_back(std::cos(glm::radians(polar)));
  for (const float turn : table_->turn) turn_.push_back(glm::radians(turn));
  if (columns == 1) turn_ = {0, 2 * pi};
  const std::size_t width = turn_.size() - 1;
  const auto value = [&](std::size_t column, std::size_t row) {
    return table_->candela[std::min(column, columns - 1) * height + row];
  };
  std::vector<float> weights(width * (height - 1));
  for (std::size_t cell = 0; cell < weights.size(); ++cell) {
    const std::size_t row = cell / width, column = cell % width;
    weights[cell] =
        solid_angle(cell) * scale_ * 0.25f *
        (value(column, row) + value(column, row + 1) + value(column + 1, row) + value(column + 1, row + 1));
    // About the aim, the cone leaves most at the row's upper edge.
    if (table_->type == scene::Photometry::c) weights[cell] *= cone_.at(z_[row]);
  }
  cells_ = Distribution(weights);
  mean_ = scene::mean_candela(*table_) * scale_;
  if (!spot) return;
  double sum = 0;
  for (int row = 0; row < fine_rows; ++row) {
    const float polar = pi * (static_cast<float>(row) + 0.5f) / fine_rows;
    for (int column = 0; column < fine_columns; ++column) {
      const float turn = 2 * pi * (static_cast<float>(column) + 0.5f) / fine_columns;
      sum += static_cast<double>(std::sin(polar) * toward(direction_of(std::cos(polar), turn)));
    }
  }
  mean_ = static_cast<float>(sum * pi_d / (2.0 * fine_rows * fine_columns));
}

float ProfileTable::solid_angle(std::size_t cell) const {
  const std::size_t width = turn_.size() - 1, row = cell / width, column = cell % width;
  return (z_[row] - z_[row + 1]) * (turn_[column + 1] - turn_[column]);
}

float ProfileTable::toward(const vec3& local) const {
  const float cone = cone_.at(glm::dot(aim_, local));
  return cone > 0 ? cone * scale_ * scene::eval_candela(*table_, local) : 0;
}

LampShape::Direction ProfileTable::sample(const vec2& u) const {
  if (cells_.empty()) return {vec3(0, 0, 1), 1};  // dark within its cones
  const Distribution::Choice choice = cells_.sample(u.x);
  const std::size_t width = turn_.size() - 1, row = choice.index / width, column = choice.index % width;
  const float z = glm::mix(z_[row], z_[row + 1], choice.u);
  const float turn = glm::mix(turn_[column], turn_[column + 1], u.y);
  return {direction_of(z, turn), choice.probability / solid_angle(choice.index)};
}

float ProfileTable::pdf(const vec3& local) const {
  if (cells_.empty()) return 0;
  constexpr float slack = 1e-6f;  // a direction along the first or the last angle counts as within
  if (local.z > z_.front() + slack || local.z < z_.back() - slack) return 0;
  float turn = std::atan2(local.y, local.x);
  if (turn < turn_.front() - slack) turn += 2 * pi;
  if (turn < turn_.front() - slack || turn > turn_.back() + slack) return 0;
  // The first edge beyond the direction, among those that end a cell
  const auto row = std::upper_bound(z_.begin() + 1, z_.end() - 1, local.z, std::greater<>()) - z_.begin() - 1;
  const auto column = std::upper_bound(turn_.begin() + 1, turn_.end() - 1, turn) - turn_.begin() - 1;
  const std::size_t cell =
      static_cast<std::size_t>(row) * (turn_.size() - 1) + static_cast<std::size_t>(column);
  const float extent = solid_angle(cell);
  return extent > 0 ? cells_.probability(cell) / extent : 0;
}

}  // namespace ssphh::shading
