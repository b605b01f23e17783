#pragma once
/// A glTF 2.0 file taken apart: JSON, buffers, buffer views; GLB container or text, data URIs and files
/// beside it.

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include <ssphh/core/json_cursor.h>

#include "ignored.h"

namespace ssphh::scene_io {

/// What to do about packed data that cannot be read.
inline constexpr std::string_view unpack_first =
    "unpack it first, for example with: gltf-transform copy IN.glb OUT.glb, which writes plain accessors";

/// What to do about an extension that is not supported; "" where nothing is known.
std::string_view advice_on(std::string_view extension);

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
  /// What meshoptimizer has packed is unpacked on first use.
  BufferView buffer_view(int index);
  /// Bytes of a buffer; files and data URIs are read on first use.
  std::span<const std::byte> buffer(int index);

  /// Counts memory about to be taken for decoded data; throws at 64 MiB + 64 × the bytes of the input, which
  /// no honest file comes near, so that a small file cannot ask for all memory.
  void charge(std::uint64_t bytes, const json::Cursor& place);
  /// From now on the bytes of that view count 16 times as input, since they are packed.
  void count_packed(int view);

  Ignored ignored;

 private:
  void parse_glb(std::span<const std::byte> data);
  void check_version_and_extensions() const;
  std::span<const std::byte> part_of_buffer(int buffer, std::uint64_t begin, std::uint64_t length,
                                            const json::Cursor& place);

  using Bytes = std::shared_ptr<const std::vector<std::byte>>;
  std::filesystem::path path_;
  std::string file_;
  json::Value json_;
  std::optional<std::span<const std::byte>> binary_chunk_;
  std::map<int, Bytes> buffers_;
  std::map<std::filesystem::path, Bytes> files_;
  std::map<int, Bytes> unpacked_;  // by view
  std::set<int> packed_views_;
  std::uint64_t input_bytes_ = 0, charged_ = 0;
};

}  // namespace ssphh::scene_io
