#pragma once
/// What entries of an overlay's lists have in common, and those of lights.

#include <filesystem>
#include <string>

#include <ssphh/core/json_cursor.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Radians of a member in degrees, or of `fallback` [degrees].
float degrees(const json::Cursor& object, const char* key, float low, float high, float fallback);
/// A number over 0.
float positive(const json::Cursor& member);
/// A node for an entry: "position", "look_at" or "direction", "up", "node" (name of the node it hangs on).
int add_overlay_node(scene::Scene& scene, const json::Cursor& entry, const std::string& name);

/// Entry `number` of "lights". Files stand beside `overlay`.
void read_light(scene::Scene& scene, const json::Cursor& entry, std::size_t number,
                const std::filesystem::path& overlay);
/// Of an SPHL that shines: a lamp of its name at its node.
void read_sphl_lamp(scene::Scene& scene, const json::Cursor& entry, const scene::Sphl& sphl,
                    const std::filesystem::path& overlay);

}  // namespace ssphh::scene_io
