#ifndef SSPHH_RUNTIME_STATE_H
#define SSPHH_RUNTIME_STATE_H
/// What an open file consists of, and the parts of a lookup.

#include <stdatomic.h>
#include <stdint.h>

#include <ssphh/runtime/cooked_file.h>
#include <ssphh/runtime/runtime.h>

struct ssphh_runtime {
  const ssphh_cooked_header* header;
  const ssphh_cooked_group* groups;
  const char* names;
  const ssphh_cooked_probe* probes;
  const uint16_t* probe_cells;
  const uint16_t* sight;
  const ssphh_cooked_brick* bricks;
  const ssphh_cooked_cell* cells;
  const uint32_t* entries;
  const uint64_t* masks;
  const ssphh_cooked_point* points;
  uint64_t group_floats;  ///< of one group's light
  _Atomic(const float*) light;
  _Atomic float scales[];  ///< three for each group
};

/// Whether all of a file holds together; `file` is aligned.
ssphh_runtime_result ssphh_runtime_check_header(const void* file, uint64_t size);
ssphh_runtime_result ssphh_runtime_check_all(const void* file, uint64_t size);

/// Whether any point of a surface lights the place; then its irradiance.
int ssphh_runtime_by_points(const ssphh_runtime* rt, const float* light, const float x[3], const float n[3],
                            float rgb[3]);
/// Irradiance by the probes around.
void ssphh_runtime_by_probes(const ssphh_runtime* rt, const float* light, unsigned flags, const float x[3],
                             const float n[3], float rgb[3]);
/// Whether probe and place see each other, sight beginning `lift` metres above it.
int ssphh_runtime_sees(const ssphh_runtime* rt, uint32_t probe, unsigned flags, const float x[3],
                       const float n[3], float lift);

static inline float ssphh_runtime_dot(const float a[3], const float b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline float ssphh_runtime_max(float a, float b) {
  return a > b ? a : b;
}
static inline float ssphh_runtime_clamp(float v, float low, float high) {
  return v < low ? low : v > high ? high : v;
}
static inline float ssphh_runtime_scale(const ssphh_runtime* rt, uint32_t group, int colour) {
  return atomic_load_explicit(&rt->scales[3 * group + (uint32_t)colour], memory_order_relaxed);
}

#endif
