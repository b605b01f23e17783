#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/core/error.h>
#include <ssphh/core/parse_number.h>
#include <ssphh/scene/placed_camera.h>

namespace ssphh::scene {
namespace {

constexpr float usual_yfov_degrees = 50;

std::optional<vec3> read_place(std::string_view text) {
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() != 3) return {};
  return vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

}  // namespace

std::optional<PlacedCamera> placed_camera(const std::string& text) {
  std::vector<std::string_view> parts;
  for (std::string_view left = text;;) {
    const std::size_t end = left.find(':');
    parts.push_back(left.substr(0, end));
    if (end == std::string_view::npos) break;
    left.remove_prefix(end + 1);
  }
  const std::optional<vec3> eye = read_place(parts[0]);
  if (!eye) return {};
  const std::optional<vec3> target = parts.size() > 1 ? read_place(parts[1]) : std::nullopt;
  const auto degrees = parts.size() > 2 ? parse_number<float>(parts[2]) : usual_yfov_degrees;
  if (!target || !degrees || parts.size() > 3)
    throw Error("camera " + text, "it cannot be read",
                "a camera that is placed is X,Y,Z:TO_X,TO_Y,TO_Z or X,Y,Z:TO_X,TO_Y,TO_Z:DEGREES");
  const vec3 way = *target - *eye;
  if (!(glm::dot(way, way) > 0) || !is_finite(glm::normalize(way)))
    throw Error("camera " + text, "it looks at the place where it stands");
  if (!(*degrees > 0 && *degrees < 180))
    throw Error("camera " + text, fmt::format("its field of view is {}°", *degrees),
                "it must lie between 0 and 180");
  CameraPose pose;
  const vec3 ahead = glm::normalize(way);
  const vec3 up = std::abs(ahead.y) < 0.9999f ? vec3(0, 1, 0) : vec3(0, 0, -1);
  pose.world = glm::inverse(glm::lookAt(*eye, *eye + ahead, up));
  pose.world[3] = vec4(*eye, 1);
  pose.camera.name = text;
  pose.camera.yfov = glm::radians(*degrees);
  return PlacedCamera{pose, glm::length(way)};
}

}  // namespace ssphh::scene
