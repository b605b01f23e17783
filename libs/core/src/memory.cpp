#include <algorithm>
#include <fstream>

#include <unistd.h>

#include <ssphh/core/memory.h>

namespace ssphh {

std::uint64_t memory_of_machine() {
  std::uint64_t bytes =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  // A container's root is its control group; "max" is no number and leaves the machine's.
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::uint64_t limit = 0;
    if (std::ifstream(file) >> limit) bytes = std::min(bytes, limit);
  }
  return bytes;
}

}  // namespace ssphh
