#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/log.h>

#include "exr_header.h"

namespace ssphh::image {
namespace {

class MemoryInput final : public Imf::IStream {
 public:
  explicit MemoryInput(const Source& source) : IStream(""), data_(source.data) {}

  bool read(char* out, int count) override {
    if (count < 0 || static_cast<std::uint64_t>(count) > data_.size() - position_) {
      throw std::runtime_error(fmt::format("ends too early (byte {})", position_));
    }
    std::memcpy(out, data_.data() + position_, static_cast<std::size_t>(count));
    position_ += static_cast<std::uint64_t>(count);
    return position_ < data_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override {
    if (position > data_.size()) throw std::runtime_error("refers to a place behind its end");
    position_ = position;
  }

 private:
  std::span<const std::byte> data_;
  std::uint64_t position_ = 0;
};

// Names of the channels that make the image, in the image's order; empty when none fit.
std::vector<std::string> choose_channels(const Source& source, const ExrHeader& header) {
  const auto has = [&](const std::string& name) {
    return std::ranges::any_of(header.channels,
                               [&](const ExrChannel& c) { return c.name == name && !c.subsampled; });
  };
  const auto rgb = [&](const std::string& prefix) -> std::vector<std::string> {
    if (!has(prefix + "R") || !has(prefix + "G") || !has(prefix + "B")) return {};
    std::vector<std::string> names{prefix + "R", prefix + "G", prefix + "B"};
    if (has(prefix + "A")) names.push_back(prefix + "A");
    return names;
  };
  if (auto names = rgb(""); !names.empty()) return names;
  if (has("Y")) return {"Y"};
  for (const ExrChannel& channel : header.channels) {
    const std::size_t dot = channel.name.rfind('.');
    if (dot == std::string::npos) continue;
    if (auto names = rgb(channel.name.substr(0, dot + 1)); !names.empty()) {
      log_warning("{}: no channels R, G, B; layer '{}' is used", source.name, channel.name.substr(0, dot));
      return names;
    }
  }
  if (header.channels.size() == 1 && !header.channels[0].subsampled) return {header.channels[0].name};
  return {};
}

bool has_chroma(const ExrHeader& header) {
  return std::ranges::any_of(header.channels,
                             [](const ExrChannel& c) { return c.name == "RY" || c.name == "BY"; });
}

void warn_about_primaries(const Source& source, const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  const Imf::Chromaticities rec709;
  const auto far = [](const Imath::V2f& a, const Imath::V2f& b) { return !((a - b).length() < 1e-3f); };
  if (far(c.red, rec709.red) || far(c.green, rec709.green) || far(c.blue, rec709.blue) ||
      far(c.white, rec709.white)) {
    log_warning("{}: its primaries are not Rec.709; colours are kept as they are", source.name);
  }
}

Imath::Box2i box(const ExrWindow& w) {
  return {{static_cast<int>(w.min_x), static_cast<int>(w.min_y)},
          {static_cast<int>(w.max_x), static_cast<int>(w.max_y)}};
}

Image window_image(const ExrWindow& w, int channels) {
  return {static_cast<int>(w.width()), static_cast<int>(w.height()), channels};
}

Image read_channels(Imf::InputPart& part, const ExrHeader& header, const std::vector<std::string>& names) {
  Image image = window_image(header.data, static_cast<int>(names.size()));
  const std::size_t pixel = names.size() * sizeof(float);
  const std::size_t row = pixel * static_cast<std::size_t>(image.width);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < names.size(); ++c) {
    buffer.insert(names[c],
                  Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, box(header.data), pixel, row));
  }
  part.setFrameBuffer(buffer);
  part.readPixels(static_cast<int>(header.data.min_y), static_cast<int>(header.data.max_y));
  return image;
}

// Luminance and half-resolution chroma, converted by OpenEXR.
Image read_luminance_chroma(const Source& source, const ExrHeader& header) {
  MemoryInput stream(source);
  Imf::RgbaInputFile file(stream, 0);
  const Image shape = window_image(header.data, 1);
  std::vector<Imf::Rgba> colors(shape.pixels.size());
  const Imf::Slice slice = Imf::Slice::Make(Imf::HALF, colors.data(), box(header.data), sizeof(Imf::Rgba),
                                            sizeof(Imf::Rgba) * static_cast<std::size_t>(shape.width));
  file.setFrameBuffer(reinterpret_cast<Imf::Rgba*>(slice.base), 1, static_cast<std::size_t>(shape.width));
  file.readPixels(static_cast<int>(header.data.min_y), static_cast<int>(header.data.max_y));
  const bool alpha = (file.channels() & Imf::WRITE_A) != 0;
  Image image(shape.width, shape.height, alpha ? 4 : 3);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    float* p = image.pixels.data() + i * static_cast<std::size_t>(image.channels);
    p[0] = colors[i].r, p[1] = colors[i].g, p[2] = colors[i].b;
    if (alpha) p[3] = colors[i].a;
  }
  return image;
}

Image crop_to_display(const Source& source, const ExrHeader& header, Image&& data) {
  const ExrWindow &from = header.data, &to = header.display;
  if (from.min_x == to.min_x && from.min_y == to.min_y && from.max_x == to.max_x && from.max_y == to.max_y) {
    return std::move(data);
  }
  Image image = window_image(to, data.channels);
  const std::int64_t x0 = std::max(from.min_x, to.min_x), x1 = std::min(from.max_x, to.max_x) + 1;
  const std::int64_t y0 = std::max(from.min_y, to.min_y), y1 = std::min(from.max_y, to.max_y) + 1;
  if (x0 >= x1 || y0 >= y1) {
    log_warning("{}: its data window lies outside its display window: the image is black", source.name);
    return image;
  }
  for (std::int64_t y = y0; y < y1; ++y) {
    const float* in = data.at(static_cast<int>(x0 - from.min_x), static_cast<int>(y - from.min_y));
    float* out = image.at(static_cast<int>(x0 - to.min_x), static_cast<int>(y - to.min_y));
    std::copy_n(in, (x1 - x0) * data.channels, out);
  }
  return image;
}

// The first part with flat pixels.
std::size_t choose_part(const Source& source, const std::vector<ExrHeader>& headers) {
  const auto flat = std::ranges::find_if(headers, [](const ExrHeader& h) { return !h.deep; });
  if (flat == headers.end()) source.fail("holds only deep pixels", "flatten the image first");
  const auto part = static_cast<std::size_t>(flat - headers.begin());
  if (headers.size() > 1) log_warning("{}: has {} parts; part {} is used", source.name, headers.size(), part);
  return part;
}

Image decode(const Source& source) {
  const std::vector<ExrHeader> headers = check_exr_headers(source);
  const std::size_t index = choose_part(source, headers);
  const ExrHeader& header = headers[index];
  if (has_chroma(header) && headers.size() == 1) {
    return crop_to_display(source, header, read_luminance_chroma(source, header));
  }
  const std::vector<std::string> names = choose_channels(source, header);
  if (names.empty()) {
    std::vector<std::string> present;
    for (const ExrChannel& channel : header.channels) present.push_back(channel.name);
    present.resize(std::min<std::size_t>(present.size(), 20));
    source.fail(fmt::format("has no channels R, G, B or Y, only {}", fmt::join(present, ", ")));
  }
  MemoryInput stream(source);
  Imf::MultiPartInputFile file(stream, 0, false);
  if (!file.partComplete(static_cast<int>(index))) source.fail("is incomplete: blocks of pixels are missing");
  Imf::InputPart part(file, static_cast<int>(index));
  warn_about_primaries(source, part.header());
  return crop_to_display(source, header, read_channels(part, header, names));
}

}  // namespace

Image decode_exr(const Source& source) {
  try {
    return decode(source);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    source.fail(fmt::format("broken OpenEXR: {}", e.what()));
  }
}

}  // namespace ssphh::image
