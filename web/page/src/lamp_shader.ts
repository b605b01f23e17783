import { faceSize } from './shadows';

const taps = 32, blockerTaps = 16;

/** GLSL: `vec3 ofLamp(int i, vec3 x, vec3 n)` [W/m²], what a lamp that is dragged sends to a place, and the uniforms that it takes. */
export const lampShader = (lamps: number) => `
uniform highp sampler2D moved;
uniform highp sampler2D shadows;
uniform vec4 lampAt[${lamps}];     // radius, of a spot what is added to its ramp
uniform vec4 lampPower[${lamps}];  // range
uniform vec4 lampCone[${lamps}];   // toward, slope of the ramp

// 1 / distance of what a lamp sees that way; the way becomes that of the texel's middle.
float lampSees(int lamp, inout vec3 way) {
  vec3 a = abs(way);
  int face;
  vec2 uv;
  if (a.x >= a.y && a.x >= a.z) face = way.x > 0.0 ? 0 : 1, uv = vec2(sign(way.x) * way.z, way.y) / a.x;
  else if (a.y >= a.z) face = way.y > 0.0 ? 2 : 3, uv = vec2(sign(way.y) * way.x, way.z) / a.y;
  else face = way.z > 0.0 ? 4 : 5, uv = vec2(-sign(way.z) * way.x, way.y) / a.z;
  ivec2 texel = clamp(ivec2((uv * 0.5 + 0.5) * ${faceSize}.0), ivec2(0), ivec2(${faceSize - 1}));
  uv = (vec2(texel) + 0.5) * ${2 / faceSize} - 1.0;
  if (face < 2) way = vec3(sign(way.x), uv.y, sign(way.x) * uv.x);
  else if (face < 4) way = vec3(sign(way.y) * uv.x, sign(way.y), uv.y);
  else way = vec3(-sign(way.z) * uv.x, uv.y, sign(way.z));
  way = normalize(way);
  return texelFetch(shadows, ivec2(face, lamp) * ${faceSize} + texel, 0).r;
}

// Whether what a lamp sees that way stands before the plane of the place; its distance.
bool lampBlocked(int lamp, vec3 way, vec3 from, vec3 n, out float near) {
  float seen = lampSees(lamp, way), height = dot(from, n), slope = dot(way, n);
  float plane = slope < -0.01 ? height / slope : length(from);
  near = seen > 0.0 ? 1.0 / seen : 1e4;
  return near < plane * 0.995 - 0.004;
}

// Share of a lamp's disc that is seen: percentage-closer soft shadows (Fernando 2005), by directions from the lamp.
float lampShare(int lamp, vec3 from, vec3 n, float radius) {
  float d = length(from), nearest = 0.0, blockers = 0.0, near;
  vec3 way = from / d, t = normalize(cross(way, abs(way.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0))), b = cross(way, t);
  float wide = max(3.0 * radius / d, ${1.5 / faceSize});
  for (int i = 0; i < ${blockerTaps}; ++i) {
    float r = sqrt((float(i) + 0.5) / ${blockerTaps}.0) * wide, turn = 2.39996 * float(i);
    if (lampBlocked(lamp, way + r * (cos(turn) * t + sin(turn) * b), from, n, near)) nearest += near, ++blockers;
  }
  if (blockers == 0.0) return 1.0;
  float at = min(nearest / blockers, d), soft = max(radius * (d - at) / d / at, ${1.5 / faceSize}), open = 0.0;
  for (int i = 0; i < ${taps}; ++i) {
    float r = sqrt((float(i) + 0.5) / ${taps}.0) * soft, turn = 2.39996 * float(i);
    if (!lampBlocked(lamp, way + r * (cos(turn) * t + sin(turn) * b), from, n, near)) open += 1.0 / ${taps}.0;
  }
  return open;
}

// Irradiance by a ball of radiance 1, the horizon included (Lagarde & de Rousiers, Moving Frostbite to PBR, 2014); of a point 1/d² of its intensity.
float lampIrradiance(float cosine, float d, float radius) {
  if (radius == 0.0) return max(cosine, 0.0) / (d * d);
  float part = min(radius * radius / (d * d), 0.999), square = cosine * cosine;
  if (square > part) return cosine > 0.0 ? PI * part * cosine : 0.0;
  float sine = sqrt(1.0 - square), x = sqrt(1.0 / part - 1.0), y = -x * cosine / sine, z = sine * sqrt(1.0 - y * y);
  return max(0.0, (cosine * acos(y) - x * z) * part + atan(z / x));
}

float lampRadius(int i) { return lampCone[i].w > 0.0 ? 0.0 : lampAt[i].w; }

vec3 ofLamp(int i, vec3 x, vec3 n) {
  if (lampPower[i].rgb == vec3(0.0)) return vec3(0.0);
  vec3 from = x - lampAt[i].xyz;
  float d = length(from), radius = lampRadius(i), e = lampIrradiance(-dot(from, n) / d, d, radius);
  if (lampCone[i].w > 0.0) {
    float ramp = clamp(dot(from, lampCone[i].xyz) / d * lampCone[i].w + lampAt[i].w, 0.0, 1.0);
    e *= ramp * ramp;
  }
  if (lampPower[i].w > 0.0) {
    float r = d / lampPower[i].w;
    e *= clamp(1.0 - r * r * r * r, 0.0, 1.0);
  }
  return e > 0.0 ? e * lampShare(i, from, n, radius) * lampPower[i].rgb : vec3(0.0);
}
`;
