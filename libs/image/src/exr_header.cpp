#include "exr_header.h"

#include <array>

#include <fmt/format.h>

namespace ssphh::image {
namespace {

class Parser {
 public:
  explicit Parser(const Source& source) : source_(source) {}

  std::uint32_t u32() {
    need(4);
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = value << 8 | source_.byte(position_ + static_cast<std::size_t>(i));
    position_ += 4;
    return value;
  }
  std::int64_t i32() { return static_cast<std::int32_t>(u32()); }
  std::uint8_t u8() {
    need(1);
    return source_.byte(position_++);
  }
  // A name ended by a zero byte, made fit for messages.
  std::string name() {
    constexpr std::size_t longest = 255;
    std::string text;
    while (const std::uint8_t c = u8()) {
      if (text.size() == longest) fail("name without an end");
      text += c >= 0x20 && c < 0x7f ? static_cast<char>(c) : '?';
    }
    return text;
  }
  void need(std::uint64_t bytes) const {
    if (bytes > left()) fail("ends too early");
  }
  void seek(std::size_t position) { position_ = position; }
  std::size_t position() const { return position_; }
  std::uint64_t left() const { return source_.data.size() - position_; }
  const Source& source() const { return source_; }
  [[noreturn]] void fail(const std::string& problem) const {
    source_.fail(fmt::format("broken OpenEXR header: {} (byte {})", problem, position_));
  }

 private:
  const Source& source_;
  std::size_t position_ = 0;
};

ExrWindow parse_window(Parser& parser) {
  ExrWindow window;
  window.min_x = parser.i32(), window.min_y = parser.i32();
  window.max_x = parser.i32(), window.max_y = parser.i32();
  constexpr std::int64_t farthest = 1 << 30;
  for (const std::int64_t v : {window.min_x, window.min_y, window.max_x, window.max_y}) {
    if (v < -farthest || v > farthest) parser.fail("window beyond all bounds");
  }
  check_size(parser.source(), window.width(), window.height());
  return window;
}

std::vector<ExrChannel> parse_channels(Parser& parser) {
  constexpr std::size_t most = 1024;
  static constexpr std::array<int, 3> sizes{4, 2, 4};  // UINT, HALF, FLOAT
  std::vector<ExrChannel> channels;
  for (;;) {
    ExrChannel channel;
    channel.name = parser.name();
    if (channel.name.empty()) return channels;
    if (channels.size() == most) parser.fail("too many channels");
    const std::uint32_t type = parser.u32();
    if (type >= sizes.size()) parser.fail(fmt::format("channel '{}' of unknown type", channel.name));
    channel.bytes = sizes[type];
    parser.u32();  // pLinear and reserved bytes
    const std::int64_t x = parser.i32(), y = parser.i32();
    if (x < 1 || y < 1 || x > 4 || y > 4)
      parser.fail(fmt::format("channel '{}' has a bad sampling rate", channel.name));
    channel.subsampled = x != 1 || y != 1;
    channels.push_back(channel);
  }
}

void parse_attribute(Parser& parser, const std::string& name, ExrHeader& header) {
  if (name == "dataWindow") {
    header.data = parse_window(parser);
  } else if (name == "displayWindow") {
    header.display = parse_window(parser);
  } else if (name == "channels") {
    header.channels = parse_channels(parser);
  } else if (name == "compression") {
    header.compression = parser.u8();
  } else if (name == "tiles") {
    header.tile_width = parser.u32(), header.tile_height = parser.u32();
  } else if (name == "type") {
    std::string type;
    parser.need(4);
    for (int i = 0; i < 4; ++i) type += static_cast<char>(parser.u8());
    header.deep = type == "deep";
    header.tiled = type == "tile" || header.tiled;
  }
}

// Bounds of what OpenEXR allocates for one chunk, and the number of chunks.
void check_chunks(Parser& parser, ExrHeader& header) {
  static constexpr std::array<int, 10> lines_per_chunk{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  if (header.compression >= static_cast<int>(lines_per_chunk.size())) parser.fail("unknown compression");
  std::int64_t pixel_bytes = 0;
  for (const ExrChannel& channel : header.channels) pixel_bytes += channel.bytes;
  const std::int64_t lines = lines_per_chunk[header.compression];
  std::int64_t chunk_pixels = header.data.width() * lines;
  header.chunks = (header.data.height() + lines - 1) / lines;
  if (header.tiled) {
    if (header.tile_width < 1 || header.tile_height < 1) parser.fail("tiles without a size");
    if (header.tile_width > 65536 || header.tile_height > 65536) parser.fail("tiles beyond all bounds");
    chunk_pixels = header.tile_width * header.tile_height;
    header.chunks = ((header.data.width() + header.tile_width - 1) / header.tile_width) *
                    ((header.data.height() + header.tile_height - 1) / header.tile_height);
  }
  constexpr std::int64_t most_chunk_bytes = std::int64_t{1} << 29;
  if (chunk_pixels * pixel_bytes > most_chunk_bytes) {
    parser.fail(fmt::format("one block of pixels would take {} bytes", chunk_pixels * pixel_bytes));
  }
}

// Empty when the list of parts ends here.
bool parse_part(Parser& parser, ExrHeader& header) {
  constexpr int most = 4096;
  for (int count = 0;; ++count) {
    const std::string name = parser.name();
    if (name.empty()) {
      if (count == 0) return false;
      break;
    }
    if (count == most) parser.fail("too many attributes");
    const std::string type = parser.name();
    const std::uint32_t size = parser.u32();
    if (type.empty() || size > 0x7fffffff) parser.fail(fmt::format("malformed attribute '{}'", name));
    parser.need(size);
    const std::size_t end = parser.position() + size;
    parse_attribute(parser, name, header);
    if (parser.position() > end) parser.fail(fmt::format("attribute '{}' is too short", name));
    parser.seek(end);
  }
  if (header.channels.empty()) parser.fail("no channels");
  if (header.data.width() < 1 || header.display.width() < 1) parser.fail("no data or display window");
  check_chunks(parser, header);
  return true;
}

}  // namespace

std::vector<ExrHeader> check_exr_headers(const Source& source) {
  constexpr std::uint32_t tiled_flag = 0x200, deep_flag = 0x800, multipart_flag = 0x1000;
  constexpr std::size_t most_parts = 256;
  Parser parser(source);
  parser.u32();  // magic number
  const std::uint32_t version = parser.u32();
  if ((version & 0xff) != 2) parser.fail(fmt::format("version {} is unknown", version & 0xff));
  std::vector<ExrHeader> headers;
  for (;;) {
    ExrHeader header;
    header.tiled = (version & tiled_flag) != 0;
    header.deep = (version & deep_flag) != 0 && (version & multipart_flag) == 0;
    if (!parse_part(parser, header)) break;
    headers.push_back(header);
    if (!(version & multipart_flag)) break;
    if (headers.size() > most_parts) parser.fail("too many parts");
  }
  if (headers.empty()) parser.fail("no parts");
  std::int64_t chunks = 0;
  for (const ExrHeader& header : headers) chunks += header.chunks;
  constexpr std::uint64_t offset_bytes = 8, smallest_chunk = 8;
  if (static_cast<std::uint64_t>(chunks) * (offset_bytes + smallest_chunk) > parser.left()) {
    parser.fail(fmt::format("{} blocks of pixels do not fit the rest of the file", chunks));
  }
  return headers;
}

}  // namespace ssphh::image
