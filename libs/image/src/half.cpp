#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <ssphh/core/error.h>
#include <ssphh/image/half.h>

namespace ssphh::image {

std::uint16_t to_half(float value, const char* what) {
  constexpr float most = 65504;
  if (!(std::abs(value) <= most)) {
    throw Error(what, fmt::format("{:g} is more than a half float holds", value),
                "scale the scene's lights down, and the engine's exposure up");
  }
  return glm::packHalf1x16(value);
}

}  // namespace ssphh::image
