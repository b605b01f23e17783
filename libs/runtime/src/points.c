/// Irradiance from points on surfaces: a linear fit in the tangent plane to those around that the place sees,
/// as fitted_lookup.glsl and probes::SurfaceInterpolation make it.

#include <math.h>
#include <string.h>

#include "state.h"

// Those of probes/lookup_constants.h
static const float reach = 3, least_cosine = 0.7f, off_plane = 0.5f, off_plane_slope = 0.1f, ridge = 0.05f,
                   most_negative = 0.25f, coarser = 2.5f;

typedef struct {
  uint32_t point;
  float weight, x, y;        // place in the tangent plane, in sides of a cell
  float distance2, spacing;  // metres
} share;

typedef struct {
  const ssphh_cooked_cell* cell;  // null: none with surface
  int parts[SSPHH_COOKED_CUTS];   // of each cut
} found_cell;

static int bits_below(uint64_t mask, unsigned bit) {
  uint64_t v = mask & ((UINT64_C(1) << bit) - 1);
  v -= v >> 1 & UINT64_C(0x5555555555555555);
  v = (v & UINT64_C(0x3333333333333333)) + (v >> 2 & UINT64_C(0x3333333333333333));
  v = (v + (v >> 4)) & UINT64_C(0x0f0f0f0f0f0f0f0f);
  return (int)(v * UINT64_C(0x0101010101010101) >> 56);
}

static found_cell find_cell(const ssphh_runtime* rt, const float x[3]) {
  found_cell found = {NULL, {0, 0, 0, 0}};
  for (int g = 0; g < SSPHH_COOKED_GRIDS; ++g) {
    const ssphh_cooked_grid* grid = &rt->header->surface_grids[g];
    uint32_t at[3];
    int part[3], inside = 1;
    for (int c = 0; c < 3 && inside; ++c) {
      const float u = (x[c] - grid->origin[c]) / grid->cell_size;
      inside = u >= 0 && u < (float)grid->cells[c];
      at[c] = inside ? (uint32_t)u : 0;
      part[c] = inside ? (int)((u - (float)at[c]) * 8) : 0;
    }
    if (!inside) continue;
    const uint32_t bricks_x = (grid->cells[0] + 3) / 4, bricks_y = (grid->cells[1] + 3) / 4;
    const ssphh_cooked_brick* brick =
        &rt->bricks[grid->first_brick + ((at[2] / 4) * bricks_y + at[1] / 4) * bricks_x + at[0] / 4];
    const unsigned bit = at[0] % 4 + 4 * (at[1] % 4) + 16 * (at[2] % 4);
    if (!(brick->mask >> bit & 1)) return found;
    found.cell = &rt->cells[brick->first + (uint32_t)bits_below(brick->mask, bit)];
    found.parts[0] = part[1] + 8 * part[2];
    found.parts[1] = part[0] + 8 * part[2];
    found.parts[2] = part[0] + 8 * part[1];
    found.parts[3] = part[0] / 2 + 4 * (part[1] / 2) + 16 * (part[2] / 2);
    return found;
  }
  return found;
}

static void tangents(const float n[3], float x[3], float y[3]) {
  const float sign = n[2] < 0 ? -1.0f : 1.0f, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
  x[0] = 1 + sign * n[0] * n[0] * a, x[1] = sign * b, x[2] = -sign * n[0];
  y[0] = b, y[1] = sign + n[1] * n[1] * a, y[2] = -n[1];
}

static float weight_of(const ssphh_cooked_point* p, const float offset[3], const float n[3]) {
  const float d2 = ssphh_runtime_dot(offset, offset), s2 = p->spacing * p->spacing;
  float t = 1 - d2 / (reach * reach * s2);
  const float facing = (ssphh_runtime_dot(p->normal, n) - least_cosine) / (1 - least_cosine);
  if (!(t > 0) || !(facing > 0)) return 0;
  const float off = ssphh_runtime_dot(offset, n) / (off_plane * p->spacing + off_plane_slope * sqrtf(d2));
  const float level = 1 - off * off;
  if (!(level > 0)) return 0;
  t *= t, t *= t, t *= t;
  const uint32_t cover = p->cover;
  const float open = (float)(1u << cover), q = d2 * open * open / s2;
  return t / p->spacing * facing * level * level * (cover == 0 ? 1 : 1 / (1 + q * q));
}

/// The points of the cell that count, and the linear fit's weights.
static uint32_t find_shares(const ssphh_runtime* rt, const float x[3], const float n[3], share* shares) {
  const found_cell found = find_cell(rt, x);
  if (!found.cell) return 0;
  const uint64_t* mask = rt->masks + found.cell[0].mask;
  const float unit = 1 / rt->header->surface_grids[0].cell_size;
  float tx[3], ty[3];
  tangents(n, tx, ty);
  uint32_t count = 0;
  double total = 0, per_spacing = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, square = 0;
  for (uint32_t i = found.cell[0].entry; i < found.cell[1].entry; ++i) {
    const uint32_t entry = rt->entries[i];
    const ssphh_cooked_point* p = &rt->points[entry & SSPHH_COOKED_POINT];
    const int part = found.parts[entry >> SSPHH_COOKED_CUT_SHIFT & (SSPHH_COOKED_CUTS - 1)];
    if (entry & SSPHH_COOKED_MASKED && !(*mask++ >> part & 1)) continue;
    const float offset[3] = {p->position[0] - x[0], p->position[1] - x[1], p->position[2] - x[2]};
    const float w = weight_of(p, offset, n);
    if (!(w > 0)) continue;
    share* s = &shares[count++];
    s->point = entry & SSPHH_COOKED_POINT;
    s->weight = w;
    s->x = ssphh_runtime_dot(offset, tx) * unit;
    s->y = ssphh_runtime_dot(offset, ty) * unit;
    s->distance2 = ssphh_runtime_dot(offset, offset);
    s->spacing = p->spacing;
    total += (double)w;
    per_spacing += (double)(w / p->spacing);
  }
  if (!(total > 0)) return 0;
  // A far point of a plain, with its long lever, would tilt the fit of a room
  const float mean = (float)(total / per_spacing);
  total = 0;
  for (uint32_t i = 0; i < count; ++i) {
    share* s = &shares[i];
    const float q = s->distance2 / (coarser * coarser * mean * mean);
    s->weight /= 1 + q * q;
    const double dw = (double)s->weight, dx = (double)s->x, dy = (double)s->y;
    const double spacing = (double)(s->spacing * unit);
    total += dw, sx += dw * dx, sy += dw * dy;
    sxx += dw * dx * dx, sxy += dw * dx * dy, syy += dw * dy * dy;
    square += dw * spacing * spacing;
  }
  // First row of the inverse of [1 x y; x xx xy; y xy yy], to a factor
  const double mx = sx / total, my = sy / total, r = (double)ridge * square / total;
  const double xx = sxx / total + r, xy = sxy / total, yy = syy / total + r;
  const double c0 = xx * yy - xy * xy, c1 = my * xy - mx * yy, c2 = mx * xy - my * xx;
  const double determinant = c0 + mx * c1 + my * c2;
  const float row[3] = {(float)(c0 / determinant), (float)(c1 / determinant), (float)(c2 / determinant)};
  float negative = 0, sum = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const float relative = row[0] + row[1] * shares[i].x + row[2] * shares[i].y;
    negative += shares[i].weight * ssphh_runtime_max(-relative, 0);
  }
  // Of the way from the mean to the fit
  const float allowed = most_negative * (float)total, most = negative > allowed ? allowed / negative : 1;
  for (uint32_t i = 0; i < count; ++i) {
    const float relative = row[0] + row[1] * shares[i].x + row[2] * shares[i].y;
    shares[i].weight *= 1 - most + most * relative;
    sum += shares[i].weight;
  }
  for (uint32_t i = 0; i < count; ++i) shares[i].weight /= sum;
  return count;
}

/// What each three floats of a point's light count for.
static int basis_of(uint32_t floats, const float n[3], float basis[10]) {
  if (floats == SSPHH_COOKED_RECORD_FLOATS) {
    basis[0] = n[0], basis[1] = n[1], basis[2] = n[2], basis[3] = 1;
    return 4;
  }
  basis[0] = 0.282094792f;
  basis[1] = 0.488602512f * n[1], basis[2] = 0.488602512f * n[2], basis[3] = 0.488602512f * n[0];
  basis[4] = 1.092548431f * n[0] * n[1], basis[5] = 1.092548431f * n[1] * n[2];
  basis[6] = 0.315391565f * (3 * n[2] * n[2] - 1), basis[7] = 1.092548431f * n[0] * n[2];
  basis[8] = 0.546274215f * (n[0] * n[0] - n[1] * n[1]), basis[9] = 1;
  return 10;
}

static void add_light(const float* light, uint32_t floats, const share* shares, uint32_t count,
                      float* restrict sum) {
  memset(sum, 0, floats * sizeof(float));
  for (uint32_t i = 0; i < count; ++i) {
    const float* restrict from = light + (uint64_t)floats * shares[i].point;
    const float w = shares[i].weight;
    if (floats == SSPHH_COOKED_RECORD_FLOATS) {
      for (int k = 0; k < (int)SSPHH_COOKED_RECORD_FLOATS; ++k) sum[k] += w * from[k];
    } else {
      for (int k = 0; k < (int)SSPHH_COOKED_FITTED_FLOATS; ++k) sum[k] += w * from[k];
    }
  }
}

int ssphh_runtime_by_points(const ssphh_runtime* rt, const float* light, const float x[3], const float n[3],
                            float rgb[3]) {
  const ssphh_cooked_header* h = rt->header;
  if (h->point_count == 0) return 0;
  share shares[SSPHH_COOKED_MOST_LISTED_POINTS];
  const uint32_t count = find_shares(rt, x, n, shares);
  if (count == 0) return 0;
  float basis[10], sum[SSPHH_COOKED_FITTED_FLOATS], e[3] = {0, 0, 0};
  const int terms = basis_of(h->point_floats, n, basis);
  const uint64_t of_probes = (uint64_t)h->probe_count * 3 * h->probe_stride;
  for (uint32_t g = 0; g < h->group_count; ++g) {
    const float scale[3] = {ssphh_runtime_scale(rt, g, 0), ssphh_runtime_scale(rt, g, 1),
                            ssphh_runtime_scale(rt, g, 2)};
    if (scale[0] == 0 && scale[1] == 0 && scale[2] == 0) continue;
    add_light(light + g * rt->group_floats + of_probes, h->point_floats, shares, count, sum);
    for (int k = 0; k < terms; ++k)
      for (int c = 0; c < 3; ++c) e[c] += scale[c] * basis[k] * sum[3 * k + c];
  }
  for (int c = 0; c < 3; ++c) rgb[c] = ssphh_runtime_max(e[c], 0);
  return 1;
}
