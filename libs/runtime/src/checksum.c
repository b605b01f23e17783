#include <stddef.h>
#include <string.h>

#include <ssphh/runtime/cooked_file.h>

static uint64_t mixed(uint64_t sum, uint64_t word) {
  sum = (sum ^ word) * 0x9e3779b97f4a7c15u;  // each step can be undone: no changed word goes unseen
  return sum ^ sum >> 32;
}

uint64_t ssphh_cooked_checksum(const void* file, uint64_t size) {
  // The checksum's own eight bytes count as zeros
  const uint64_t at = offsetof(ssphh_cooked_header, checksum);
  const unsigned char* bytes = (const unsigned char*)file;
  uint64_t lanes[4] = {0, 1, 2, 3}, word, i = 0;
  for (; size - i >= 32; i += 32) {
    for (int lane = 0; lane < 4; ++lane) {
      memcpy(&word, bytes + i + 8 * lane, 8);
      if (i + 8 * (uint64_t)lane == at) word = 0;
      lanes[lane] = mixed(lanes[lane], word);
    }
  }
  for (; size - i >= 8; i += 8) {
    memcpy(&word, bytes + i, 8);
    lanes[0] = mixed(lanes[0], word);
  }
  for (int lane = 1; lane < 4; ++lane) lanes[0] = mixed(lanes[0], lanes[lane]);
  return mixed(lanes[0], size);
}
