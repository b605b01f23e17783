#pragma once
/// Whole-file input with a size limit, and output that is never left half-written.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ssphh {

/// Reads a file whole. Throws Error when it is missing, unreadable, a directory or larger than `limit` bytes
/// (checked before memory is taken).
std::vector<std::byte> read_file(const std::filesystem::path& path,
                                 std::uint64_t limit = std::uint64_t{4} << 30);
std::string read_text_file(const std::filesystem::path& path, std::uint64_t limit = std::uint64_t{256} << 20);

/// Writes to "PATH.XXXXXXXX.part" beside the target and renames it on success, so that an existing file stays
/// whole when the disk is full or the process dies. The file has `permissions` (chmod's bits) less the
/// umask's from its first moment on. Throws Error with the system's reason. From any thread.
void write_file(const std::filesystem::path& path, std::span<const std::byte> data,
                unsigned permissions = 0666);
void write_file(const std::filesystem::path& path, std::string_view text, unsigned permissions = 0666);

}  // namespace ssphh
