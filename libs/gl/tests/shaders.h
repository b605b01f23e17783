#pragma once
/// Small programs, and what they compute or draw.

#include <array>
#include <string>
#include <vector>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/program.h>
#include <ssphh/gl/vertex_array.h>

#include "gl_context.h"

namespace ssphh::gl {

class WithShaders : public test::WithGl {
 protected:
  static Program compute_program(const std::string& declarations, const std::string& value) {
    const std::string source = "#version 450 core\nlayout(local_size_x = 1) in;\n" + declarations +
                               "\nlayout(rgba32f, binding = 0) writeonly uniform image2D made;\n"
                               "void main() { int i = int(gl_WorkGroupID.x);\n"
                               "  imageStore(made, ivec2(i, 0), vec4(" +
                               value + ")); }\n";
    const std::array<ShaderFiles::Embedded, 1> table{{{"make.comp", source}}};
    return Program::compute(ShaderFiles(table), "make.comp", "");
  }
  static std::vector<vec4> run(const Program& program, int count) {
    Texture made(Format::rgba32f, count, 1);
    made.bind_image(0);
    program.use();
    const std::array<unsigned, 3> groups{static_cast<unsigned>(count), 1, 1};
    dispatch(Buffer{std::span<const unsigned>(groups)});
    shader_memory_barrier();
    std::vector<vec4> texels(static_cast<std::size_t>(count));
    made.read({&texels[0].x, 4 * texels.size()}, 4);
    return texels;
  }
  /// What a compute shader makes for each of `count` texels: `value`, an expression of `i`.
  static std::vector<vec4> computed(int count, const std::string& declarations, const std::string& value) {
    return run(compute_program(declarations, value), count);
  }

  /// Vertices at `place`, an expression of gl_VertexID; everything drawn has the uniform `color`.
  static Program paint_program(const std::string& place, const std::string& declarations = "") {
    const std::string vertex = "#version 450 core\n" + declarations +
                               "\nuniform float depth;\n"
                               "void main() { gl_Position = vec4(" +
                               place + ", depth, 1); }\n";
    const std::array<ShaderFiles::Embedded, 2> table{
        {{"place.vert", vertex},
         {"paint.frag",
          "#version 450 core\nuniform vec4 color;\nlayout(location = 0) out vec4 painted;\n"
          "void main() { painted = color; }\n"}}};
    return Program(ShaderFiles(table), "place.vert", "paint.frag");
  }
  /// A triangle that covers everything, counterclockwise, or clockwise.
  static Program whole_picture(bool clockwise = false) {
    const std::string second = clockwise ? "2" : "1", third = clockwise ? "1" : "2";
    return paint_program("vec2(gl_VertexID == " + second + " ? 3 : -1, gl_VertexID == " + third +
                         " ? 3 : -1)");
  }
  static std::vector<vec4> texels_of(const Texture& texture) {
    std::vector<vec4> texels(
        static_cast<std::size_t>(texture.width() * texture.height() * std::max(texture.layers(), 1)));
    texture.read({&texels[0].x, 4 * texels.size()}, 4);
    return texels;
  }
  static std::vector<float> floats_of(const Texture& texture) {
    std::vector<float> texels(
        static_cast<std::size_t>(texture.width() * texture.height() * std::max(texture.layers(), 1)));
    texture.read(texels, 1);
    return texels;
  }
  static std::vector<float> floats(int count, float first) {
    std::vector<float> all;
    for (int i = 0; i < count; ++i) all.push_back(first + static_cast<float>(i));
    return all;
  }
  template <class T>
  static std::span<const std::byte> bytes(const std::vector<T>& data) {
    return std::as_bytes(std::span(data));
  }
};

}  // namespace ssphh::gl
