#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>

#include <fmt/format.h>
#include <jerror.h>
#include <jpeglib.h>

#include "codec.h"
#include "eight_bit.h"

namespace ssphh::image {
namespace {

/// How libjpeg ends what it cannot go on with: its message, and a jump out of its C frames.
struct Errors {
  jpeg_error_mgr manager;  // first: libjpeg's pointer to it is one to this
  std::jmp_buf exit;
  char message[JMSG_LENGTH_MAX] = "";

  static Errors& of(j_common_ptr jpeg) { return *reinterpret_cast<Errors*>(jpeg->err); }

  [[noreturn]] static void leave(j_common_ptr jpeg) {
    Errors& self = of(jpeg);
    self.manager.format_message(jpeg, self.message);
    std::longjmp(self.exit, 1);
  }

  // Its warnings are damage that it has filled up with something; between segments bytes may lie.
  static void hear(j_common_ptr jpeg, int level) {
    if (level < 0 && jpeg->err->msg_code != JWRN_EXTRANEOUS_DATA) leave(jpeg);
  }

  jpeg_error_mgr* set() {
    jpeg_std_error(&manager);
    manager.error_exit = leave;
    manager.emit_message = hear;
    manager.output_message = [](j_common_ptr) {};
    return &manager;
  }
};

// A progressive file may repeat a scan without end.
void end_many_scans(j_common_ptr jpeg) {
  constexpr int most = 500;
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > most) ERREXIT(jpeg, JERR_BAD_PROGRESSION);
}

/// Given back also where a constructor throws that has begun to read.
struct Decompression : jpeg_decompress_struct {
  Decompression() : jpeg_decompress_struct{} {}
  ~Decompression() { jpeg_destroy_decompress(this); }
  Decompression(const Decompression&) = delete;
  Decompression& operator=(const Decompression&) = delete;
};

class JpegDecoder {
 public:
  explicit JpegDecoder(const Source& source) : source_(source) {
    jpeg_.err = errors_.set();
    guarded([this] {
      jpeg_create_decompress(&jpeg_);
      jpeg_.progress = &progress_;
      progress_.progress_monitor = end_many_scans;
      jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(source_.data.data()), source_.data.size());
      jpeg_read_header(&jpeg_, TRUE);
    });
    check_size(source, jpeg_.image_width, jpeg_.image_height);
  }

  int width() const { return static_cast<int>(jpeg_.image_width); }
  int height() const { return static_cast<int>(jpeg_.image_height); }
  /// 1: grey, else 3.
  int channels() const { return jpeg_.num_components == 1 ? 1 : 3; }

  /// So many codes a pixel as there are channels().
  std::vector<std::uint8_t> decode() {
    const bool inks = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    jpeg_.out_color_space = channels() == 1 ? JCS_GRAYSCALE : inks ? JCS_CMYK : JCS_RGB;
    const std::size_t stored = channels() == 1 ? 1 : inks ? 4 : 3;
    const std::size_t row = stored * jpeg_.image_width;
    std::vector<std::uint8_t> codes(row * jpeg_.image_height);
    guarded([&] {
      jpeg_start_decompress(&jpeg_);
      while (jpeg_.output_scanline < jpeg_.output_height) {
        JSAMPROW line = codes.data() + row * jpeg_.output_scanline;
        jpeg_read_scanlines(&jpeg_, &line, 1);
      }
      jpeg_finish_decompress(&jpeg_);
    });
    return inks ? without_inks(codes) : codes;
  }

 private:
  /// Runs C code of libjpeg. `step` must own nothing: what it jumps out of is not destroyed.
  template <class Step>
  void guarded(const Step& step) {
    if (setjmp(errors_.exit) == 0) {
      step();
    } else {
      source_.fail(fmt::format("broken JPEG: {}", errors_.message));
    }
  }

  // Adobe's files hold 255 − ink.
  std::vector<std::uint8_t> without_inks(const std::vector<std::uint8_t>& codes) const {
    const int inverted = jpeg_.saw_Adobe_marker ? 0 : 255;
    std::vector<std::uint8_t> colors(codes.size() / 4 * 3);
    for (std::size_t pixel = 0; pixel < codes.size() / 4; ++pixel) {
      const int paper = codes[pixel * 4 + 3] ^ inverted;
      for (std::size_t c = 0; c < 3; ++c)
        colors[pixel * 3 + c] =
            static_cast<std::uint8_t>(((codes[pixel * 4 + c] ^ inverted) * paper + 127) / 255);
    }
    return colors;
  }

  const Source& source_;
  Errors errors_;
  jpeg_progress_mgr progress_{};
  Decompression jpeg_;
};

}  // namespace

Image decode_jpeg(const Source& source) {
  JpegDecoder decoder(source);
  const std::vector<std::uint8_t> codes = decoder.decode();
  Image image(decoder.width(), decoder.height(), decoder.channels());
  for (std::size_t i = 0; i < codes.size(); ++i) image.pixels[i] = decode_8bit(codes[i], false);
  return image;
}

Rgba8 decode_jpeg_rgba8(const Source& source) {
  JpegDecoder decoder(source);
  const std::vector<std::uint8_t> codes = decoder.decode();
  const auto channels = static_cast<std::size_t>(decoder.channels());
  Rgba8 image{decoder.width(), decoder.height(), std::vector<std::uint8_t>(codes.size() / channels * 4)};
  for (std::size_t pixel = 0; pixel < codes.size() / channels; ++pixel) {
    for (std::size_t c = 0; c < 4; ++c)
      image.rgba[pixel * 4 + c] = c == 3 ? 255 : codes[pixel * channels + std::min(c, channels - 1)];
  }
  return image;
}

std::vector<std::byte> encode_jpeg(const Image& image, int quality) {
  require_whole(image, "JPEG");
  require(quality >= 1 && quality <= 100, "JPEG", "the quality must be 1..100");
  if (image.width > JPEG_MAX_DIMENSION || image.height > JPEG_MAX_DIMENSION) {
    throw Error("JPEG", fmt::format("{} x {} pixels are too many", image.width, image.height));
  }
  const std::vector<std::uint8_t> codes = encode_8bit(image);
  const auto row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);

  struct Output {
    jpeg_compress_struct jpeg{};
    unsigned char* data = nullptr;
    unsigned long size = 0;
    ~Output() {
      jpeg_destroy_compress(&jpeg);
      std::free(data);
    }
  } out;
  Errors errors;
  out.jpeg.err = errors.set();
  if (setjmp(errors.exit) != 0) throw Error("JPEG", errors.message);
  jpeg_create_compress(&out.jpeg);
  jpeg_mem_dest(&out.jpeg, &out.data, &out.size);
  out.jpeg.image_width = static_cast<JDIMENSION>(image.width);
  out.jpeg.image_height = static_cast<JDIMENSION>(image.height);
  out.jpeg.input_components = image.channels;
  out.jpeg.in_color_space = image.channels == 1   ? JCS_GRAYSCALE
                            : image.channels == 3 ? JCS_RGB
                                                  : JCS_EXT_RGBX;
  jpeg_set_defaults(&out.jpeg);
  jpeg_set_quality(&out.jpeg, quality, TRUE);
  // Full colour resolution where quality is asked for.
  const int halved = quality > 90 ? 1 : 2;
  out.jpeg.comp_info[0].h_samp_factor = out.jpeg.comp_info[0].v_samp_factor =
      image.channels == 1 ? 1 : halved;
  jpeg_start_compress(&out.jpeg, TRUE);
  while (out.jpeg.next_scanline < out.jpeg.image_height) {
    JSAMPROW line = const_cast<JSAMPROW>(codes.data() + row * out.jpeg.next_scanline);
    jpeg_write_scanlines(&out.jpeg, &line, 1);
  }
  jpeg_finish_compress(&out.jpeg);
  const auto* begin = reinterpret_cast<const std::byte*>(out.data);
  return {begin, begin + out.size};
}

}  // namespace ssphh::image
