#pragma once
/// Limits of probe sets and files, checked before memory is taken. The same numbers stand in
/// schemas/probes.schema.json.

#include <cstddef>
#include <cstdint>

namespace ssphh::probes::limits {

inline constexpr std::size_t probes = 65536;
inline constexpr std::size_t placed = std::size_t{1} << 21;  ///< probes of a folder of tiles
inline constexpr std::size_t light_groups = 256;
inline constexpr std::size_t text = 1024;  ///< bytes of a name
inline constexpr int depth = 65535;
inline constexpr int samples = 1 << 24;  ///< passes, and samples per texel
inline constexpr int face_size = 4096;
inline constexpr int rays = 1 << 24;  ///< of a transport network: per probe, per surfel
inline constexpr std::size_t fitted_points = std::size_t{1} << 18;
inline constexpr std::size_t surface_records = std::size_t{1} << 20;
inline constexpr int surfels = 1 << 24;
inline constexpr std::size_t scene_items = std::size_t{1} << 20;
inline constexpr float fitted_weight = 1e6f;  ///< not negative
inline constexpr float coordinate = 1e9f;     ///< metres or seconds, either sign
inline constexpr float coefficient = 1e30f;   ///< of a function, either sign
inline constexpr float scale = 1e6f;          ///< of a light group, not negative
inline constexpr float smallest_radius = 1e-9f;
inline constexpr std::uint64_t json_bytes = std::uint64_t{128} << 20;
inline constexpr std::uint64_t binary_bytes = std::uint64_t{4} << 30;

}  // namespace ssphh::probes::limits
