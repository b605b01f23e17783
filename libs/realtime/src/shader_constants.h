#pragma once

#include <string>

namespace ssphh::realtime {

/// Numbers that shaders share with C++, from the headers where these stand: a line `#define NAME VALUE` for
/// each, put before every shader.
const std::string& shader_constants();

}  // namespace ssphh::realtime
