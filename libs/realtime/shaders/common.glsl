// What every pass knows of the frame; mirrors FrameBlock in gpu_types.h.
layout(std140, binding = BINDING_FRAME_BLOCK) uniform FrameBlock {
  vec4 camera_position;  // w: 1 for an orthographic camera
  vec4 camera_right;     // times half the width that is seen at distance 1; w: width in pixels
  vec4 camera_up;        // w: height in pixels
  vec4 camera_forward;   // w: distance of the near plane; far plane if orthographic
  ivec4 grid_size;       // cells of the probe grid; w: candidates per cell
  vec4 grid_origin;      // w: cell size
  vec4 tone;             // exposure factor, curve, 1/gamma or 0, probe spacing
  vec4 environment;      // cos, sin of its rotation; w: view
  ivec4 maps;            // texels of a face: lights, areas, probes
  ivec4 map_tiles;       // log2 of tiles in a row, likewise
  vec4 map_near;         // near plane of the cube maps, likewise
  vec4 extra;            // occlusion radius, 0 off; indirect scale, tolerance
  vec4 shift;            // of the picture, from -1..1 being its whole
} frame;

#include "hash.glsl"

const float PI = 3.14159265358979;

// Column, row and layer of a tile, columns a power of two (TileLayout).
ivec3 tile_place(int tile, int columns_log2) {
  int low = (1 << columns_log2) - 1;
  return ivec3(tile & low, tile >> columns_log2 & low, tile >> 2 * columns_log2);
}

// A world direction as the environment's image has it: turned about +y, counter-clockwise seen from above.
vec3 to_environment(vec3 d) {
  float c = frame.environment.x, s = frame.environment.y;
  return vec3(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
}

vec2 picture_size() { return vec2(frame.camera_right.w, frame.camera_up.w); }
// Where the picture shows a point or, with w 0, a direction from the eye; it may lie outside.
vec2 pixel_of(vec4 place) {
  vec3 p = place.xyz - place.w * frame.camera_position.xyz, right = frame.camera_right.xyz, up = frame.camera_up.xyz;
  vec2 plane = vec2(dot(p, right) / dot(right, right), dot(p, up) / dot(up, up));
  if (frame.camera_position.w == 0) plane /= max(dot(p, frame.camera_forward.xyz), 1e-20);
  return 0.5 * (plane + 1 + frame.shift.xy) * picture_size();
}

// 0..15 for each of 4 × 4 samples, as a Bayer matrix has them, and others in a picture that is shifted: what samples look at
// in turns, pixels and smooth edges bring together.
int sample_number(ivec2 at) {
  at &= 3;
  int number = ((at.x ^ at.y) & 1) << 3 | (at.y & 1) << 2 | ((at.x ^ at.y) & 2) | at.y >> 1;
  return number + int(16 * hash01(uvec3(floatBitsToUint(frame.shift.xy), 0))) & 15;
}
const float GOLDEN_ANGLE = 2.39996323;

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }
float max_component(vec3 v) { return max(v.x, max(v.y, v.z)); }

vec2 oct_encode(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  return n.z >= 0 ? p : (1 - abs(p.yx)) * vec2(p.x >= 0 ? 1 : -1, p.y >= 0 ? 1 : -1);
}
vec3 oct_decode(vec2 p) {
  vec3 n = vec3(p, 1 - abs(p.x) - abs(p.y));
  if (n.z < 0) n.xy = (1 - abs(n.yx)) * vec2(p.x >= 0 ? 1 : -1, p.y >= 0 ? 1 : -1);
  return normalize(n);
}

// Colours 0..1 in 3 x 10 bits, finer where dark.
uint pack_color(vec3 c, uint top) {
  uvec3 q = uvec3(sqrt(clamp(c, 0.0, 1.0)) * 1023 + 0.5);
  return q.x | q.y << 10 | q.z << 20 | top << 30;
}
vec3 unpack_color(uint p) {
  vec3 q = vec3(p & 1023u, p >> 10 & 1023u, p >> 20 & 1023u) / 1023;
  return q * q;
}

// Orthonormal basis around n (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 2017).
mat3 basis_around(vec3 n) {
  float s = n.z >= 0 ? 1 : -1;
  float a = -1 / (s + n.z), b = n.x * n.y * a;
  return mat3(vec3(1 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}
