#pragma once
/// The directional albedo of the specular lobes as a texture, so that shaders and the CPU's shading share it.

#include <ssphh/gl/texture.h>

namespace ssphh::realtime {

/// (A, B) of the specular lobes' directional albedo E = f0 A + f90 B by cosine and roughness, and its mean:
/// layer 0 GGX, layer 1 Blinn–Phong. From shading::directional_albedo.
gl::Texture make_albedo_table();

}  // namespace ssphh::realtime
