#ifndef SSPHH_RUNTIME_COOKED_FILE_H
#define SSPHH_RUNTIME_COOKED_FILE_H
/// Layout of a cooked file (docs/cooked-files.md): a header, then sections of plain little-endian numbers
/// that are used where they lie. Written by ssphh::cook, read by runtime.h. C99.

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SSPHH_COOKED_MAGIC "SPHC\r\n\x1a\n"
#define SSPHH_COOKED_VERSION 3u
/// Sections begin at multiples of this.
#define SSPHH_COOKED_ALIGNMENT 64u

#define SSPHH_COOKED_MOST_GROUPS 256u
#define SSPHH_COOKED_GRIDS 2
/// The list of a cell of probes ends at this number, if it does not end before.
#define SSPHH_COOKED_NO_PROBE 0xffffu
#define SSPHH_COOKED_MOST_LISTED_PROBES 32u
/// Points of surfaces in one cell.
#define SSPHH_COOKED_MOST_LISTED_POINTS 96u
#define SSPHH_COOKED_MOST_POINTS (1u << 19)
/// Of an entry, whose lowest bits are a point: a mask tells which of 64 parts of the cell see it; else all
/// do.
#define SSPHH_COOKED_MASKED 0x80000000u
#define SSPHH_COOKED_POINT 0x1fffffffu
/// (entry >> SSPHH_COOKED_CUT_SHIFT) % SSPHH_COOKED_CUTS: how a mask cuts the cell, 0 to 2: into 8 × 8
/// columns along x, y or z, 3: into 4 × 4 × 4 cubes.
#define SSPHH_COOKED_CUT_SHIFT 29
#define SSPHH_COOKED_CUTS 4
/// Floats of a point's light: E(n) = (n, 1) · light, or nine bands and a rest; see docs/cooked-files.md.
#define SSPHH_COOKED_RECORD_FLOATS 12u
#define SSPHH_COOKED_FITTED_FLOATS 32u

enum {
  SSPHH_COOKED_GROUPS,       ///< ssphh_cooked_group of each light group
  SSPHH_COOKED_NAMES,        ///< of the groups, each with a zero behind it
  SSPHH_COOKED_PROBES,       ///< ssphh_cooked_probe
  SSPHH_COOKED_PROBE_CELLS,  ///< uint16: probe_list_length probes for each cell, x fastest
  SSPHH_COOKED_SIGHT,        ///< uint16: of each probe six faces of sight_size² distances
  SSPHH_COOKED_BRICKS,       ///< ssphh_cooked_brick of each 4 × 4 × 4 cells of the surfaces
  SSPHH_COOKED_CELLS,        ///< ssphh_cooked_cell of each cell that holds surface, and one behind the last
  SSPHH_COOKED_ENTRIES,      ///< uint32: points that light a cell
  SSPHH_COOKED_MASKS,        ///< uint64: of the entries that have one, in their order
  SSPHH_COOKED_POINTS,       ///< ssphh_cooked_point
  SSPHH_COOKED_LIGHT,        ///< float32: for each group the light of probes, then that of points
  SSPHH_COOKED_SECTIONS
};

typedef struct {
  uint64_t offset, size;  ///< bytes, from the file's beginning
} ssphh_cooked_section;

typedef struct {
  uint32_t name;    ///< offset in the section of names
  uint32_t length;  ///< bytes, without the zero
  float scale[3];   ///< relative to the bake
  uint32_t mode;    ///< 0 realtime, 1 mixed, 2 baked: its direct light is within
  uint32_t reserved[2];
} ssphh_cooked_group;

/// Cells of the surfaces.
typedef struct {
  float origin[3];
  float cell_size;       ///< [m]
  uint32_t cells[3];     ///< 0: the grid holds nothing
  uint32_t first_brick;  ///< the grid's bricks are those of 4 × 4 × 4 of its cells, x fastest
} ssphh_cooked_grid;

typedef struct {
  float position[3];  ///< world [m]
  float reach;        ///< distances of sight are in 65535ths of this [m]
} ssphh_cooked_probe;

typedef struct {
  uint64_t mask;   ///< cells with surface, bit x + 4 y + 16 z
  uint32_t first;  ///< number of the cell of its lowest bit
  uint32_t reserved;
} ssphh_cooked_brick;

typedef struct {
  uint32_t entry, mask;  ///< first of the cell's; its last stands before the next cell's first
} ssphh_cooked_cell;

typedef struct {
  float position[3];  ///< world [m]
  float spacing;      ///< of the points around it [m]
  float normal[3];
  uint32_t cover;  ///< 0 to 7: how near something stands before it
} ssphh_cooked_point;

typedef struct {
  uint8_t magic[8];
  uint32_t version;
  uint32_t header_size;
  uint64_t file_size;
  uint64_t checksum;  ///< ssphh_cooked_checksum of the file with zeros here
  uint64_t scene[2];  ///< hash of the scene at the bake, high and low half
  uint64_t geometry;  ///< files of the same number differ in their groups' scales and light alone
  uint32_t group_count;
  float time;  ///< pose of the scene at the bake [s]
  // From here to `sections`: what `geometry` is made of, beside the sections of probes to points
  uint32_t probe_count;
  uint32_t degree;             ///< of the probes' irradiance: 0, 1, 2 or 4
  uint32_t probe_stride;       ///< floats of one colour of a probe's irradiance: bands 0, 1, 2, 4, then zeros
  uint32_t sight_size;         ///< texels of a face's side; 0: every probe counts as seen
  uint32_t probe_list_length;  ///< of each cell
  float probe_spacing;         ///< [m]; 0: there is none, weights are by distance
  float probe_origin[3];
  float probe_cell_size;  ///< [m]
  uint32_t probe_cells[3];
  uint32_t point_count;
  uint32_t point_floats;  ///< of a point's light: SSPHH_COOKED_RECORD_FLOATS, SSPHH_COOKED_FITTED_FLOATS or 0
  uint32_t cell_count;    ///< cells that hold surface
  uint32_t entry_count, mask_count;
  ssphh_cooked_grid surface_grids[SSPHH_COOKED_GRIDS];  ///< a place is in the first that holds it
  ssphh_cooked_section sections[SSPHH_COOKED_SECTIONS];
} ssphh_cooked_header;

/// Of a file of `size` bytes, a multiple of 8 and no less than the header: changes with every word.
uint64_t ssphh_cooked_checksum(const void* file, uint64_t size);

#ifdef __cplusplus
}
#endif

#endif
