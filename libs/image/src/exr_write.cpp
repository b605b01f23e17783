#include <array>
#include <cstring>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include <ssphh/image/half.h>
#include <ssphh/image/io.h>

namespace ssphh::image {
namespace {

class MemoryOutput final : public Imf::OStream {
 public:
  MemoryOutput() : OStream("memory") {}

  void write(const char* data, int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (position_ + size > data_.size()) data_.resize(position_ + size);
    std::memcpy(data_.data() + position_, data, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  std::vector<std::byte> take() { return std::move(data_); }

 private:
  std::vector<std::byte> data_;
  std::uint64_t position_ = 0;
};

constexpr std::array<const char*, 4> rgba{"R", "G", "B", "A"};

std::vector<std::byte> written(const Imf::Header& header, const Imf::FrameBuffer& buffer, int height) {
  MemoryOutput stream;
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
  }
  return stream.take();
}

}  // namespace

std::vector<std::byte> encode_half_exr(const Image& image) {
  require_whole(image, "OpenEXR");
  std::vector<std::uint16_t> halves;
  halves.reserve(image.pixels.size());
  for (const float value : image.pixels) halves.push_back(to_half(value, "OpenEXR"));
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer buffer;
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t pixel = channels * sizeof(std::uint16_t);
  for (std::size_t c = 0; c < channels; ++c) {
    const char* name = channels == 1 ? "Y" : rgba[c];
    header.channels().insert(name, Imf::Channel(Imf::HALF));
    buffer.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(halves.data() + c), pixel,
                                   pixel * static_cast<std::size_t>(image.width)));
  }
  return written(header, buffer, image.height);
}

std::vector<std::byte> encode_exr(const Image& image, std::span<const NamedChannel> extra) {
  require_whole(image, "OpenEXR");
  const std::size_t pixel_count =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer buffer;
  const auto add = [&](const std::string& name, const float* values, std::size_t stride) {
    if (header.channels().findChannel(name)) throw Error("OpenEXR", "there are two channels " + name);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // OpenEXR reads through a non-const pointer.
    char* base = reinterpret_cast<char*>(const_cast<float*>(values));
    const std::size_t pixel = stride * sizeof(float);
    buffer.insert(name, Imf::Slice(Imf::FLOAT, base, pixel, pixel * static_cast<std::size_t>(image.width)));
  };
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    add(channels == 1 ? "Y" : rgba[c], image.pixels.data() + c, channels);
  }
  for (const NamedChannel& channel : extra) {
    if (channel.values.size() != pixel_count)
      throw Error("OpenEXR", "channel " + channel.name + " has not one value for each pixel");
    add(channel.name, channel.values.data(), 1);
  }
  return written(header, buffer, image.height);
}

}  // namespace ssphh::image
