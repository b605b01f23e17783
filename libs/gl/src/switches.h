#pragma once

#include <array>
#include <span>

#include <epoxy/gl.h>

namespace ssphh::gl {

/// What glEnable and glDisable are called for, apart from what each attachment or viewport has of its own.
/// The first are off in every pass, which they would disturb.
inline constexpr std::array changed_switches{GL_FRAMEBUFFER_SRGB,
                                             GL_RASTERIZER_DISCARD,
                                             GL_COLOR_LOGIC_OP,
                                             GL_POLYGON_OFFSET_FILL,
                                             GL_DEPTH_CLAMP,
                                             GL_SAMPLE_MASK,
                                             GL_SAMPLE_ALPHA_TO_COVERAGE,
                                             GL_PRIMITIVE_RESTART,
                                             GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                             GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                             GL_DEPTH_TEST,
                                             GL_CULL_FACE,
                                             GL_STENCIL_TEST};
inline constexpr std::span unwanted_switches = std::span(changed_switches).first<9>();

}  // namespace ssphh::gl
