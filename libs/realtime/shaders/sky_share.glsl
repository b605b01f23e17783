// Whether a way out of a point leads to the sky, as the shadow maps of the SPHLs around tell it.
#include "probe_places.glsl"

const int SKY_SHARE_PROBES = 3, SKY_TAPS = 5, SKY_STEPS = 20, SKY_HALVINGS = 5;
const float SKY_STEP = 1.25, NO_SURFACE = 1e30;
// How far aside, in spacings of SPHLs, samples look for those that tell.
const float SKY_ASIDE = 0.3;

// How far a probe sees in a direction.
float probe_depth(int probe, vec3 d) {
  vec3 place;
  int tile = probe * 6 + cube_face(d, place);
  vec2 texel = 0.5 * (place.xy / place.z) * float(frame.maps.z - 2) + 0.5 * float(frame.maps.z);
  ivec3 corner = tile_place(tile, frame.map_tiles.z);
  float stored = texelFetch(probe_maps, ivec3(corner.xy * frame.maps.z + ivec2(texel), corner.z), 0).x;
  return stored > 0 ? frame.map_near.z / (stored * place.z) : NO_SURFACE;
}

// The way from x along d, as far as the probe at `eye` sees it: whether the sky or a surface stands behind its end. Below
// 0: a probe that does not see the first step looks along x's own surface and has no say.
float probe_sky(int probe, vec3 eye, vec3 x, vec3 d) {
  float least = 0, most = 0.05 * frame.tone.w, slack = 1 + 3 / float(frame.maps.z - 2);
  float start = probe_depth(probe, normalize(x - eye));
  if (distance(x, eye) >= slack * start) return -1;
  float sky = start == NO_SURFACE ? -1 : 0;
  bool hidden = false;
  for (int i = 0; i < SKY_STEPS + SKY_HALVINGS; ++i) {
    float along = hidden ? 0.5 * (least + most) : most;
    vec3 way = x + along * d - eye;
    float far = length(way), seen = probe_depth(probe, way / far);
    if (far < slack * seen) {
      sky = seen == NO_SURFACE ? 1 : 0;
      least = along;
      most = hidden ? most : SKY_STEP * along;
    } else {
      most = along;
      hidden = true;
    }
    if (!hidden && i == SKY_STEPS - 1) return probe_depth(probe, d) == NO_SURFACE ? 1 : 0;
  }
  return sky;
}

// Share of the sky in what microfacets of a GGX roughness mirror toward the eye; below 0: no SPHL that x sees tells. What one of
// them sees to be closed is: a step may miss what stands between. Samples ask other microfacets, or steps of the lobe would show.
float sky_share(Surface s, float alpha) {
  vec3 from = s.position + 2 * SIGHT_LIFT * frame.tone.w * s.geometric_normal;  // off the texels of its own surface
  mat3 basis = basis_around(s.normal);
  vec3 ways[SKY_TAPS];
  float share[SKY_TAPS];
  int number = sample_number(ivec2(gl_FragCoord.xy)), seen = 0;
  for (int tap = 0; tap < SKY_TAPS; ++tap) {
    float u = (float(16 * tap + number) + 0.5) / float(16 * SKY_TAPS), angle = GOLDEN_ANGLE * float(16 * tap + number);
    float slope = alpha * sqrt(u / (1 - u));
    vec3 way = reflect(-s.wo, normalize(basis * vec3(slope * cos(angle), slope * sin(angle), 1)));
    ways[tap] = dot(way, s.normal) > 0 ? way : reflect(-s.wo, s.normal);
    share[tap] = -1;
  }
  float turn = GOLDEN_ANGLE * float(number), aside = SKY_ASIDE * frame.tone.w * sqrt((float(number) + 0.5) / 16);
  vec3 place = s.position + basis_around(s.geometric_normal) * vec3(aside * cos(turn), aside * sin(turn), 0);
  // A place aside may lie within a wall or beyond it, where others stand.
  for (int attempt = 0; attempt < 2 && seen == 0; ++attempt, place = s.position) {
    int base = candidates_at(place);
    for (int i = 0; i < frame.grid_size.w && seen < SKY_SHARE_PROBES; ++i) {
      vec4 near = candidate(base + i);
      if (near.w < 0) break;
      vec3 away = near.xyz - s.position;
      float far = length(away);
      if (!maybe_above(away, far * far, s)) continue;
      if (!sees_probe(near.xyz, int(near.w), s.position, s.normal, s.geometric_normal, far)) continue;
      for (int tap = 0; tap < SKY_TAPS; ++tap) {
        float sky = probe_sky(int(near.w), near.xyz, from, ways[tap]);
        share[tap] = share[tap] < 0 ? sky : sky < 0 ? share[tap] : min(share[tap], sky);
      }
      ++seen;
    }
  }
  float sum = 0, said = 0;
  for (int tap = 0; tap < SKY_TAPS; ++tap) {
    sum += max(share[tap], 0);
    said += share[tap] < 0 ? 0 : 1;
  }
  return said > 0 ? sum / said : -1;
}
