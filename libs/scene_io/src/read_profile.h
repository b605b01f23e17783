#pragma once
/// The photometric profile of a lamp in overlays.

#include "read_emission.h"

namespace ssphh::scene_io {

/// By "file", or as text under "ies" with a "name". Throws Error naming the place.
scene::LampProfile read_profile(const json::Cursor& object, const FileOf& file_of);

}  // namespace ssphh::scene_io
