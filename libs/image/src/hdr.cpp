#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "codec.h"

// Radiance HDR (RGBE): Ward, "Real Pixels", Graphics Gems II, 1991; file format of Radiance's color.c. A
// mantissa m with exponent e stands for m·2^(e−136), so that 1 is stored exactly; Radiance's own tools add
// half a step to m on reading.

namespace ssphh::image {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

vec3 decode_rgbe(const Rgbe& p) {
  if (p[3] == 0) return vec3(0);
  const float scale = std::ldexp(1.0f, static_cast<int>(p[3]) - 136);
  return scale * vec3(p[0], p[1], p[2]);
}

Rgbe encode_rgbe(const vec3& color) {
  const auto representable = [](float x) {
    return x > 0 ? std::min(x, std::ldexp(255.0f, 255 - 136)) : 0.0f;
  };
  const vec3 c(representable(color.x), representable(color.y), representable(color.z));
  const float largest = max_component(c);
  if (!(largest > 0)) return {0, 0, 0, 0};
  int exponent;
  std::frexp(largest, &exponent);
  if (std::nearbyint(std::ldexp(largest, 8 - exponent)) > 255)
    ++exponent;  // 255.5 rounds up into the next power
  if (exponent < 1 - 128) return {0, 0, 0, 0};
  const auto mantissa = [&](float x) {
    return static_cast<std::uint8_t>(std::nearbyint(std::ldexp(x, 8 - exponent)));
  };
  return {mantissa(c.x), mantissa(c.y), mantissa(c.z), static_cast<std::uint8_t>(exponent + 128)};
}

class Reader {
 public:
  explicit Reader(const Source& source) : source_(source) {}

  // The next line without its newline.
  std::string_view line() {
    constexpr std::size_t longest = 4096;
    const char* begin = reinterpret_cast<const char*>(source_.data.data()) + position_;
    const std::size_t left = source_.data.size() - position_;
    const char* end = std::find(begin, begin + std::min(left, longest), '\n');
    const auto length = static_cast<std::size_t>(end - begin);
    if (length == std::min(left, longest)) fail("header line without an end");
    position_ += length + 1;
    return {begin, length};
  }
  std::uint8_t byte() {
    if (position_ >= source_.data.size()) fail("ends too early");
    return source_.byte(position_++);
  }
  Rgbe rgbe() {
    if (source_.data.size() - position_ < 4) fail("ends too early");
    const Rgbe p{source_.byte(position_), source_.byte(position_ + 1), source_.byte(position_ + 2),
                 source_.byte(position_ + 3)};
    position_ += 4;
    return p;
  }
  [[noreturn]] void fail(const std::string& problem) const {
    source_.fail(fmt::format("{} (Radiance HDR, byte {})", problem, position_));
  }

 private:
  const Source& source_;
  std::size_t position_ = 0;
};

struct Axis {
  char name;      // X or Y
  bool positive;  // in the sense of the resolution line
  int length;
};

struct HdrHeader {
  Axis outer, inner;  // a scanline runs along the inner axis
  float scale = 1;    // 1 / EXPOSURE
};

// "-Y 512 +X 1024": signs, axes and lengths; the first axis is the slow one.
HdrHeader parse_resolution(Reader& reader, const Source& source, std::string_view text) {
  const std::string line(text);
  char sign[2], axis[2];
  long length[2];
  if (std::sscanf(line.c_str(), "%c%c %9ld %c%c %9ld", &sign[0], &axis[0], &length[0], &sign[1], &axis[1],
                  &length[1]) != 6) {
    reader.fail("resolution line is not of the form '-Y HEIGHT +X WIDTH'");
  }
  const bool signs = (sign[0] == '+' || sign[0] == '-') && (sign[1] == '+' || sign[1] == '-');
  const bool axes = (axis[0] == 'X' && axis[1] == 'Y') || (axis[0] == 'Y' && axis[1] == 'X');
  if (!signs || !axes) reader.fail("resolution line is not of the form '-Y HEIGHT +X WIDTH'");
  check_size(source, axis[0] == 'X' ? length[0] : length[1], axis[0] == 'X' ? length[1] : length[0]);
  return {{axis[0], sign[0] == '+', static_cast<int>(length[0])},
          {axis[1], sign[1] == '+', static_cast<int>(length[1])}};
}

HdrHeader parse_header(Reader& reader, const Source& source) {
  double exposure = 1;
  reader.line();
  for (;;) {
    const std::string line(reader.line());
    if (line.empty()) break;
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      reader.fail(fmt::format("unsupported pixel format '{}'", line.substr(7)));
    }
    if (line.starts_with("EXPOSURE=")) exposure *= std::strtod(line.c_str() + 9, nullptr);
  }
  if (!(exposure > 1e-30 && exposure < 1e30)) reader.fail("EXPOSURE is not a positive number");
  HdrHeader header = parse_resolution(reader, source, reader.line());
  header.scale = static_cast<float>(1 / exposure);
  return header;
}

// Each of the four components as runs (count > 128) and literals.
void read_rle_scanline(Reader& reader, std::vector<Rgbe>& line) {
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t x = 0; x < line.size();) {
      std::size_t count = reader.byte();
      const bool run = count > 128;
      if (run) count -= 128;
      if (count == 0 || count > line.size() - x) reader.fail("run-length code leaves the scanline");
      if (run) {
        const std::uint8_t value = reader.byte();
        for (; count > 0; --count) line[x++][component] = value;
      } else {
        for (; count > 0; --count) line[x++][component] = reader.byte();
      }
    }
  }
}

// Plain pixels; (1,1,1,n) repeats the last one n times, consecutive ones count in base 256.
void read_old_scanline(Reader& reader, Rgbe first, std::vector<Rgbe>& line) {
  int shift = 0;
  for (std::size_t x = 0; x < line.size();) {
    const Rgbe p = x == 0 && shift == 0 ? first : reader.rgbe();
    if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
      if (x == 0 || shift > 16) reader.fail("run without a pixel to repeat");
      const std::size_t count = std::size_t{p[3]} << shift;
      if (count > line.size() - x) reader.fail("run-length code leaves the scanline");
      std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(x), count, line[x - 1]);
      x += count;
      shift += 8;
    } else {
      line[x++] = p;
      shift = 0;
    }
  }
}

void read_scanline(Reader& reader, std::vector<Rgbe>& line) {
  const Rgbe first = reader.rgbe();
  const std::size_t width = line.size();
  if (width >= 8 && width < 32768 && first[0] == 2 && first[1] == 2 && first[2] < 128) {
    if ((std::size_t{first[2]} << 8 | first[3]) != width) reader.fail("scanline of a wrong length");
    read_rle_scanline(reader, line);
  } else {
    read_old_scanline(reader, first, line);
  }
}

void append_rle(std::vector<std::byte>& out, const std::vector<std::uint8_t>& values) {
  constexpr std::size_t shortest_run = 4;
  const std::size_t size = values.size();
  const auto run_at = [&](std::size_t x) {
    std::size_t end = x + 1;
    while (end < size && end - x < 127 && values[end] == values[x]) ++end;
    return end - x;
  };
  for (std::size_t x = 0; x < size;) {
    if (const std::size_t run = run_at(x); run >= shortest_run) {
      out.push_back(static_cast<std::byte>(128 + run));
      out.push_back(static_cast<std::byte>(values[x]));
      x += run;
      continue;
    }
    std::size_t end = x + 1;
    while (end < size && end - x < 128 && run_at(end) < shortest_run) ++end;
    out.push_back(static_cast<std::byte>(end - x));
    for (; x < end; ++x) out.push_back(static_cast<std::byte>(values[x]));
  }
}

}  // namespace

Image decode_hdr(const Source& source) {
  Reader reader(source);
  const HdrHeader header = parse_header(reader, source);
  const bool rows = header.outer.name == 'Y';
  Image image(rows ? header.inner.length : header.outer.length,
              rows ? header.outer.length : header.inner.length);
  std::vector<Rgbe> line(static_cast<std::size_t>(header.inner.length));
  // Place on screen: +X runs right, −Y runs down.
  const auto place = [](const Axis& axis, int i) {
    return (axis.name == 'X') == axis.positive ? i : axis.length - 1 - i;
  };
  for (int i = 0; i < header.outer.length; ++i) {
    read_scanline(reader, line);
    const int outer = place(header.outer, i);
    for (int j = 0; j < header.inner.length; ++j) {
      const int inner = place(header.inner, j);
      image.set_rgb(rows ? inner : outer, rows ? outer : inner, header.scale * decode_rgbe(line[j]));
    }
  }
  return image;
}

std::vector<std::byte> encode_hdr(const Image& image) {
  require_whole(image, "Radiance HDR");
  const std::string header =
      fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
  const auto bytes = std::as_bytes(std::span(header));
  std::vector<std::byte> out(bytes.begin(), bytes.end());
  const bool compressible = image.width >= 8 && image.width < 32768;
  std::array<std::vector<std::uint8_t>, 4> components;
  for (int y = 0; y < image.height; ++y) {
    for (auto& component : components) component.clear();
    for (int x = 0; x < image.width; ++x) {
      const Rgbe p = encode_rgbe(image.rgb(x, y));
      for (std::size_t c = 0; c < 4; ++c) {
        if (compressible) {
          components[c].push_back(p[c]);
        } else {
          out.push_back(static_cast<std::byte>(p[c]));
        }
      }
    }
    if (!compressible) continue;
    for (const int b : {2, 2, image.width >> 8, image.width & 255}) out.push_back(static_cast<std::byte>(b));
    for (const auto& component : components) append_rle(out, component);
  }
  return out;
}

}  // namespace ssphh::image
