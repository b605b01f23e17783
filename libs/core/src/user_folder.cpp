#include <cstdlib>

#include <ssphh/core/user_folder.h>

namespace ssphh {

std::filesystem::path user_folder(const char* variable, const char* below_home) {
  namespace fs = std::filesystem;
  const char* base = std::getenv(variable);
  if (base && fs::path(base).is_absolute()) return fs::path(base) / "ssphh";
  const char* home = std::getenv("HOME");
  return (home && *home ? fs::path(home) / below_home : fs::temp_directory_path()) / "ssphh";
}

}  // namespace ssphh
