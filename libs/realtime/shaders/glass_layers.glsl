// What glass does to the picture behind it, for the eye. Needs material.glsl, glass.glsl and from_camera.

uniform int glass_layer, any_bends;
layout(binding = UNIT_GBUFFER1) uniform usampler2D opaque_gbuffer1;  // of GLASS_BENT, GLASS_THROUGH
layout(binding = UNIT_EXITS) uniform usampler2D exits;  // depth, normal toward the eye, number of the instance

float opaque_depth(ivec2 at) { return uintBitsToFloat(texelFetch(opaque_gbuffer1, at, 0).y); }
bool parallel_eye() { return frame.camera_position.w != 0; }

#ifdef BENT
// No constant: compilers would unroll the loops, for seconds.
uniform int bent_steps;
layout(binding = UNIT_BEHIND_GLASS) uniform sampler2D behind_glass;

// Outside the picture the nearest.
ivec2 shown_at(vec4 place) { return ivec2(clamp(pixel_of(place), vec2(0), picture_size() - 1)); }

// Light that a body bends twice, where it enters and where it leaves (after Wyman, An Approximate Image-Space Approach for
// Interactive Refraction, SIGGRAPH 2005). Then it goes on to what the picture shows there.
vec3 light_through_body(vec3 n, vec3 wo, vec3 tint) {
  vec3 here = frame.camera_position.xyz + from_camera, forward = frame.camera_forward.xyz;
  float depth = dot(from_camera, forward), along = parallel_eye() ? 1 : length(from_camera) / depth;
  uvec4 leaves = texelFetch(exits, ivec2(gl_FragCoord.xy), 0);
  vec3 inside = refract(-wo, n, 1 / material.glass.z), goes = inside;
  // From the way straight through it toward the way to the back that the picture shows there
  float way = along * (uintBitsToFloat(leaves.x) - depth), deeper = dot(inside, forward);
  for (int i = 0; i < bent_steps / 5; ++i) {
    uvec4 back = texelFetch(exits, shown_at(vec4(here + way * inside, 1)), 0);
    if (back.z != leaves.z) break;
    leaves = back;
    if (deeper > 0.05) way = max((uintBitsToFloat(back.x) - depth) / deeper, 0.0);
  }
  vec3 from = here + way * inside;
  float behind = opaque_depth(shown_at(vec4(from, 1))), start = depth + way * deeper;
  // By what stands in it, not by its ground or by what is before it
  bool filled = behind > depth && behind - depth < 0.995 * (start - depth);
  vec3 left = glass_shares(dot(n, wo), tint).transmitted;
  if (filled) {
    from = here, start = depth;
    left /= material.glass.z * material.glass.z;  // radiance spreads where it leaves, and never entered
  } else {
    vec3 inward = oct_decode(unpackSnorm2x16(leaves.y));
    inward = dot(inward, inside) > 0 ? -inward : inward;
    goes = refract(inside, inward, material.glass.z);
    // What does not leave is mirrored, and leaves elsewhere
    bool turned = goes == vec3(0);
    if (turned) goes = reflect(inside, inward);
    left *= glass_shares(turned ? 1 : -dot(goes, inward), tint).transmitted;
  }
  // The first step that takes it from before what the picture shows to behind that
  float ahead = dot(goes, forward), t = 0, before = 0, after = -1;
  float step_length = filled ? way / 12 : 0.02 * abs(start);
  bool in_front = true;
  for (int i = 0; i < bent_steps && after < 0; ++i, step_length *= 1.2) {
    t += step_length;
    float there = opaque_depth(shown_at(vec4(from + t * goes, 1)));
    bool in_front_now = there == 0 || start + t * ahead < there;
    if (in_front && !in_front_now) after = t;
    if (after < 0) before = t;
    in_front = in_front_now;
  }
  for (int i = 0; i < bent_steps / 4 && after > 0; ++i) {
    float middle = 0.5 * (before + after), there = opaque_depth(shown_at(vec4(from + middle * goes, 1)));
    bool short_of_it = there == 0 || start + middle * ahead < there;
    before = short_of_it ? middle : before;
    after = short_of_it ? after : middle;
  }
  if (filled && after > 0) way = after;
  left *= exp(-max(way, 0.0) * material.inside.rgb);
  ivec2 seen = shown_at(after > 0 ? vec4(from + after * goes, 1) : vec4(goes, 0));
  return left * texelFetch(behind_glass, seen, 0).rgb;
}
#endif

// What a crossing of glass leaves of the light from what is behind it. Bodies absorb up to that, as what stands in them or on
// their ground hides where light enters.
vec3 left_by_crossing(vec3 crossed, bool from_front) {
  float depth = dot(from_camera, frame.camera_forward.xyz);
  float behind = opaque_depth(ivec2(gl_FragCoord.xy));
  bool hidden = behind != 0 && depth > behind;
  if (any_bends != 0 && material.glass.y == 0) {
    uvec4 leaves = texelFetch(exits, ivec2(gl_FragCoord.xy), 0);
    bool of_nearest = leaves.z == uint(instance.middle.w) && depth <= 1.00001 * uintBitsToFloat(leaves.x);
    if (of_nearest) return vec3(1);  // was bent
  }
  vec3 left = hidden ? vec3(1) : crossed;
  if (material.glass.y != 0) return left;
  vec3 to_middle = instance.middle.xyz - frame.camera_position.xyz;
  bool parallel = parallel_eye();
  float along = parallel ? 1 : length(from_camera) / depth;
  float middle = parallel ? dot(to_middle, frame.camera_forward.xyz) : length(to_middle);
  return left * absorbed_at(along * (hidden ? behind : depth) - middle, from_front, hidden, 60);
}
