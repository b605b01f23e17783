#pragma once
/// Links on disk, for networks that memory does not hold: rows are read in place through a memory map, in the
/// order in which the solver walks them, so the system streams them in and out by pages.
///
/// Format version 2, little-endian: "SPHLLINK", u32 version, u32 patches of a row, u64 rows, u64 links; the
/// links as (u32 patch, f32 weight); the index of each row's first link and the end, u64.

#include <cstdio>
#include <filesystem>

#include <ssphh/transport/solve.h>

namespace ssphh::transport {

/// Appends row after row, so that no more than one must be in memory.
class LinkFileWriter {
 public:
  /// Writes under a temporary name beside `path`. Throws Error with the system's reason, here and below.
  explicit LinkFileWriter(std::filesystem::path path, std::size_t patches = 1);
  /// Removes the temporary file unless finish() was called.
  ~LinkFileWriter();
  LinkFileWriter(const LinkFileWriter&) = delete;
  LinkFileWriter& operator=(const LinkFileWriter&) = delete;

  void add_row(std::span<const Link> links);
  /// Completes the file and gives it its name.
  void finish();

 private:
  void write(const void* data, std::size_t bytes);

  std::filesystem::path path_, temporary_;
  std::size_t patches_;
  std::FILE* file_ = nullptr;
  std::vector<std::uint64_t> first_{0};
};

/// All rows, their fixed and moving links together.
void write_link_file(const LinkRows& links, const std::filesystem::path& path);

class MappedLinks {
 public:
  /// Reads the whole file once to check it. Throws Error that says what is wrong: missing, truncated, of
  /// another version, rows or patches out of range, weights that are not finite.
  explicit MappedLinks(const std::filesystem::path& path);
  ~MappedLinks();
  MappedLinks(const MappedLinks&) = delete;
  MappedLinks& operator=(const MappedLinks&) = delete;

  /// Valid as long as this object lives.
  const LinkRows& rows() const { return rows_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  void check(const std::filesystem::path& path);

  void* data_ = nullptr;
  std::uint64_t bytes_ = 0;
  LinkRows rows_;
};

}  // namespace ssphh::transport
