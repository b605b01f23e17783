#include <cstdlib>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <spng.h>

#include "codec.h"
#include "eight_bit.h"

namespace ssphh::image {
namespace {

struct Free {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
  void operator()(void* data) const { std::free(data); }
};
using Context = std::unique_ptr<spng_ctx, Free>;

Context make_context(int flags) {
  Context context(spng_ctx_new(flags));
  if (!context) throw std::bad_alloc();
  return context;
}

class PngDecoder {
 public:
  explicit PngDecoder(const Source& source) : source_(source), context_(make_context(0)) {
    // Text and profiles are nothing that a picture needs.
    check(spng_set_chunk_limits(context_.get(), std::size_t{16} << 20, std::size_t{64} << 20));
    check(spng_set_png_stream(context_.get(), read, this));
    check(spng_get_ihdr(context_.get(), &header_));
    check_size(source, header_.width, header_.height);
    spng_trns transparent;
    const int found = spng_get_trns(context_.get(), &transparent);
    if (found != SPNG_ECHUNKAVAIL) check(found);
    alpha_ = found == 0 || header_.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
             header_.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
  }

  int width() const { return static_cast<int>(header_.width); }
  int height() const { return static_cast<int>(header_.height); }
  bool deep() const { return header_.bit_depth == 16; }
  int channels() const { return alpha_ ? 4 : header_.color_type == SPNG_COLOR_TYPE_GRAYSCALE ? 1 : 3; }

  /// Four codes a pixel.
  template <class Code>
  std::vector<Code> decode() {
    std::vector<Code> codes(std::size_t{4} * header_.width * header_.height);
    check(spng_decode_image(context_.get(), codes.data(), codes.size() * sizeof(Code),
                            sizeof(Code) == 2 ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8, SPNG_DECODE_TRNS));
    check(spng_decode_chunks(context_.get()));
    if (ended_early_) check(SPNG_IO_EOF);  // libspng lets the last checksum be missing
    return codes;
  }

 private:
  static int read(spng_ctx*, void* user, void* to, std::size_t count) {
    PngDecoder& self = *static_cast<PngDecoder*>(user);
    self.ended_early_ = self.source_.data.size() - self.position_ < count;
    if (self.ended_early_) return SPNG_IO_EOF;
    std::memcpy(to, self.source_.data.data() + self.position_, count);
    self.position_ += count;
    return 0;
  }

  void check(int code) const {
    if (code != 0) source_.fail(fmt::format("broken PNG: {}", spng_strerror(code)));
  }

  const Source& source_;
  Context context_;
  std::size_t position_ = 0;
  spng_ihdr header_{};
  bool alpha_ = false, ended_early_ = false;
};

template <class Code, class ToFloat>
Image to_image(PngDecoder& decoder, const ToFloat& to_float) {
  const std::vector<Code> codes = decoder.decode<Code>();
  Image image(decoder.width(), decoder.height(), decoder.channels());
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t pixel = 0; pixel < codes.size() / 4; ++pixel) {
    for (std::size_t c = 0; c < channels; ++c)
      image.pixels[pixel * channels + c] = to_float(codes[pixel * 4 + c], c == 3);
  }
  return image;
}

std::vector<std::byte> encode(const std::vector<std::uint8_t>& codes, int width, int height, int channels) {
  const Context context = make_context(SPNG_CTX_ENCODER);
  const auto check = [](int code) {
    if (code == SPNG_EMEM) throw std::bad_alloc();
    if (code != 0) throw Error("PNG", spng_strerror(code));
  };
  static constexpr std::uint8_t color_types[] = {0, SPNG_COLOR_TYPE_GRAYSCALE,
                                                 SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, SPNG_COLOR_TYPE_TRUECOLOR,
                                                 SPNG_COLOR_TYPE_TRUECOLOR_ALPHA};
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.bit_depth = 8;
  header.color_type = color_types[channels];
  check(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
  check(spng_set_ihdr(context.get(), &header));
  check(spng_encode_image(context.get(), codes.data(), codes.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
  std::size_t size = 0;
  int code = 0;
  const std::unique_ptr<void, Free> data(spng_get_png_buffer(context.get(), &size, &code));
  check(code);
  const auto* begin = static_cast<const std::byte*>(data.get());
  return {begin, begin + size};
}

}  // namespace

Image decode_png(const Source& source) {
  PngDecoder decoder(source);
  if (!decoder.deep()) return to_image<std::uint8_t>(decoder, decode_8bit);
  return to_image<std::uint16_t>(decoder, [](std::uint16_t code, bool alpha) {
    const float value = static_cast<float>(code) / 65535;
    return alpha ? value : srgb_to_linear(value);
  });
}

Rgba8 decode_png_rgba8(const Source& source) {
  PngDecoder decoder(source);
  return {decoder.width(), decoder.height(), decoder.decode<std::uint8_t>()};
}

std::vector<std::byte> encode_png(const Image& image) {
  require_whole(image, "PNG");
  return encode(encode_8bit(image), image.width, image.height, image.channels);
}

std::vector<std::byte> encode_png(const Rgba8& image) {
  require(image.width > 0 && image.height > 0 &&
              image.rgba.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                       static_cast<std::size_t>(image.height),
          "PNG", "the image's size and its bytes do not agree");
  return encode(image.rgba, image.width, image.height, 4);
}

}  // namespace ssphh::image
