#pragma once
/// A triangle that covers the whole picture, drawn as three vertices without buffers.

#include <string_view>

namespace ssphh::viewer {

inline constexpr std::string_view whole_picture = R"(#version 450 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

}  // namespace ssphh::viewer
