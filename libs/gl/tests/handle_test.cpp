/// What an object owned is gone from the driver when the object is.

#include <vector>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/texture.h>
#include <ssphh/gl/vertex_array.h>
#include <ssphh/gl/volume.h>

#include "shaders.h"

namespace ssphh::gl {
namespace {

using GlHandle = WithShaders;

unsigned bound(unsigned what) {
  int id = 0;
  glGetIntegerv(what, &id);
  return static_cast<unsigned>(id);
}

TEST_F(GlHandle, WhatIsGivenUpIsDeleted) {
  unsigned array = 0, sampler = 0, buffer = 0, texture = 0, volume = 0, framebuffer = 0;
  {
    const VertexArray a;
    a.bind();
    array = bound(GL_VERTEX_ARRAY_BINDING);
    const Sampler s(Address::repeat, Address::repeat, true);
    glActiveTexture(GL_TEXTURE0 + 3);
    s.bind(3);
    sampler = bound(GL_SAMPLER_BINDING);
    const Buffer b(16);
    buffer = b.id();
    const Texture t(Format::rgba8, 2, 2);
    texture = t.id();
    const Volume v(ivec3(2));
    volume = v.id();
    const std::vector<const Texture*> colors{&t};
    const Framebuffer f(colors, nullptr);
    framebuffer = f.id();
    EXPECT_TRUE(glIsVertexArray(array) && glIsSampler(sampler) && glIsBuffer(buffer));
    EXPECT_TRUE(glIsTexture(texture) && glIsTexture(volume) && glIsFramebuffer(framebuffer));
  }
  EXPECT_FALSE(glIsVertexArray(array));
  EXPECT_FALSE(glIsSampler(sampler));
  EXPECT_FALSE(glIsBuffer(buffer));
  EXPECT_FALSE(glIsTexture(texture));
  EXPECT_FALSE(glIsTexture(volume));
  EXPECT_FALSE(glIsFramebuffer(framebuffer));
}

}  // namespace
}  // namespace ssphh::gl
