/* Baked light in a shipped program: maps a cooked file, asks for light, dims a lamp.
   C99 and POSIX; nothing is allocated but the few bytes that the library asks for. */

#define _POSIX_C_SOURCE 200809L
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <ssphh/runtime/runtime.h>

static void expect(ssphh_runtime_result result) {
  if (result == SSPHH_RUNTIME_OK) return;
  fprintf(stderr, "%s\n", ssphh_runtime_message(result));
  exit(1);
}

int main(int argc, char** argv) {
  const int file = argc > 1 ? open(argv[1], O_RDONLY) : -1;
  struct stat info;
  if (file < 0 || fstat(file, &info) != 0) return fprintf(stderr, "light FILE.sphlc\n"), 2;
  const size_t size = (size_t)info.st_size;
  const void* bytes = mmap(NULL, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (bytes == MAP_FAILED) return perror(argv[1]), 1;

  size_t needed;
  expect(ssphh_runtime_size_needed(bytes, size, &needed));
  void* memory = malloc(needed); /* aligned to 16 bytes */
  ssphh_runtime* light;
  expect(ssphh_runtime_open(bytes, size, memory, needed, &light));

  ssphh_runtime_info what;
  expect(ssphh_runtime_describe(light, &what));
  printf("light groups: %u\n", (unsigned)what.groups);

  /* Below the middle of the room, turned to the floor and to the ceiling */
  const ssphh_runtime_place places[2] = {{{0, -0.5f, 0}, {0, -1, 0}}, {{0, -0.5f, 0}, {0, 1, 0}}};
  float rgb[2][3];
  expect(ssphh_runtime_irradiance_batch(light, SSPHH_RUNTIME_OPEN, places, 2, rgb[0]));
  for (int i = 0; i < 2; ++i) printf("irradiance: %.1f %.1f %.1f W/m2\n", rgb[i][0], rgb[i][1], rgb[i][2]);

  for (uint32_t g = 0; g < what.groups; ++g) {
    const float half[3] = {0.5f, 0.5f, 0.5f};
    expect(ssphh_runtime_set_group_scale(light, g, half));
  }
  expect(ssphh_runtime_irradiance(light, SSPHH_RUNTIME_OPEN, places[0].position, places[0].normal, rgb[0]));
  printf("dimmed: %.2f %.2f %.2f W/m2\n", rgb[0][0], rgb[0][1], rgb[0][2]);
  free(memory);
  return 0;
}
