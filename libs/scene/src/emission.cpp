#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/emission.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::scene {

void check_emission(const Emission& emission, const std::string& where) {
  const std::size_t count = emission.frames.size();
  if (count == 0) throw Error(where, "its emission has no frame");
  if (count > max_emission_frames)
    throw Error(where, fmt::format("its emission has {} frames, {} is the most", count, max_emission_frames));
  const int degree = emission.frames[0].degree();
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<vec3>& values = emission.frames[i].values;
    const std::string frame = count > 1 ? fmt::format("frame {} of its emission", i) : "its emission";
    if (emission.frames[i].degree() != degree || values.empty() ||
        static_cast<std::size_t>(sh::coefficient_count(degree)) != values.size() || degree > sh::max_degree) {
      throw Error(where, fmt::format("{} has {} coefficients", frame, values.size()),
                  "every frame has (degree + 1)² of them, of one degree from 0 to 10");
    }
    if (!std::ranges::all_of(values, is_finite)) throw Error(where, frame + " is not finite");
  }
  if (!std::isfinite(emission.rate) || !std::isfinite(emission.start) || emission.rate < 0 ||
      (count > 1 && !(emission.rate > 0)) || !std::isfinite(emission_end(emission))) {
    throw Error(where, fmt::format("its emission has {} frames at {} per second from {} s", count,
                                   emission.rate, emission.start));
  }
}

sh::IntensitySh emission_at(const Emission& emission, float time) {
  if (emission.frames.empty()) return {};
  const auto count = static_cast<double>(emission.frames.size());
  if (count == 1) return emission.frames[0];
  double place =
      (static_cast<double>(time) - static_cast<double>(emission.start)) * static_cast<double>(emission.rate);
  if (emission.repeat) {
    place = std::fmod(place, count);  // exact, however far away
    if (place < 0) place += count;
    if (!(place < count)) place = 0;  // by rounding
  } else {
    place = std::clamp(place, 0.0, count - 1);
  }
  const auto k = static_cast<std::size_t>(place);
  const auto s = static_cast<float>(place - static_cast<double>(k));
  sh::IntensitySh result = emission.frames[k];
  if (s == 0) return result;
  const sh::IntensitySh& next = emission.frames[(k + 1) % emission.frames.size()];
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] += s * (next.values[i] - result.values[i]);
  return result;
}

float emission_end(const Emission& emission) {
  const std::size_t count = emission.frames.size();
  if (count < 2 || !(emission.rate > 0)) return 0;
  return emission.start + static_cast<float>(emission.repeat ? count : count - 1) / emission.rate;
}

vec3 eval_intensity(const sh::IntensitySh& emission, const vec3& direction) {
  std::array<float, sh::max_coefficient_count> basis;
  sh::eval_basis(emission.degree(), direction, basis);
  vec3 sum(0);
  for (std::size_t k = 0; k < emission.values.size(); ++k) sum += basis[k] * emission.values[k];
  return glm::max(sum, vec3(0));
}

mat3 emission_axes(const mat4& world) {
  mat3 axes(1);
  for (int i = 0; i < 3; ++i) {
    const float length = glm::length(vec3(world[i]));
    if (length > 0) axes[i] = vec3(world[i]) / length;
  }
  return axes;
}

vec3 mean_intensity(const sh::IntensitySh& emission) {
  if (emission.empty()) return vec3(0);
  return glm::max(emission.values[0] / std::sqrt(4 * pi), vec3(0));
}

sh::IntensitySh lobe_emission(Lobe lobe, const vec3& axis, float half_angle) {
  if (!is_finite(axis) || !(std::abs(glm::length(axis) - 1) < 1e-3f))
    throw Error("lobe", "its axis must be a unit vector");
  if (lobe == Lobe::beam && !(half_angle >= narrowest_beam && half_angle <= pi)) {
    throw Error("lobe", fmt::format("a beam of half angle {:.3g}°", glm::degrees(half_angle)),
                "15° to 180° can be shown by spherical harmonics of degree 10");
  }
  sh::ZonalSh zonal;
  if (lobe == Lobe::uniform) {
    zonal = sh::zonal_from_function(0, [](double) { return 1.0; });
  } else if (lobe == Lobe::cosine) {
    zonal = sh::zonal_cosine_lobe(sh::max_degree);
  } else {
    const double kappa = std::log(2.0) / (1 - std::cos(static_cast<double>(half_angle)));
    zonal = sh::zonal_from_function(sh::max_degree,
                                    [&](double cosine) { return std::exp(kappa * (cosine - 1)); });
  }
  std::vector<float> values(zonal.size() * zonal.size());
  sh::rotate_zonal(zonal, glm::normalize(axis), values);
  sh::IntensitySh result;
  for (const float v : values) result.values.emplace_back(v);
  return result;
}

}  // namespace ssphh::scene
