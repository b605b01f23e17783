#pragma once
/// The types of math.h without its functions: enough for headers that only hold vectors. GLM's types are
/// complete here up to four components; for a matrix or a quaternion as a member include its GLM header, or
/// math.h.

#include <glm/fwd.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace ssphh {

using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

static_assert(alignof(glm::vec4) == alignof(float),
              "ssphh is built with packed vectors: GLM_FORCE_DEFAULT_ALIGNED_GENTYPES would change what its "
              "functions take");

}  // namespace ssphh
