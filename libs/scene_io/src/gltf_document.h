#pragma once
/// A glTF 2.0 file taken apart: JSON, buffers, buffer views; GLB container or text, data URIs and files
/// beside it.

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include <ssphh/core/json_cursor.h>

#include "ignored.h"

namespace ssphh::scene_io {

class GltfDocument {
 public:
  /// `data` is the whole file and must outlive the document; `path` names it in messages and is the base of
  /// relative references. Throws Error for a broken container, broken JSON, another glTF version, or a
  /// required extension that cannot be done.
  GltfDocument(std::span<const std::byte> data, std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  json::Cursor root() const { return {json_, file_}; }
  /// Size of a top-level array ("meshes"), 0 when absent.
  std::size_t count(const char* collection) const { return root().size_of(collection); }
  /// Element of a top-level array; `index` must be in range.
  json::Cursor item(const char* collection, int index) const;
  /// All elements of a top-level array; none when it is absent.
  std::vector<json::Cursor> items(const char* collection) const;
  /// Reads object.key as an index into a top-level array; nullopt when absent.
  std::optional<int> reference(const json::Cursor& object, const char* key, const char* collection) const;

  /// Whether the file is a GLB with a binary chunk.
  bool is_glb() const { return binary_chunk_.has_value(); }

  struct BufferView {
    std::span<const std::byte> bytes;
    std::uint64_t stride;  ///< 0: tightly packed
  };
  BufferView buffer_view(int index);
  /// Bytes of a buffer; files and data URIs are read on first use.
  std::span<const std::byte> buffer(int index);

  /// Counts memory about to be taken for decoded data; throws at 64 MiB + 64 × the bytes of the input, which
  /// no honest file comes near, so that a small file cannot ask for all memory.
  void charge(std::uint64_t bytes, const json::Cursor& place);

  Ignored ignored;

 private:
  void parse_glb(std::span<const std::byte> data);
  void check_version_and_extensions() const;

  using Bytes = std::shared_ptr<const std::vector<std::byte>>;
  std::filesystem::path path_;
  std::string file_;
  json::Value json_;
  std::optional<std::span<const std::byte>> binary_chunk_;
  std::map<int, Bytes> buffers_;
  std::map<std::filesystem::path, Bytes> files_;
  std::uint64_t input_bytes_ = 0, charged_ = 0;
};

}  // namespace ssphh::scene_io
