#include "file_kinds.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace ssphh::viewer {

bool is_probe_file(const std::string& name) {
  constexpr std::array<std::string_view, 2> endings = {".sphl", ".sphl.json"};
  return std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); });
}

bool is_linear_picture(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".exr";
}

}  // namespace ssphh::viewer
