#pragma once

#include <span>

#include <ssphh/gl/program.h>

namespace ssphh::realtime {

/// The shaders under shaders/, as built in.
std::span<const gl::ShaderFiles::Embedded> shader_table();

}  // namespace ssphh::realtime
