/* What the C run-time says of a cooked file, to compare with.
   look_up FILE still|open [SCALE...]: reads places (six floats each) from stdin, writes their irradiance
   (three each); microseconds of processor time for a place go to stderr. SCALE: of each light group, grey.
   look_up FILE verdicts: reads lines "OFFSET BYTE", sets that byte of the file, mends the checksum, and
   writes the number of ssphh_runtime_open's result, a line each. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <ssphh/runtime/cooked_file.h>
#include <ssphh/runtime/runtime.h>

static void* read_all(FILE* in, size_t* size) {
  size_t room = 1 << 16;
  char* bytes = aligned_alloc(16, room);
  for (*size = 0; bytes;) {
    const size_t got = fread(bytes + *size, 1, room - *size, in);
    if (got == 0) return bytes;
    *size += got;
    if (*size < room) continue;
    char* larger = aligned_alloc(16, 2 * room);
    if (larger) memcpy(larger, bytes, *size);
    free(bytes), bytes = larger, room *= 2;
  }
  return NULL;
}

static int open_all(const void* bytes, size_t size, ssphh_runtime** light) {
  size_t needed = 0;
  ssphh_runtime_result result = ssphh_runtime_size_needed(bytes, size, &needed);
  *light = NULL;
  /* What cannot be measured is told from all of it */
  if (result != SSPHH_RUNTIME_OK) needed = 4096;
  void* memory = malloc(needed);
  result = ssphh_runtime_open(bytes, size, memory, needed, light);
  if (result != SSPHH_RUNTIME_OK) free(memory);
  return (int)result;
}

static int verdicts(char* bytes, size_t size) {
  ssphh_cooked_header* header = (ssphh_cooked_header*)bytes;
  size_t offset;
  unsigned value;
  while (scanf("%zu %u", &offset, &value) == 2 && offset < size) {
    const char was = bytes[offset];
    const uint64_t sum = header->checksum;
    bytes[offset] = (char)value;
    if (offset / 8 != 3) header->checksum = ssphh_cooked_checksum(bytes, size);
    ssphh_runtime* light;
    printf("%d\n", open_all(bytes, size, &light));
    free(light);
    bytes[offset] = was, header->checksum = sum;
  }
  return 0;
}

int main(int argc, char** argv) {
  FILE* file = argc > 2 ? fopen(argv[1], "rb") : NULL;
  if (!file) return fprintf(stderr, "look_up FILE still|open|verdicts [SCALE...]\n"), 2;
  size_t size, places_size;
  char* bytes = read_all(file, &size);
  fclose(file);
  if (strcmp(argv[2], "verdicts") == 0) return verdicts(bytes, size);

  ssphh_runtime* light;
  const int result = open_all(bytes, size, &light);
  if (!light) return fprintf(stderr, "%s\n", ssphh_runtime_message((ssphh_runtime_result)result)), 1;
  for (int i = 3; i < argc; ++i) {
    const float v = strtof(argv[i], NULL), scale[3] = {v, v, v};
    if (ssphh_runtime_set_group_scale(light, (uint32_t)(i - 3), scale) != SSPHH_RUNTIME_OK) return 1;
  }
  const ssphh_runtime_place* places = read_all(stdin, &places_size);
  const size_t count = places_size / sizeof *places;
  float* rgb = calloc(count + 1, 3 * sizeof(float));
  const unsigned flags = strcmp(argv[2], "open") == 0 ? SSPHH_RUNTIME_OPEN : SSPHH_RUNTIME_STILL;
  const clock_t begin = clock();
  const int good = ssphh_runtime_irradiance_batch(light, flags, places, count, rgb) == SSPHH_RUNTIME_OK;
  fprintf(stderr, "%.4f\n", (double)(clock() - begin) * 1e6 / CLOCKS_PER_SEC / (double)(count + !count));
  return !good || fwrite(rgb, 3 * sizeof(float), count, stdout) != count;
}
