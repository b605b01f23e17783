#version 450 core
// Leaves the pixels that may be interpolated: those looked up, and those on the surface of a cell that agrees. Lists
// the others that reflect. What no surface covers stays unmarked: the sky is drawn there.
#include "gbuffer_read.glsl"
#include "listed_pixels.glsl"

layout(binding = UNIT_CELLS) uniform usampler2D cells;

void list_pixel(ivec2 at) {
  uint i = atomicAdd(listed.count, 1u), group = i / LISTED_GROUP;
  listed.pixels[i] = uint(at.x) | uint(at.y) << 16;
  if (i % LISTED_GROUP != 0u) return;
  atomicMax(listed.groups_x, min(group, LISTED_ROW - 1) + 1);
  atomicMax(listed.groups_y, group / LISTED_ROW + 1);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int n = int(frame.extra.y);
  ivec2 low = at / n, off = at - low * n;
  uvec4 cell = texelFetch(cells, low, 0), surface = texelFetch(gbuffer0, at, 0);
  vec3 plane = uintBitsToFloat(cell.xyz), normal = oct_decode(unpackSnorm2x16(surface.x));
  float z = linear_depth(at);
  bool on_plane = abs(z - plane.x - dot(plane.yz, vec2(off))) < 0.004 * z &&
                  dot(normal, oct_decode(unpackSnorm2x16(cell.w))) > 0.95;
  if (z > 0 && (off == ivec2(0) || (plane.x > 0 && on_plane))) return;
  bool reflects = z > 0 && ((surface.z | surface.w) & 0x3fffffffu) != 0u;
  if (reflects) list_pixel(at);
  discard;
}
