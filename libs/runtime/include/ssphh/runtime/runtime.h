#ifndef SSPHH_RUNTIME_RUNTIME_H
#define SSPHH_RUNTIME_RUNTIME_H
/// Baked light in a shipped program: looks cooked files up (`ssphh cook`, docs/cooked-files.md) where they
/// lie, in memory or mapped. C99; needs nothing but the C library, takes no memory of its own and starts no
/// threads.
///
/// World: right-handed, y up, metres, or whatever the scene was in. Light is linear RGB.
///
/// Threads: everything that takes a `const ssphh_runtime*` may be called from any number of threads, also
/// while one other thread sets scales or swaps light. A lookup under way then has each number of a scale
/// either as it was or as it is now, and light of one of both files; a file that was swapped out may go when
/// the lookups that began before the swap have ended. Calls that change are for one thread at a time.

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define SSPHH_RUNTIME_API __attribute__((visibility("default")))
#else
#define SSPHH_RUNTIME_API
#endif

typedef enum {
  SSPHH_RUNTIME_OK = 0,
  SSPHH_RUNTIME_BAD_ARGUMENT,    ///< a null pointer, an index out of range, a number that is not finite
  SSPHH_RUNTIME_BAD_MEMORY,      ///< too little memory was handed over, or it is not aligned to 16 bytes
  SSPHH_RUNTIME_NOT_COOKED,      ///< these bytes are no cooked file
  SSPHH_RUNTIME_BAD_VERSION,     ///< of another version of the format
  SSPHH_RUNTIME_CUT_OFF,         ///< the file has another size than it says
  SSPHH_RUNTIME_DAMAGED,         ///< its checksum is wrong
  SSPHH_RUNTIME_INVALID,         ///< it contradicts itself
  SSPHH_RUNTIME_OTHER_GEOMETRY,  ///< light of other probes or surfaces
  SSPHH_RUNTIME_OTHER_GROUPS     ///< light of other light groups
} ssphh_runtime_result;

/// A sentence for people; never null, lives for ever.
SSPHH_RUNTIME_API const char* ssphh_runtime_message(ssphh_runtime_result result);

/// An open file, in the caller's memory. It holds addresses: it cannot be copied or moved, and needs no
/// closing.
typedef struct ssphh_runtime ssphh_runtime;

/// Bytes of memory that ssphh_runtime_open needs for this file. Reads its first bytes; about 3 KB, whatever
/// it holds.
SSPHH_RUNTIME_API ssphh_runtime_result ssphh_runtime_size_needed(const void* file, size_t file_size,
                                                                 size_t* memory_size);

/// Opens a file that lies in memory, aligned to 16 bytes (as mapped files are), and stays there unchanged.
/// Reads all of it once and refuses what is damaged or contradicts itself: lookups check nothing. `memory`:
/// aligned to 16 bytes, of the size that ssphh_runtime_size_needed says, at least. Light groups begin with
/// the scales of the bake.
SSPHH_RUNTIME_API ssphh_runtime_result ssphh_runtime_open(const void* file, size_t file_size, void* memory,
                                                          size_t memory_size, ssphh_runtime** runtime);

typedef struct {
  uint32_t groups, probes, points;  ///< points of surfaces with light of their own; 0: the probes light all
  uint32_t has_sight;               ///< 1: lookups know what stands between a place and a probe
  float time;                       ///< pose of the scene at the bake [s]
  uint64_t geometry;                ///< equal for files whose light can be swapped
  uint64_t scene[2];                ///< hash of the scene at the bake
  uint64_t light_bytes;             ///< of the file, of which light takes so many
} ssphh_runtime_info;
SSPHH_RUNTIME_API ssphh_runtime_result ssphh_runtime_describe(const ssphh_runtime* runtime,
                                                              ssphh_runtime_info* info);

typedef struct {
  const char* name;  ///< UTF-8, of the file
  float scale[3];    ///< as it is now, relative to the bake
  uint32_t baked;    ///< 1: surfaces get its direct light from here, too: leave it out where you draw
} ssphh_runtime_group;
SSPHH_RUNTIME_API ssphh_runtime_result ssphh_runtime_describe_group(const ssphh_runtime* runtime,
                                                                    uint32_t group, ssphh_runtime_group* out);

/// Dims, switches or colours a light group: `scale` is RGB of 0 to 1e6, relative to the bake. Costs nothing.
SSPHH_RUNTIME_API ssphh_runtime_result ssphh_runtime_set_group_scale(ssphh_runtime* runtime, uint32_t group,
                                                                     const float scale[3]);

/// Looks up the light of another file from now on, cooked later of the same probes and surfaces and with the
/// same light groups; scales stay. The cost does not depend on the file's size: its light is not read, so
/// that no checksum is asked. Open it once (ssphh_runtime_open, in other memory) where it comes from
/// elsewhere. Numbers in it that are not finite would give darkness or infinity, nothing worse.
SSPHH_RUNTIME_API ssphh_runtime_result ssphh_runtime_swap_light(ssphh_runtime* runtime, const void* file,
                                                                size_t file_size);

/// What a lookup is asked for.
enum {
  /// A place on a surface that stands still, with its unit normal.
  SSPHH_RUNTIME_STILL = 0,
  /// A place on something that moves, or in the open: points of surfaces are not asked, nor does anything
  /// hide what is
  /// behind the place.
  SSPHH_RUNTIME_OPEN = 1
};

/// Indirect irradiance [W/m²] at a place for a unit normal (and the direct irradiance of baked groups); never
/// negative. A Lambertian surface of albedo a leaves a E / π. Not finite, place or normal: BAD_ARGUMENT, and
/// rgb is 0.
SSPHH_RUNTIME_API ssphh_runtime_result ssphh_runtime_irradiance(const ssphh_runtime* runtime, unsigned flags,
                                                                const float position[3],
                                                                const float normal[3], float rgb[3]);

typedef struct {
  float position[3], normal[3];
} ssphh_runtime_place;

/// The same for `count` places; `rgb` holds three floats for each. The same bits as one by one.
SSPHH_RUNTIME_API ssphh_runtime_result ssphh_runtime_irradiance_batch(const ssphh_runtime* runtime,
                                                                      unsigned flags,
                                                                      const ssphh_runtime_place* places,
                                                                      size_t count, float* rgb);

#ifdef __cplusplus
}
#endif

#endif
