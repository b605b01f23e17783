#version 450 core
// Light from SPHLs, found at some pixels (indirect.frag) and perhaps dimmed by occlusion, to all pixels: between
// the four around, those on the same surface count.
#include "gbuffer_read.glsl"
#ifdef FULL_BSDF
#include "bsdf.glsl"
#endif

layout(binding = 8) uniform sampler2D irradiance_image;
layout(binding = 9) uniform sampler2D glossy_image;
layout(binding = 10) uniform sampler2D occlusion_image;
layout(location = 0) out vec4 color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  Surface s = read_surface(at);
  int n = int(frame.extra.y);
  vec2 place = vec2(at) / float(n);
  ivec2 low = ivec2(floor(place)), most = (ivec2(frame.camera_right.w, frame.camera_up.w) - 1) / n;
  vec2 f = place - vec2(low);
  vec4 e = vec4(0);
  vec3 l = vec3(0);
  for (int i = 0; i < 4; ++i) {
    ivec2 o = ivec2(i & 1, i >> 1), q = min(low + o, most);
    float depth = depth_at(q * n);
    vec2 b = mix(1 - f, f, vec2(o));
    vec3 p = position_at(vec2(q * n) + 0.5, depth);
    vec3 other = oct_decode(unpackSnorm2x16(texelFetch(gbuffer0, q * n, 0).x));
    float off = abs(dot(p - s.position, s.geometric_normal)) / (0.01 * s.depth);
    float turned = max(dot(other, s.normal), 0);
    turned *= turned;
    turned *= turned;
    // Where all four are far in depth the least must count; where every pixel was found, itself alone does
    float weight = (b.x * b.y + (n > 1 ? 1e-3 : 0)) * (exp(-off) * turned * turned + 1e-4);
    weight = depth > 0 ? weight : 0;
    e += weight * vec4(texelFetch(irradiance_image, q, 0).rgb, 1);
    l += weight * texelFetch(glossy_image, q, 0).rgb;
  }
  e.rgb = e.w > 0 ? e.rgb / e.w : vec3(0);
  l = e.w > 0 ? l / e.w : vec3(0);
  float open = frame.extra.x > 0 ? texelFetch(occlusion_image, at, 0).x : 1;
#ifdef FULL_BSDF
  Bsdf bsdf = bsdf_from(s.diffuse, s.f0, s.diffuse_roughness, s.specular_roughness, dot(s.normal, s.wo));
  color = vec4(open * (s.diffuse * (1 - bsdf.albedo) / PI * e.rgb + bsdf.albedo * l), 0);
#else
  color = vec4(open * s.diffuse / PI * e.rgb, 0);
#endif
}
