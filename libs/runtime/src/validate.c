/// Whether a file holds together. Lookups check nothing: whatever they follow is looked at here.

#include <string.h>

#include "state.h"

enum { most_probes = 65535, most_cells = 1 << 24, most_name = 1024 };

static int is_finite(float v) {
  return v - v == 0;
}
static int are_finite(const float* v, uint64_t count) {
  int good = 1;
  for (uint64_t i = 0; i < count; ++i) good &= is_finite(v[i]);
  return good;
}
static int is_length(float v) {
  return v > 0 && is_finite(v);
}

/// Product of a grid's cells; 0 where they are too many.
static uint64_t cells_of(const uint32_t cells[3]) {
  uint64_t product = 1;
  for (int c = 0; c < 3; ++c) {
    if (cells[c] > most_cells) return 0;
    product *= cells[c];
    if (product > most_cells) return 0;
  }
  return product;
}

static uint64_t bricks_of_grid(const ssphh_cooked_grid* grid) {
  uint64_t product = 1;
  for (int c = 0; c < 3; ++c) product *= ((uint64_t)grid->cells[c] + 3) / 4;
  return product;
}

static uint64_t bricks_of(const ssphh_cooked_header* h) {
  uint64_t sum = 0;
  for (int g = 0; g < SSPHH_COOKED_GRIDS; ++g) sum += bricks_of_grid(&h->surface_grids[g]);
  return sum;
}

/// The first holds something, the second perhaps, and its bricks are behind those of the first.
static int grids_hold(const ssphh_cooked_grid grids[SSPHH_COOKED_GRIDS]) {
  uint64_t first = 0;
  for (int g = 0; g < SSPHH_COOKED_GRIDS; ++g) {
    const ssphh_cooked_grid* grid = &grids[g];
    const int empty = g > 0 && grid->cells[0] == 0 && grid->cells[1] == 0 && grid->cells[2] == 0;
    if ((!empty && cells_of(grid->cells) == 0) || !is_length(grid->cell_size) ||
        !are_finite(grid->origin, 3) || grid->first_brick != first)
      return 0;
    first += bricks_of_grid(grid);
  }
  return 1;
}

/// Bytes of each section by the header's counts; of names no more than these.
static void sizes_of(const ssphh_cooked_header* h, uint64_t sizes[SSPHH_COOKED_SECTIONS]) {
  const uint64_t probes = h->probe_count, points = h->point_count;
  sizes[SSPHH_COOKED_GROUPS] = h->group_count * sizeof(ssphh_cooked_group);
  sizes[SSPHH_COOKED_NAMES] = (uint64_t)h->group_count * (most_name + 1);
  sizes[SSPHH_COOKED_PROBES] = probes * sizeof(ssphh_cooked_probe);
  sizes[SSPHH_COOKED_PROBE_CELLS] = cells_of(h->probe_cells) * h->probe_list_length * sizeof(uint16_t);
  sizes[SSPHH_COOKED_SIGHT] = probes * 6 * h->sight_size * h->sight_size * sizeof(uint16_t);
  sizes[SSPHH_COOKED_BRICKS] = points ? bricks_of(h) * sizeof(ssphh_cooked_brick) : 0;
  sizes[SSPHH_COOKED_CELLS] = points ? ((uint64_t)h->cell_count + 1) * sizeof(ssphh_cooked_cell) : 0;
  sizes[SSPHH_COOKED_ENTRIES] = (uint64_t)h->entry_count * sizeof(uint32_t);
  sizes[SSPHH_COOKED_MASKS] = (uint64_t)h->mask_count * sizeof(uint64_t);
  sizes[SSPHH_COOKED_POINTS] = points * sizeof(ssphh_cooked_point);
  sizes[SSPHH_COOKED_LIGHT] =
      h->group_count * (probes * 3 * h->probe_stride + points * h->point_floats) * sizeof(float);
}

static int counts_hold(const ssphh_cooked_header* h) {
  const uint32_t coefficients = h->degree == 4 ? 18 : (h->degree + 1) * (h->degree + 1);
  if (h->group_count > SSPHH_COOKED_MOST_GROUPS || h->probe_count < 1 || h->probe_count > most_probes ||
      h->degree > 4 || h->degree == 3 || h->probe_stride != (coefficients + 7) / 8 * 8 ||
      h->sight_size > 1024 || h->probe_list_length < 1 ||
      h->probe_list_length > SSPHH_COOKED_MOST_LISTED_PROBES || cells_of(h->probe_cells) == 0 ||
      h->point_count > SSPHH_COOKED_MOST_POINTS)
    return 0;
  if (!(h->probe_spacing >= 0) || !are_finite(&h->probe_spacing, 1) || !are_finite(h->probe_origin, 3) ||
      !is_length(h->probe_cell_size) || !are_finite(&h->time, 1))
    return 0;
  if (h->point_count == 0) return h->point_floats == 0 && h->entry_count == 0 && h->mask_count == 0;
  return (h->point_floats == SSPHH_COOKED_RECORD_FLOATS || h->point_floats == SSPHH_COOKED_FITTED_FLOATS) &&
         grids_hold(h->surface_grids);
}

static int sections_hold(const ssphh_cooked_header* h) {
  uint64_t sizes[SSPHH_COOKED_SECTIONS], end = h->header_size;
  sizes_of(h, sizes);
  for (int i = 0; i < SSPHH_COOKED_SECTIONS; ++i) {
    const ssphh_cooked_section* s = &h->sections[i];
    const uint64_t aligned =
        (end + SSPHH_COOKED_ALIGNMENT - 1) / SSPHH_COOKED_ALIGNMENT * SSPHH_COOKED_ALIGNMENT;
    const int fits = i == SSPHH_COOKED_NAMES ? s->size <= sizes[i] : s->size == sizes[i];
    if (s->offset != aligned || !fits || aligned > h->file_size || s->size > h->file_size - aligned) return 0;
    end = aligned + s->size;
  }
  return h->file_size - end < SSPHH_COOKED_ALIGNMENT;
}

static int groups_hold(const ssphh_cooked_header* h) {
  const char* file = (const char*)h;
  const ssphh_cooked_group* groups =
      (const ssphh_cooked_group*)(file + h->sections[SSPHH_COOKED_GROUPS].offset);
  const char* names = file + h->sections[SSPHH_COOKED_NAMES].offset;
  const uint64_t size = h->sections[SSPHH_COOKED_NAMES].size;
  for (uint32_t g = 0; g < h->group_count; ++g) {
    const ssphh_cooked_group* group = &groups[g];
    if (group->length > most_name || group->name >= size || group->length >= size - group->name ||
        names[group->name + group->length] != 0 || memchr(names + group->name, 0, group->length) ||
        group->mode > 2 || group->reserved[0] != 0 || group->reserved[1] != 0)
      return 0;
    for (int c = 0; c < 3; ++c)
      if (!(group->scale[c] >= 0 && group->scale[c] <= 1e6f)) return 0;
  }
  return 1;
}

ssphh_runtime_result ssphh_runtime_check_header(const void* file, uint64_t size) {
  if (!file) return SSPHH_RUNTIME_BAD_ARGUMENT;
  if ((uintptr_t)file % 16 != 0) return SSPHH_RUNTIME_BAD_MEMORY;
  if (size < 8 || memcmp(file, SSPHH_COOKED_MAGIC, 8) != 0) return SSPHH_RUNTIME_NOT_COOKED;
  const ssphh_cooked_header* h = (const ssphh_cooked_header*)file;
  if (size < 16) return SSPHH_RUNTIME_CUT_OFF;
  if (h->version != SSPHH_COOKED_VERSION) return SSPHH_RUNTIME_BAD_VERSION;
  if (size < sizeof *h || h->file_size != size) return SSPHH_RUNTIME_CUT_OFF;
  if (h->header_size != sizeof *h || size % 8 != 0 || !counts_hold(h) || !sections_hold(h) || !groups_hold(h))
    return SSPHH_RUNTIME_INVALID;
  return SSPHH_RUNTIME_OK;
}

static const void* section(const ssphh_cooked_header* h, int which) {
  return (const char*)h + h->sections[which].offset;
}

static int probes_hold(const ssphh_cooked_header* h) {
  const ssphh_cooked_probe* probes = (const ssphh_cooked_probe*)section(h, SSPHH_COOKED_PROBES);
  for (uint32_t i = 0; i < h->probe_count; ++i)
    if (!are_finite(probes[i].position, 3) || !is_length(probes[i].reach)) return 0;
  const uint16_t* lists = (const uint16_t*)section(h, SSPHH_COOKED_PROBE_CELLS);
  const uint64_t count = h->sections[SSPHH_COOKED_PROBE_CELLS].size / sizeof *lists;
  for (uint64_t i = 0; i < count; ++i)
    if (lists[i] != SSPHH_COOKED_NO_PROBE && lists[i] >= h->probe_count) return 0;
  return 1;
}

static int points_hold(const ssphh_cooked_header* h) {
  if (h->point_count == 0) return 1;
  const ssphh_cooked_brick* bricks = (const ssphh_cooked_brick*)section(h, SSPHH_COOKED_BRICKS);
  const ssphh_cooked_cell* cells = (const ssphh_cooked_cell*)section(h, SSPHH_COOKED_CELLS);
  const uint32_t* entries = (const uint32_t*)section(h, SSPHH_COOKED_ENTRIES);
  const ssphh_cooked_point* points = (const ssphh_cooked_point*)section(h, SSPHH_COOKED_POINTS);
  uint64_t found = 0, masks = 0;
  for (uint64_t i = 0; i < bricks_of(h); ++i) {
    if (bricks[i].first != found || bricks[i].reserved != 0) return 0;
    for (uint64_t mask = bricks[i].mask; mask; mask &= mask - 1) ++found;
  }
  if (found != h->cell_count || cells[0].entry != 0 || cells[0].mask != 0) return 0;
  for (uint32_t i = 0; i < h->cell_count; ++i) {
    const uint32_t first = cells[i].entry, end = cells[i + 1].entry;
    if (end < first || end - first > SSPHH_COOKED_MOST_LISTED_POINTS || end > h->entry_count) return 0;
    for (uint32_t k = first; k < end; ++k) {
      masks += entries[k] >> 31;
      if ((entries[k] & SSPHH_COOKED_POINT) >= h->point_count) return 0;
    }
    if (cells[i + 1].mask != masks) return 0;
  }
  if (cells[h->cell_count].entry != h->entry_count || masks != h->mask_count) return 0;
  for (uint32_t i = 0; i < h->point_count; ++i) {
    if (!are_finite(points[i].position, 3) || !are_finite(points[i].normal, 3) ||
        !is_length(points[i].spacing) || points[i].cover > 7)
      return 0;
  }
  return 1;
}

ssphh_runtime_result ssphh_runtime_check_all(const void* file, uint64_t size) {
  const ssphh_runtime_result result = ssphh_runtime_check_header(file, size);
  // What is damaged is rather that than invalid; but the header must tell the size
  const ssphh_cooked_header* h = (const ssphh_cooked_header*)file;
  if (result != SSPHH_RUNTIME_OK && (result != SSPHH_RUNTIME_INVALID || size % 8 != 0)) return result;
  if (ssphh_cooked_checksum(file, size) != h->checksum) return SSPHH_RUNTIME_DAMAGED;
  if (result != SSPHH_RUNTIME_OK) return result;
  const float* light = (const float*)section(h, SSPHH_COOKED_LIGHT);
  if (!probes_hold(h) || !points_hold(h) || !are_finite(light, h->sections[SSPHH_COOKED_LIGHT].size / 4))
    return SSPHH_RUNTIME_INVALID;
  return SSPHH_RUNTIME_OK;
}
