#pragma once
/// Fixed-function state as one value, and the draw calls.

#include <cstddef>

#include <ssphh/gl/buffer.h>

namespace ssphh::gl {

enum class Depth { off, test, test_and_write };
/// `multiply` darkens what is there by what is drawn.
/// `add_to_rest`: times one less the alpha that is there.
enum class Blend { off, add, add_to_rest, over, multiply };
enum class Cull { off, back, front };

/// Depth is reversed everywhere in this project: 1 at the near plane, 0 at infinity, nearer is greater.
struct DrawState {
  Depth depth = Depth::off;
  Blend blend = Blend::off;
  Cull cull = Cull::off;
  bool color_write = true;
  bool lines = false;      ///< draw triangles' edges only
  int stencil_equal = -1;  ///< only where the stencil has this value; −1: everywhere
  int stencil_write = -1;  ///< the stencil's new value where the depth test passes; −1: as it was
  int stencil_mark = 0;  ///< bits set where a fragment is drawn and not discarded; stencil_equal ignores them
};

/// Sets all of it, also what somebody else may have left behind.
void apply(const DrawState& state);
/// Sets what every pass of this project takes for granted: depth range 0..1, no sRGB conversion on write, and
/// nothing that discards, offsets, masks or cuts what is drawn.
void apply_conventions();

/// How a corner of a triangle names its vertex.
enum class Index { u8, u16, u32 };
/// Bytes of one.
std::size_t size_of(Index type);

void draw_triangles(int vertex_count);
/// Indices [first_index, first_index + count) of the bound vertex array.
void draw_indexed(int count, std::size_t first_index, int base_vertex, Index type = Index::u32);
/// Runs the program in use, a compute shader, on as many groups as the buffer's first three integers say.
void dispatch(const Buffer& groups);
/// What shaders wrote into buffers and images is there for what follows, and the other way round.
void shader_memory_barrier();
/// Waits for everything.
void finish();

}  // namespace ssphh::gl
