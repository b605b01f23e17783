#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/lamp_profile.h>

namespace ssphh::scene {
namespace {

void check_angles(const std::vector<float>& angles, float low, float high, const char* which,
                  const std::string& where) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!(angles[i] >= low && angles[i] <= high))
      throw Error(where,
                  fmt::format("its {} angle {} is not within {} to {} degrees", which, angles[i], low, high));
    if (i > 0 && !(angles[i] > angles[i - 1]))
      throw Error(where,
                  fmt::format("its {} angles do not rise: {} follows {}", which, angles[i], angles[i - 1]));
  }
}

/// An angle among rising ones: the last that is not above it, and the way to the next.
struct Place {
  std::size_t low, high;
  float share;
};
Place find(const std::vector<float>& angles, float angle) {
  const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
  if (above == angles.begin()) return {0, 0, 0};
  const auto low = static_cast<std::size_t>(above - angles.begin()) - 1;
  if (above == angles.end()) return {low, low, 0};
  return {low, low + 1, (angle - angles[low]) / (angles[low + 1] - angles[low])};
}

}  // namespace

void check_profile(const PhotometricTable& table, const std::string& where) {
  const std::size_t rows = table.polar.size(), columns = table.turn.size();
  if (rows < 2 || columns < 1)
    throw Error(where,
                fmt::format("its profile has {} by {} angles, at least 2 by 1 are needed", rows, columns));
  if (rows > max_profile_values || columns > max_profile_values / rows)
    throw Error(where, fmt::format("its profile has {} by {} angles, {} intensities are the most", rows,
                                   columns, max_profile_values));
  if (table.candela.size() != rows * columns)
    throw Error(where, fmt::format("its profile has {} intensities for {} by {} angles", table.candela.size(),
                                   rows, columns));
  check_angles(table.polar, 0, 180, "polar", where);
  check_angles(table.turn, -180, 360, "turn", where);
  if (columns > 1 && table.turn.back() - table.turn.front() > 360)
    throw Error(where, "its turn angles span more than 360 degrees");
  for (const float value : table.candela)
    if (!(std::isfinite(value) && value >= 0))
      throw Error(where, fmt::format("its profile has an intensity of {} cd", value));
  if (!(greatest_candela(table) > 0)) throw Error(where, "its profile is dark in every direction");
}

mat3 photometric_axes(Photometry type) {
  const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  if (type == Photometry::b) return {-z, y, -x};
  if (type == Photometry::a) return {-z, x, -y};
  return {x, y, -z};
}

float eval_candela(const PhotometricTable& table, const vec3& direction) {
  const vec2 across(direction);
  const float polar = glm::degrees(std::atan2(glm::length(across), direction.z));
  // A direction along the first or the last angle counts as within, whatever its last bit.
  constexpr float slack = 1e-4f;
  if (polar < table.polar.front() - slack || polar > table.polar.back() + slack) return 0;
  const Place row = find(table.polar, polar);
  const auto at = [&](std::size_t column) {
    const float* values = table.candela.data() + column * table.polar.size();
    return glm::mix(values[row.low], values[row.high], row.share);
  };
  if (table.turn.size() == 1) return at(0);
  float turn = across == vec2(0) ? 0 : glm::degrees(std::atan2(across.y, across.x));
  if (turn < table.turn.front() - slack) turn += 360;
  if (turn < table.turn.front() - slack || turn > table.turn.back() + slack) return 0;
  const Place column = find(table.turn, turn);
  return glm::mix(at(column.low), at(column.high), column.share);
}

float greatest_candela(const PhotometricTable& table) {
  return *std::ranges::max_element(table.candela);
}

float mean_candela(const PhotometricTable& table) {
  // Along a column, (a + bθ) sin θ has a closed form; between columns the mean of both counts.
  const auto column = [&](std::size_t j) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < table.polar.size(); ++i) {
      const double from = glm::radians(static_cast<double>(table.polar[i])),
                   to = glm::radians(static_cast<double>(table.polar[i + 1]));
      const double low = table.candela[j * table.polar.size() + i],
                   high = table.candela[j * table.polar.size() + i + 1];
      const double slope = (high - low) / (to - from);
      sum += low * std::cos(from) - high * std::cos(to) + slope * (std::sin(to) - std::sin(from));
    }
    return sum;
  };
  if (table.turn.size() == 1) return static_cast<float>(column(0) / 2);
  double sum = 0;
  for (std::size_t j = 0; j + 1 < table.turn.size(); ++j)
    sum += (column(j) + column(j + 1)) / 2 * static_cast<double>(table.turn[j + 1] - table.turn[j]) / 360;
  return static_cast<float>(sum / 2);
}

}  // namespace ssphh::scene
