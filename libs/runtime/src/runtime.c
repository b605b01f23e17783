#include <string.h>

#include <ssphh/runtime/runtime.h>

#include "state.h"

_Static_assert(sizeof(ssphh_cooked_header) == 376, "the header is what docs/cooked-files.md says");
_Static_assert(sizeof(ssphh_cooked_group) == 32 && sizeof(ssphh_cooked_point) == 32, "no padding");
_Static_assert(sizeof(_Atomic float) == sizeof(float), "scales are read without a lock");

const char* ssphh_runtime_message(ssphh_runtime_result result) {
  switch (result) {
    case SSPHH_RUNTIME_OK:
      return "no error";
    case SSPHH_RUNTIME_BAD_ARGUMENT:
      return "an argument is null, out of range or not finite";
    case SSPHH_RUNTIME_BAD_MEMORY:
      return "memory is too small or not aligned to 16 bytes: ask ssphh_runtime_size_needed";
    case SSPHH_RUNTIME_NOT_COOKED:
      return "this is no cooked file: ssphh cook makes them of probe files";
    case SSPHH_RUNTIME_BAD_VERSION:
      return "the cooked file is of another version of the format: cook its probe file anew";
    case SSPHH_RUNTIME_CUT_OFF:
      return "the cooked file has another size than it says: it was cut off or added to";
    case SSPHH_RUNTIME_DAMAGED:
      return "the cooked file is damaged: its checksum is wrong";
    case SSPHH_RUNTIME_INVALID:
      return "the cooked file contradicts itself: ssphh cook did not write it so";
    case SSPHH_RUNTIME_OTHER_GEOMETRY:
      return "light of other probes or surfaces cannot be swapped in: ssphh cook --places-of takes those of "
             "a file";
    case SSPHH_RUNTIME_OTHER_GROUPS:
      return "light of other light groups cannot be swapped in: open the file";
  }
  return "unknown error";
}

static int is_finite(float v) {
  return v - v == 0;
}

static int has_three(const float v[3]) {
  return is_finite(v[0]) && is_finite(v[1]) && is_finite(v[2]);
}

static size_t bytes_for(const ssphh_cooked_header* h) {
  return (sizeof(ssphh_runtime) + (size_t)h->group_count * 3 * sizeof(float) + 15) / 16 * 16;
}

ssphh_runtime_result ssphh_runtime_size_needed(const void* file, size_t file_size, size_t* memory_size) {
  if (!memory_size) return SSPHH_RUNTIME_BAD_ARGUMENT;
  *memory_size = 0;
  const ssphh_runtime_result result = ssphh_runtime_check_header(file, file_size);
  if (result == SSPHH_RUNTIME_OK) *memory_size = bytes_for((const ssphh_cooked_header*)file);
  return result;
}

static const void* section(const void* file, int which) {
  return (const char*)file + ((const ssphh_cooked_header*)file)->sections[which].offset;
}

ssphh_runtime_result ssphh_runtime_open(const void* file, size_t file_size, void* memory, size_t memory_size,
                                        ssphh_runtime** runtime) {
  if (!memory || !runtime) return SSPHH_RUNTIME_BAD_ARGUMENT;
  *runtime = NULL;
  const ssphh_runtime_result result = ssphh_runtime_check_all(file, file_size);
  if (result != SSPHH_RUNTIME_OK) return result;
  const ssphh_cooked_header* h = (const ssphh_cooked_header*)file;
  if ((uintptr_t)memory % 16 != 0 || memory_size < bytes_for(h)) return SSPHH_RUNTIME_BAD_MEMORY;
  ssphh_runtime* rt = (ssphh_runtime*)memory;
  rt->header = h;
  rt->groups = (const ssphh_cooked_group*)section(file, SSPHH_COOKED_GROUPS);
  rt->names = (const char*)section(file, SSPHH_COOKED_NAMES);
  rt->probes = (const ssphh_cooked_probe*)section(file, SSPHH_COOKED_PROBES);
  rt->probe_cells = (const uint16_t*)section(file, SSPHH_COOKED_PROBE_CELLS);
  rt->sight = (const uint16_t*)section(file, SSPHH_COOKED_SIGHT);
  rt->bricks = (const ssphh_cooked_brick*)section(file, SSPHH_COOKED_BRICKS);
  rt->cells = (const ssphh_cooked_cell*)section(file, SSPHH_COOKED_CELLS);
  rt->entries = (const uint32_t*)section(file, SSPHH_COOKED_ENTRIES);
  rt->masks = (const uint64_t*)section(file, SSPHH_COOKED_MASKS);
  rt->points = (const ssphh_cooked_point*)section(file, SSPHH_COOKED_POINTS);
  rt->group_floats =
      (uint64_t)h->probe_count * 3 * h->probe_stride + (uint64_t)h->point_count * h->point_floats;
  atomic_init(&rt->light, (const float*)section(file, SSPHH_COOKED_LIGHT));
  for (uint32_t g = 0; g < h->group_count; ++g)
    for (uint32_t c = 0; c < 3; ++c) atomic_init(&rt->scales[3 * g + c], rt->groups[g].scale[c]);
  *runtime = rt;
  return SSPHH_RUNTIME_OK;
}

ssphh_runtime_result ssphh_runtime_describe(const ssphh_runtime* rt, ssphh_runtime_info* info) {
  if (!rt || !info) return SSPHH_RUNTIME_BAD_ARGUMENT;
  const ssphh_cooked_header* h = rt->header;
  memset(info, 0, sizeof *info);
  info->groups = h->group_count, info->probes = h->probe_count, info->points = h->point_count;
  info->has_sight = h->sight_size > 0, info->time = h->time, info->geometry = h->geometry;
  info->scene[0] = h->scene[0], info->scene[1] = h->scene[1];
  info->light_bytes = h->sections[SSPHH_COOKED_LIGHT].size;
  return SSPHH_RUNTIME_OK;
}

ssphh_runtime_result ssphh_runtime_describe_group(const ssphh_runtime* rt, uint32_t group,
                                                  ssphh_runtime_group* out) {
  if (!rt || !out || group >= rt->header->group_count) return SSPHH_RUNTIME_BAD_ARGUMENT;
  out->name = rt->names + rt->groups[group].name;
  for (int c = 0; c < 3; ++c) out->scale[c] = ssphh_runtime_scale(rt, group, c);
  out->baked = rt->groups[group].mode == 2;
  return SSPHH_RUNTIME_OK;
}

ssphh_runtime_result ssphh_runtime_set_group_scale(ssphh_runtime* rt, uint32_t group, const float scale[3]) {
  if (!rt || !scale || group >= rt->header->group_count) return SSPHH_RUNTIME_BAD_ARGUMENT;
  for (int c = 0; c < 3; ++c)
    if (!(scale[c] >= 0 && scale[c] <= 1e6f)) return SSPHH_RUNTIME_BAD_ARGUMENT;
  for (uint32_t c = 0; c < 3; ++c)
    atomic_store_explicit(&rt->scales[3 * group + c], scale[c], memory_order_relaxed);
  return SSPHH_RUNTIME_OK;
}

ssphh_runtime_result ssphh_runtime_swap_light(ssphh_runtime* rt, const void* file, size_t file_size) {
  if (!rt) return SSPHH_RUNTIME_BAD_ARGUMENT;
  const ssphh_runtime_result result = ssphh_runtime_check_header(file, file_size);
  if (result != SSPHH_RUNTIME_OK) return result;
  const ssphh_cooked_header *own = rt->header, *h = (const ssphh_cooked_header*)file;
  if (h->geometry != own->geometry || h->probe_count != own->probe_count || h->degree != own->degree ||
      h->point_count != own->point_count || h->point_floats != own->point_floats)
    return SSPHH_RUNTIME_OTHER_GEOMETRY;
  if (h->group_count != own->group_count) return SSPHH_RUNTIME_OTHER_GROUPS;
  const ssphh_cooked_group* groups = (const ssphh_cooked_group*)section(file, SSPHH_COOKED_GROUPS);
  const char* names = (const char*)section(file, SSPHH_COOKED_NAMES);
  for (uint32_t g = 0; g < h->group_count; ++g)
    if (strcmp(names + groups[g].name, rt->names + rt->groups[g].name) != 0 ||
        groups[g].mode != rt->groups[g].mode)
      return SSPHH_RUNTIME_OTHER_GROUPS;
  atomic_store_explicit(&rt->light, (const float*)section(file, SSPHH_COOKED_LIGHT), memory_order_release);
  return SSPHH_RUNTIME_OK;
}

static ssphh_runtime_result look_up(const ssphh_runtime* rt, const float* light, unsigned flags,
                                    const float x[3], const float n[3], float rgb[3]) {
  rgb[0] = rgb[1] = rgb[2] = 0;
  if (!has_three(x) || !has_three(n)) return SSPHH_RUNTIME_BAD_ARGUMENT;
  if (flags == SSPHH_RUNTIME_STILL && ssphh_runtime_by_points(rt, light, x, n, rgb)) return SSPHH_RUNTIME_OK;
  ssphh_runtime_by_probes(rt, light, flags, x, n, rgb);
  return SSPHH_RUNTIME_OK;
}

ssphh_runtime_result ssphh_runtime_irradiance(const ssphh_runtime* rt, unsigned flags,
                                              const float position[3], const float normal[3], float rgb[3]) {
  if (!rt || !position || !normal || !rgb || flags > SSPHH_RUNTIME_OPEN) return SSPHH_RUNTIME_BAD_ARGUMENT;
  const float* light = atomic_load_explicit(&rt->light, memory_order_acquire);
  return look_up(rt, light, flags, position, normal, rgb);
}

ssphh_runtime_result ssphh_runtime_irradiance_batch(const ssphh_runtime* rt, unsigned flags,
                                                    const ssphh_runtime_place* places, size_t count,
                                                    float* rgb) {
  if (!rt || (count > 0 && (!places || !rgb)) || flags > SSPHH_RUNTIME_OPEN)
    return SSPHH_RUNTIME_BAD_ARGUMENT;
  const float* light = atomic_load_explicit(&rt->light, memory_order_acquire);
  ssphh_runtime_result result = SSPHH_RUNTIME_OK;
  for (size_t i = 0; i < count; ++i) {
    const ssphh_runtime_result one =
        look_up(rt, light, flags, places[i].position, places[i].normal, rgb + 3 * i);
    if (one != SSPHH_RUNTIME_OK) result = one;
  }
  return result;
}
