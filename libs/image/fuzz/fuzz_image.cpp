// Every decoder on arbitrary bytes: an image, or an Error that names the file.
#include <cstring>

#include <boost/crc.hpp>

#include <ssphh/core/log.h>
#include <ssphh/image/io.h>

namespace {

using namespace ssphh;
using namespace ssphh::image;

// Gives the chunks of a PNG right checksums, so that mutations reach the decoder behind them.
void repair_png(std::vector<std::byte>& data) {
  const auto u8 = [&](std::size_t i) { return std::to_integer<std::uint32_t>(data[i]); };
  for (std::size_t at = 8; at + 12 <= data.size();) {
    const std::size_t length = u8(at) << 24 | u8(at + 1) << 16 | u8(at + 2) << 8 | u8(at + 3);
    if (length > data.size() - at - 12) return;
    boost::crc_32_type sum;
    sum.process_bytes(data.data() + at + 4, length + 4);
    const std::uint32_t crc = sum.checksum();
    for (std::size_t i = 0; i < 4; ++i)
      data[at + 8 + length + i] = static_cast<std::byte>(crc >> (24 - 8 * i) & 255);
    at += length + 12;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const LogSink silence = set_log_sink([](LogLevel, const std::string&) {});
  constexpr DecodeLimits limits{4096, std::uint64_t{1} << 20};
  std::vector<std::byte> data(size);
  if (size > 0) std::memcpy(data.data(), bytes, size);
  if (format_of_content(data) == FileFormat::png) repair_png(data);
  try {
    const Image image = decode_image(data, "fuzz", limits);
    SSPHH_CHECK(!image.empty());
  } catch (const Error&) {
  }
  try {
    decode_rgba8(data, "fuzz", limits);
  } catch (const Error&) {
  }
  return 0;
}
