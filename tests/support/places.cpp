#include "places.h"

namespace ssphh::test {

std::filesystem::path source_dir() {
  return SSPHH_SOURCE_DIR;
}

const std::string& tool_path() {
  static const std::string path = SSPHH_TOOL;
  return path;
}

}  // namespace ssphh::test
