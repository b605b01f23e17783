#pragma once
/// Photometric files of luminaires: IES LM-63 of 1986, 1991, 1995, 2002 and 2019. Of a file its angles and
/// intensities count, with its multiplier and ballast factors; not its keywords, its tilt, its lumens and the
/// size of the luminaire.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <ssphh/scene/lamp_profile.h>

namespace ssphh::scene_io {

inline constexpr std::uint64_t max_ies_bytes = std::uint64_t{16} << 20;

/// Candelas into all directions: what a file leaves out by symmetry is there. Photometry of type C, B or A
/// (scene::Photometry). Throws Error with `where` as its place, and the line, for text that is none.
scene::PhotometricTable ies_from_text(std::string_view text, const std::string& where);

/// The file's table under the file's name. Throws Error.
scene::LampProfile read_ies(const std::filesystem::path& path);

/// The same table as a file of 2002. What ies_from_text read from it has the same bits.
std::string ies_to_text(const scene::LampProfile& profile);

}  // namespace ssphh::scene_io
