/// What stands between a place and a probe, by six faces of distances around the probe.

#include <math.h>

#include "state.h"

/// Right and up on the face of a direction, for 1 along its axis; faces in the order and orientation of cube
/// maps (docs/conventions.md), rows from above.
static int face_of(const float d[3], float* major, float* right, float* down) {
  const float ax = fabsf(d[0]), ay = fabsf(d[1]), az = fabsf(d[2]);
  if (ax >= ay && ax >= az) {
    *major = ax, *right = d[0] > 0 ? -d[2] : d[2], *down = -d[1];
    return d[0] > 0 ? 0 : 1;
  }
  if (ay >= az) {
    *major = ay, *right = d[0], *down = d[1] > 0 ? d[2] : -d[2];
    return d[1] > 0 ? 2 : 3;
  }
  *major = az, *right = d[2] > 0 ? d[0] : -d[0], *down = -d[1];
  return d[2] > 0 ? 4 : 5;
}

/// The direction of a place on a face, 1 along its axis.
static void direction_of(int face, float right, float down, float d[3]) {
  switch (face) {
    case 0:
      d[0] = 1, d[1] = -down, d[2] = -right;
      break;
    case 1:
      d[0] = -1, d[1] = -down, d[2] = right;
      break;
    case 2:
      d[0] = right, d[1] = 1, d[2] = down;
      break;
    case 3:
      d[0] = right, d[1] = -1, d[2] = -down;
      break;
    case 4:
      d[0] = right, d[1] = -down, d[2] = 1;
      break;
    default:
      d[0] = -right, d[1] = -down, d[2] = -1;
      break;
  }
}

int ssphh_runtime_sees(const ssphh_runtime* rt, uint32_t probe, unsigned flags, const float x[3],
                       const float n[3], float lift) {
  const uint32_t size = rt->header->sight_size;
  if (size == 0) return 1;
  const ssphh_cooked_probe* p = &rt->probes[probe];
  const float away[3] = {x[0] - p->position[0], x[1] - p->position[1], x[2] - p->position[2]};
  const float d[3] = {away[0] + lift * n[0], away[1] + lift * n[1], away[2] + lift * n[2]};
  const float height = -ssphh_runtime_dot(n, away);
  // From so far below a surface, light reaches a place only over an edge nearer than a fifth of the way
  if (flags == SSPHH_RUNTIME_STILL && height < 0 && height * height > 0.0025f * ssphh_runtime_dot(away, away))
    return 0;
  float major, right, down;
  const int face = face_of(d, &major, &right, &down);
  if (!(major > 0)) return 1;  // the probe stands there
  const float half = 0.5f * (float)size;
  const float column = ssphh_runtime_clamp((right / major + 1) * half, 0, (float)size - 1);
  const float row = ssphh_runtime_clamp((down / major + 1) * half, 0, (float)size - 1);
  const uint32_t i = (uint32_t)column, j = (uint32_t)row;
  float asked = major;
  if (flags == SSPHH_RUNTIME_STILL && height > 0) {
    // Along the texel's ray the surface itself may stand nearer
    float ray[3];
    direction_of(face, ((float)i + 0.5f) / half - 1, ((float)j + 0.5f) / half - 1, ray);
    const float slope = -ssphh_runtime_dot(n, ray);
    if (height < asked * slope) asked = height / slope;
  }
  const uint16_t stored = rt->sight[((uint64_t)probe * 6 + (uint32_t)face) * size * size + j * size + i];
  // Nothing was found as far as anything asks
  return stored == 0xffff || (float)stored * (1.0f / 65535) * p->reach * (1 + 1.5f / (float)size) >= asked;
}
