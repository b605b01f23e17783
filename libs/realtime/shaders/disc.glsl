// How much of a sun's disc a point sees, from maps of depth toward its middle: percentage-closer soft shadows
// (Fernando, SIGGRAPH 2005 sketches). Bounds of depth tell first how far from the way to the light anything
// stands that matters; where that is less than a texel the shadow is sharp.

layout(binding = UNIT_DEPTH_BOUNDS) uniform sampler2DArray depth_bounds;  // level l - 1: squares of 2^l texels

const int NARROWING = 5, BLOCKER_TAPS = 16, SHADOW_TAPS = 32;
const mat2 GOLDEN_TURN = mat2(-0.737368878, 0.675490294, -0.675490294, -0.737368878);  // of Vogel's spiral

// Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare, SIGGRAPH 2014 course.
float interleaved_noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

// Mean of max(cosine, 0) over a small disc whose middle has this cosine: exactly
// (t acos(-t) + (2 + t^2) sqrt(1 - t^2) / 3) sine / π between -1 and 1, of which this errs by 0.0013 sine.
float disc_irradiance(float cosine, float sine) {
  float t = clamp(cosine / sine, -1.0, 1.0), u = 1 - t * t;
  return max(cosine - sine, 0.0) + sine * (0.25 * (1 + t) * (1 + t) - 0.0378 * u * u);
}

// A point of a surface, in metres across and toward the light.
struct Receiver {
  vec2 place;
  vec2 across;   // of its normal
  float facing;  // cosine of its normal, above 0
  vec2 slope;    // of its plane: toward the light for each metre across
  float here;    // depth
  float range;   // that depth 1 stands for
};
// One of the maps: centre [m], 1 / half width, tile. As emitter.corners holds them, SUN_CASCADES for each part of the
// disc. The receiver stands in it lifted (grazing_lift).
struct Spot {
  vec4 map;
  vec2 texel;    // of the receiver, in the tile
  vec2 aside;    // by which it is lifted, in texels
  float here;    // depth of it
  float below;   // its plane, away from the light [m]
  float width;   // of a texel [m]
  float margin;  // [m]
};
// The finest map that holds everything within `radius` of the receiver.
Spot spot_of(int first, Receiver r, float radius) {
  vec4 map = emitter.corners[first + SUN_CASCADES - 1];
  for (int i = SUN_CASCADES - 2; i >= 0; --i) {
    vec4 finer = emitter.corners[first + i];
    vec2 away = (abs(r.place - finer.xy) + radius) * finer.z;
    map = max(away.x, away.y) < 0.98 ? finer : map;
  }
  Spot s;
  float inner = float(emitter.count.z - 2);
  s.map = map;
  s.width = 2 / (inner * map.z);
  s.margin = shadow_margin(r.facing, s.width, r.range);
  float lift = grazing_lift(r.facing, s.width);
  s.aside = lift / s.width * r.across;
  s.texel = 0.5 * (r.place - map.xy) * map.z * inner + 0.5 * float(emitter.count.z) + s.aside;
  s.here = r.here + lift * r.facing / r.range;
  s.below = lift / r.facing;
  return s;
}

// Share of the four texels around the place `off` texels from the receiver that nothing stands before by more
// than `height` metres.
float lit_at(Receiver r, Spot s, vec2 off, float height) {
  vec2 slope = r.slope * (s.width / r.range);
  float margin = s.margin / r.range, own = r.here + height / r.range;
  return min(compare_tile(parallel_maps, emitter.count.z, emitter.count.w, int(s.map.w), s.texel + off,
                          s.here + height / r.range, s.here + (height - s.below) / r.range, slope, margin),
             compare_tile(parallel_maps, emitter.count.z, emitter.count.w, int(s.map.w), s.texel - s.aside + off, own, own,
                          slope, margin));
}

// Greatest and least depth in a square of 2^level texels.
vec2 bounds_in(Spot s, int level, ivec2 square) {
  ivec3 place = tile_place(int(s.map.w), emitter.items.w);
  int side = 1 << (emitter.count.x - level);
  return texelFetch(depth_bounds, ivec3(place.xy * side + clamp(square, 0, side - 1), place.z), level - 1).xy;
}

// What may block stands within `radius` of the way to the disc's middle; returns a smaller such radius. Less
// than 0: everything is blocked.
float narrowed(Receiver r, Spot s, float tangent, float radius) {
  float t = radius / s.width;
  int level = clamp(int(ceil(log2(2 * t))), 1, emitter.count.x);
  float square = float(1 << level);
  ivec2 low = ivec2(floor((s.texel - t) / square));
  vec2 v0 = bounds_in(s, level, low), v1 = bounds_in(s, level, low + ivec2(1, 0)),
       v2 = bounds_in(s, level, low + ivec2(0, 1)), v3 = bounds_in(s, level, low + 1);
  vec4 highest = (vec4(v0.x, v1.x, v2.x, v3.x) - s.here) * r.range;
  vec4 lowest = (vec4(v0.y, v1.y, v2.y, v3.y) - s.here) * r.range;
  // Metres to the squares' middles
  vec2 m0 = ((vec2(low) + 0.5) * square - s.texel) * s.width;
  float edge = square * s.width;
  vec4 x = vec4(m0.x, m0.x + edge, m0.x, m0.x + edge), y = vec4(m0.y, m0.y, m0.y + edge, m0.y + edge);
  vec4 away_x = max(abs(x) - 0.5 * edge, 0.0), away_y = max(abs(y) - 0.5 * edge, 0.0);
  vec4 away2 = away_x * away_x + away_y * away_y;
  vec4 plane = r.slope.x * x + r.slope.y * y + 0.5 * edge * (abs(r.slope.x) + abs(r.slope.y)) - s.below;
  vec4 reaches = max(highest * tangent, 0.0);
  reaches *= vec4(greaterThan(reaches * reaches, away2));
  vec4 open = vec4(lessThan(away2, vec4(radius * radius))) * vec4(lessThanEqual(lowest, max(plane, 0.0) + s.margin));
  return open == vec4(0) ? -1 : min(radius, max(max(reaches.x, reaches.y), max(reaches.z, reaches.w)));
}

// The same by smaller squares, without those in which only the receiver itself stands.
float narrowed_further(Receiver r, Spot s, float tangent, float radius) {
  float t = radius / s.width, reach = 0;
  int level = clamp(int(ceil(log2(0.5 * t))), 1, emitter.count.x);
  float square = float(1 << level), edge = square * s.width;
  float rise = 0.5 * edge * (abs(r.slope.x) + abs(r.slope.y)) - s.below;
  ivec2 low = ivec2(floor((s.texel - t) / square)), high = ivec2(floor((s.texel + t) / square));
  for (int j = low.y; j <= high.y; ++j) {
    for (int i = low.x; i <= high.x; ++i) {
      vec2 middle = ((vec2(i, j) + 0.5) * square - s.texel) * s.width;
      float height = (bounds_in(s, level, ivec2(i, j)).x - s.here) * r.range;
      float away = length(max(abs(middle) - 0.5 * edge, 0.0));
      bool blocks = height > max(dot(r.slope, middle) + rise, 0.0) + s.margin && height * tangent > away;
      reach = blocks ? max(reach, height * tangent) : reach;
    }
  }
  return min(radius, reach);
}

// Mean height of what blocks within the radius, each texel by the share of the disc that it hides; 0: nothing
// was met. Denser toward the middle, for what is low hides as much there.
float blocker_height(Receiver r, Spot s, float radius) {
  float heights = 0, shares = 0;
  ivec3 place = tile_place(int(s.map.w), emitter.count.w);
  vec2 to = vec2(1, 0);
  for (int i = 0; i < BLOCKER_TAPS; ++i, to = GOLDEN_TURN * to) {
    float share = (float(i) + 0.5) / float(BLOCKER_TAPS);
    ivec2 at = ivec2(s.texel + radius * share / s.width * to);
    ivec2 inside = clamp(at, 0, emitter.count.z - 1);
    float depth = texelFetch(parallel_maps, ivec3(place.xy * emitter.count.z + inside, place.z), 0).x;
    float height = (depth - s.here) * r.range;
    float plane = max(dot(r.slope, vec2(at) + 0.5 - s.texel) * s.width - s.below, 0.0);
    float hides = height > plane + s.margin ? share / (height * height) : 0;
    heights += hides * height;
    shares += hides;
  }
  return shares > 0 ? heights / shares : 0;
}

// Share of the light of a disc that x sees. `part` of the emitter's, `sine` of its radius.
float disc_visibility(int part, float sine, vec3 x, vec3 n) {
  SunMap axes = sun_maps[int(emitter.samples[part].normal.w)];
  int first = SUN_CASCADES * part;
  float tangent = sine / sqrt(max(1 - sine * sine, 1e-2));
  float facing = -dot(n, axes.forward.xyz);
  Receiver r;
  r.place = vec2(dot(x, axes.right.xyz), dot(x, axes.up.xyz));
  r.across = vec2(dot(n, axes.right.xyz), dot(n, axes.up.xyz));
  r.facing = max(facing, 1e-3);
  r.slope = -r.across / r.facing;
  r.here = 1 - dot(x - axes.origin.xyz, axes.forward.xyz) * axes.origin.w;
  r.range = 1 / axes.origin.w;

  Spot s = spot_of(first, r, 0);
  float texel = s.width, sharp = lit_at(r, s, vec2(0), 0);
  if (any(greaterThan(abs(r.place - s.map.xy) * s.map.z, vec2(1)))) return 1;
  float radius = tangent * (1 - r.here) * r.range;
  for (int i = 0; i < NARROWING; ++i) {
    float less = narrowed(r, spot_of(first, r, radius), tangent, radius);
    bool settled = less > 0.6 * radius;
    radius = less;
    if (settled || radius < 0.5 * texel) break;
  }
  if (radius < 0) return 0;
  if (radius < 0.5 * texel) return sharp;
  radius = narrowed_further(r, spot_of(first, r, radius), tangent, radius);
  if (radius == 0) return sharp;
  float height = blocker_height(r, spot_of(first, r, radius), radius);
  // Not met by the few taps: they must find something as high as it may be
  bool met = height > 0;
  height = met ? height : radius / tangent;

  // Share of the directions that are free at that height, each by its cosine
  s = spot_of(first, r, height * tangent);
  float total = 0, seen = 0, turn = 2 * PI * interleaved_noise(gl_FragCoord.xy);
  vec2 to = vec2(cos(turn), sin(turn));
  for (int i = 0; i < SHADOW_TAPS; ++i, to = GOLDEN_TURN * to) {
    float share2 = (float(i) + 0.5) / float(SHADOW_TAPS);
    vec2 lean = sine * sqrt(share2 / max(1 - share2 * sine * sine, 1e-2)) * to;
    float weight = max(facing + dot(r.across, lean), 0.0), least = met ? 0 : height * sqrt(share2);
    total += weight;
    seen += weight * lit_at(r, s, height / s.width * lean, max(dot(r.slope, height * lean), least));
  }
  float share = total > 0 ? seen / total : 0;
  return met ? share : min(share, sharp);
}
