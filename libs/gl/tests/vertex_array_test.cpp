/// Where vertices and corners may lie, and how a vertex array reads them.

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <ssphh/gl/vertex_array.h>

#include "error_message.h"
#include "gl_context.h"

namespace ssphh::gl {
namespace {

class GlVertexArray : public test::WithGl {
 protected:
  static std::string said(const VertexSource& source, int components, std::size_t vertices) {
    return test::message_of([&] { check_source(source, components, vertices, "positions"); });
  }
  static std::string said(const IndexSource& source, std::size_t corners) {
    return test::message_of([&] { check_source(source, corners, "corners"); });
  }
};

TEST_F(GlVertexArray, AttributesLieWithinTheirBuffer) {
  const Buffer buffer(100);
  const unsigned id = buffer.id();
  // 7 vertices of 12 bytes, 14 apart, from byte 4 on: 4 + 6 · 14 + 12 = 100
  EXPECT_EQ(said({id, 4, 16, Component::f32}, 3, 6), "no error");
  EXPECT_EQ(said({id, 4, 14, Component::f16}, 6, 7), "no error");
  EXPECT_EQ(said({id, 4, 14, Component::f16}, 6, 8),
            "positions: 110 bytes from byte 4 on are needed; buffer " + std::to_string(id) + " has 100");
  EXPECT_EQ(said({id, 6, 14, Component::f16}, 6, 7),
            "positions: 96 bytes from byte 6 on are needed; buffer " + std::to_string(id) + " has 100");
  EXPECT_EQ(said({id, 100, 14, Component::f16}, 6, 0), "no error") << "no vertex, right at the end";
  EXPECT_THAT(said({id, 102, 14, Component::f16}, 6, 0), testing::HasSubstr("0 bytes from byte 102 on"));
  EXPECT_EQ(said({id, 0, 0, Component::f32}, 25, 1000), "no error") << "all have the same";
}

TEST_F(GlVertexArray, AttributesAreAlignedToTheirNumbers) {
  const Buffer buffer(4096);
  struct Case {
    Component type;
    std::size_t bytes;
  };
  for (const auto& [type, bytes] : {Case{Component::f32, 4},
                                    {Component::f16, 2},
                                    {Component::snorm8, 1},
                                    {Component::unorm8, 1},
                                    {Component::snorm16, 2},
                                    {Component::unorm16, 2},
                                    {Component::snorm10, 4}}) {
    const std::size_t one = type == Component::snorm10 ? 4 : 3 * bytes;
    EXPECT_EQ(said({buffer.id(), bytes, 4 * bytes, type}, 3, 2), "no error");
    EXPECT_EQ(said({buffer.id(), 4096 - one, 4 * bytes, type}, 3, 1), "no error");
    EXPECT_NE(said({buffer.id(), 4096 - one + bytes, 4 * bytes, type}, 3, 1), "no error");
    if (bytes == 1) continue;
    EXPECT_EQ(said({buffer.id(), bytes / 2, 4 * bytes, type}, 3, 2),
              "positions: they begin at byte " + std::to_string(bytes / 2) + ", which is no multiple of " +
                  std::to_string(bytes));
    EXPECT_THAT(said({buffer.id(), 0, bytes + bytes / 2, type}, 3, 2),
                testing::HasSubstr("it must be a multiple of " + std::to_string(bytes)));
  }
  GLint most = 0;
  glGetIntegerv(GL_MAX_VERTEX_ATTRIB_STRIDE, &most);
  const auto stride = static_cast<std::size_t>(most) / 4 * 4;
  EXPECT_EQ(said({buffer.id(), 0, stride, Component::f32}, 3, 1), "no error");
  EXPECT_THAT(said({buffer.id(), 0, stride + 4, Component::f32}, 3, 1), testing::HasSubstr("the stride is"));
  EXPECT_THAT(said({buffer.id(), 0, 4, static_cast<Component>(7)}, 3, 1),
              testing::HasSubstr("there is no component 7"));
  EXPECT_EQ(said({0, 0, 12, Component::f32}, 3, 1), "positions: OpenGL has no buffer of number 0");
  EXPECT_EQ(said({987654, 0, 12, Component::f32}, 3, 1), "positions: OpenGL has no buffer of number 987654");
}

TEST_F(GlVertexArray, CornersLieWithinTheirBuffer) {
  const Buffer buffer(60);
  for (const auto& [type, bytes] : {std::pair(Index::u8, 1u), {Index::u16, 2u}, {Index::u32, 4u}}) {
    EXPECT_EQ(size_of(type), bytes);
    EXPECT_EQ(said({buffer.id(), 12, type}, 48 / bytes), "no error");
    EXPECT_NE(said({buffer.id(), 12, type}, 48 / bytes + 1), "no error");
    if (bytes > 1) {
      EXPECT_THAT(said({buffer.id(), bytes / 2, type}, 3),
                  testing::HasSubstr("no multiple of " + std::to_string(bytes)));
    }
  }
}

TEST_F(GlVertexArray, IsToldOfEachAttribute) {
  const Buffer buffer(256), corners(64);
  VertexArray array;
  struct Case {
    Component type;
    int components, told;
    GLint gl, normalized;
  };
  const Case cases[] = {{Component::f32, 3, 3, GL_FLOAT, 0},
                        {Component::f16, 2, 2, GL_HALF_FLOAT, 0},
                        {Component::snorm8, 4, 4, GL_BYTE, 1},
                        {Component::unorm8, 3, 3, GL_UNSIGNED_BYTE, 1},
                        {Component::snorm16, 2, 2, GL_SHORT, 1},
                        {Component::unorm16, 1, 1, GL_UNSIGNED_SHORT, 1},
                        {Component::snorm10, 3, 4, GL_INT_2_10_10_10_REV, 1}};
  for (unsigned i = 0; i < std::size(cases); ++i)
    array.attribute(i, {buffer.id(), 4 * i, 8 + 4 * i, cases[i].type}, cases[i].components);
  array.indices(corners.id());
  array.bind();
  GLint id = 0;
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &id);
  const auto vertex_array = static_cast<GLuint>(id);
  for (unsigned i = 0; i < std::size(cases); ++i) {
    const auto told = [&](GLenum query) {
      GLint value = -1;
      glGetVertexArrayIndexediv(vertex_array, i, query, &value);
      return value;
    };
    EXPECT_EQ(told(GL_VERTEX_ATTRIB_ARRAY_ENABLED), 1) << i;
    EXPECT_EQ(told(GL_VERTEX_ATTRIB_ARRAY_SIZE), cases[i].told) << i;
    EXPECT_EQ(told(GL_VERTEX_ATTRIB_ARRAY_TYPE), cases[i].gl) << i;
    EXPECT_EQ(told(GL_VERTEX_ATTRIB_ARRAY_NORMALIZED), cases[i].normalized) << i;
    EXPECT_EQ(told(GL_VERTEX_ATTRIB_RELATIVE_OFFSET), 0) << i;
    GLint64 offset = -1;
    glGetVertexArrayIndexed64iv(vertex_array, i, GL_VERTEX_BINDING_OFFSET, &offset);
    EXPECT_EQ(offset, 4 * i);
    GLint stride = 0;
    glGetIntegeri_v(GL_VERTEX_BINDING_STRIDE, i, &stride);
    EXPECT_EQ(stride, static_cast<GLint>(8 + 4 * i)) << i;
  }
  GLint element = 0;
  glGetVertexArrayiv(vertex_array, GL_ELEMENT_ARRAY_BUFFER_BINDING, &element);
  EXPECT_EQ(static_cast<unsigned>(element), corners.id());
  glBindVertexArray(0);
  EXPECT_NO_THROW(gl().throw_on_error("vertices"));
}

}  // namespace
}  // namespace ssphh::gl
