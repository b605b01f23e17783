#pragma once
/// Side files that add to a scene what its own format lacks: cameras, lights, SPHLs, an environment, material
/// values (docs/scenes.md, schemas/scene-overlay.schema.json).

#include <filesystem>
#include <string>
#include <string_view>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Applies the overlay in `text` to a scene. `path` names it in messages and is the base of its relative
/// paths. `unit`, as unit.h has it, takes the place of the overlay's own; empty: that stands. Throws Error
/// naming file and place for unknown members, wrong types and values out of range.
void apply_overlay(scene::Scene& scene, std::string_view text, const std::filesystem::path& path,
                   const std::string& unit = {});

/// The "scene" member of an overlay: a path relative to the overlay, made absolute or relative to the working
/// directory, or "builtin:NAME". Throws Error when it is missing.
std::string overlay_scene(std::string_view text, const std::filesystem::path& path);

/// Replaces ${NAME} and ${NAME:-DEFAULT} by environment variables. Only names that begin with SSPHH_ are
/// allowed, so that a file from elsewhere cannot ask for others. A value that begins the text and is a
/// relative path becomes absolute, counted from the working directory. Throws Error(where, …) for an unset
/// one without default.
std::string expand_variables(std::string_view text, const std::string& where);

}  // namespace ssphh::scene_io
