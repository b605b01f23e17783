// Shadows that are shorter than a map's texels tell: within a few of those a map does not know what stands before a surface
// from the surface. The picture does, where it shows both.

const int CONTACT_STEPS = 8;
// Of the reach: how far out of a surface's plane that rises which may block it, and how far from it that is.
const float CONTACT_RISE = 0.02, CONTACT_FAR = 4;

// 0 where the way from a surface into direction wi goes within `reach` metres through what the picture shows beside it,
// else 1.
float contact_visibility(Surface s, vec3 wi, float reach) {
  vec2 own = gl_FragCoord.xy, way = pixel_of(vec4(s.position + reach * wi, 1)) - pixel_of(vec4(s.position, 1));
  int steps = min(int(ceil(max(abs(way.x), abs(way.y)))), CONTACT_STEPS);
  for (int i = 1; i <= steps; ++i) {
    float share = float(i) / float(steps);
    ivec2 at = ivec2(floor(own + share * way));
    float depth = depth_at(at);
    if (at == ivec2(own) || depth <= 0) continue;
    vec3 d = position_at(vec2(at) + 0.5, depth) - s.position;
    float rise = dot(s.geometric_normal, d);
    if (rise < CONTACT_RISE * reach || dot(d, d) > CONTACT_FAR * CONTACT_FAR * reach * reach) continue;
    vec3 normal = geometric_normal_at(at);
    float above = -dot(normal, d);  // the plane of that
    if (above > 0 && above + share * reach * dot(normal, wi) < 0) return 0;
  }
  return 1;
}
