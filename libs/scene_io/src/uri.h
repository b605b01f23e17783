#pragma once
/// References from a scene file to its data: data URIs and files beside it.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ssphh::scene_io {

/// Bytes of a "data:[type][;base64],…" URI; nullopt when `uri` is none. Throws Error(where, …) for broken
/// base64.
std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri, const std::string& where);

/// File that a relative URI of `base_file` names, percent-encoding undone. Throws Error(where, …) for schemes
/// such as http: and for absolute paths, so that a scene file cannot reach further than relative names do.
std::filesystem::path resolve_uri(std::string_view uri, const std::filesystem::path& base_file,
                                  const std::string& where);

}  // namespace ssphh::scene_io
