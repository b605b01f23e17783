#pragma once
/// glTF files in memory; messages call them "f".

#include <ssphh/scene_io/gltf.h>

#include "error_message.h"

namespace ssphh::scene_io {

inline scene::Scene load(std::span<const std::byte> file) {
  return load_gltf(file, "f");
}

/// What is said of the file; "no error" of one that loads.
inline std::string said_of(std::span<const std::byte> file) {
  return test::message_of([&] { load(file); });
}

}  // namespace ssphh::scene_io
