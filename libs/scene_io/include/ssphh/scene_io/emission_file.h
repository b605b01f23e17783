#pragma once
/// What a thing sends out, sampled from it, as a file of its own (docs/sphl-lights.md,
/// schemas/emission.schema.json): SPHLs of other scenes shine with it.

#include <filesystem>
#include <string>
#include <string_view>

#include <ssphh/scene/emission.h>

namespace ssphh::scene_io {

inline constexpr int emission_file_version = 1;

struct EmissionFile {
  scene::Emission emission;
  float radius = 0.1f;      ///< metres; of a sphere around the thing, within which nothing shadows its light
  std::string scene, node;  ///< what it was sampled from, for people
};

/// Reads and checks. Throws Error with the file and the place of what is wrong: a missing frame, a frame of
/// another degree, a number that is not finite, a file that holds something else.
EmissionFile read_emission_file(const std::filesystem::path& path);

/// Checks and writes atomically: JSON whatever the name, every digit of every number.
void write_emission_file(const EmissionFile& file, const std::filesystem::path& path);

/// The same on memory. `where` names the source in errors.
std::string emission_to_json(const EmissionFile& file);
EmissionFile emission_from_json(std::string_view text, const std::string& where);

}  // namespace ssphh::scene_io
