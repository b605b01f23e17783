#pragma once
/// The emission of an SPHL in overlays and in the extras of glTF files: the same object in both.

#include <filesystem>
#include <functional>

#include <ssphh/core/json_cursor.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// The file that a member names.
using FileOf = std::function<std::filesystem::path(const json::Cursor& member)>;

/// Makes an SPHL that shines of the light: its emission by "file", "lobe", "coefficients" or "frames", times
/// "color" and "intensity". Throws Error naming the place.
void read_emission(scene::Light& light, const json::Cursor& object, const FileOf& file_of);

/// Frames as they stand in files: "coefficients", or "frames" with "rate", "start" and "repeat".
scene::Emission read_frames(const json::Cursor& object);
json::Value frames_to_json(const scene::Emission& emission);

}  // namespace ssphh::scene_io
