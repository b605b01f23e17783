#version 450 core
// Indirect light of methods that keep none in SPHLs. Variants: CONES (cones.glsl), else virtual lights, a part of
// them in each pass; those of indirect_out.glsl.
#include "gbuffer_read.glsl"
#include "indirect_out.glsl"
#ifdef CONES
#include "cones.glsl"
#else
#include "shadow.glsl"
#include "virtual_lights.glsl"
#endif

void main() {
  ivec2 at = lit_pixel();
  if (at.x < 0) return;
  Surface s = read_surface(at);
  vec3 irradiance, glossy;
  look_up(s, reflect(-s.wo, s.normal), abs(s.specular_roughness), irradiance, glossy);
  put_light(at, s, irradiance, glossy);
}
