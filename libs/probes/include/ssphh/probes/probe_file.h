#pragma once
/// Probe files: `.sphl.json` (JSON, coefficients to five significant digits, schemas/probes.schema.json) and
/// `.sphl` (binary, full float precision) with the same content; docs/probe-files.md describes both. Folders
/// of tiles, `.tiles` (tile_folder.h), are read as one set.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <ssphh/probes/probe_set.h>
#include <ssphh/sh/packing.h>

namespace ssphh::probes {

inline constexpr int probe_file_version = 7;
/// Of binary files with packed light (docs/compact-probes.md); else as version 7.
inline constexpr int packed_probe_file_version = 8;

enum class ProbeFileFormat { json, binary, tiles };

/// By the name's end: `.json`, `.sphl` or `.tiles`. Throws Error for any other.
ProbeFileFormat probe_file_format(const std::filesystem::path& path);

/// Reads and validates. Throws Error with the file and the place (a JSON pointer, or a byte) of what is
/// wrong: limits and sizes are checked before memory is taken, so that a hostile file costs no more than a
/// plain one of its size.
ProbeSet read_probe_file(const std::filesystem::path& path);

/// Validates and writes atomically; the format is that of the name. With a packing: throws Error for JSON,
/// for sets that are not compacted(), and as sh::pack() does. Throws Error for `.tiles`, which bakes write.
void write_probe_file(const ProbeSet& set, const std::filesystem::path& path,
                      sh::Packing packing = sh::Packing::none);

/// How the light of a probe file is packed. Throws Error where it cannot be read; looks at its begin alone.
sh::Packing packing_of_file(const std::filesystem::path& path);

/// The same on memory. `where` names the source in errors.
std::string probes_to_json(const ProbeSet& set);
ProbeSet probes_from_json(std::string_view text, const std::string& where);
std::vector<std::byte> probes_to_binary(const ProbeSet& set, sh::Packing packing = sh::Packing::none);
ProbeSet probes_from_binary(std::span<const std::byte> data, const std::string& where);

/// Throws Error when a count, an index or a number is not as ProbeSet describes it: what no writer may write.
void validate(const ProbeSet& set, const std::string& where);

}  // namespace ssphh::probes
