#pragma once
/// A stand-in for the viewer tev: listens on a free port of this machine and decodes what comes, by the
/// description of tev's protocol: [uint32 length of all][byte operation][payload], little-endian, texts ended
/// by a zero.

#include <atomic>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <ssphh/core/bytes.h>
#include <ssphh/image/image.h>

namespace ssphh::test {

/// What a viewer would show.
struct TevImages {
  std::map<std::string, image::Image> images;  ///< by name
  std::map<std::string, int> creations;
  std::map<std::string, std::vector<image::Image>> seen;  ///< as they were after each update of the last row
};

inline std::string zero_ended(ByteReader& bytes) {
  std::string text;
  while (const char c = bytes.value<char>("text")) text += c;
  return text;
}

inline void expect_rgb(ByteReader& bytes) {
  ASSERT_EQ(bytes.value<std::int32_t>("channels"), 3);
  for (const char* name : {"R", "G", "B"}) EXPECT_EQ(zero_ended(bytes), name);
}

/// Of one packet without its length.
inline void take_tev_packet(std::span<const std::byte> packet, TevImages& shown) {
  ByteReader bytes(packet, "tev packet");
  const int operation = bytes.value<std::uint8_t>("operation");
  bytes.value_in<std::uint8_t>("grab focus", 0, 1);
  const std::string name = zero_ended(bytes);
  if (operation == 4) {
    const int width = bytes.value<std::int32_t>("width"), height = bytes.value<std::int32_t>("height");
    expect_rgb(bytes);
    shown.images[name] = image::Image(width, height);
    ++shown.creations[name];
  } else {
    ASSERT_EQ(operation, 6);
    ASSERT_TRUE(shown.images.contains(name)) << name;
    image::Image& picture = shown.images[name];
    expect_rgb(bytes);
    const int x0 = bytes.value<std::int32_t>("x"), y0 = bytes.value<std::int32_t>("y");
    const int width = bytes.value<std::int32_t>("width"), height = bytes.value<std::int32_t>("height");
    ASSERT_TRUE(x0 >= 0 && y0 >= 0 && width <= picture.width - x0 && height <= picture.height - y0);
    std::int64_t offsets[3], strides[3];
    for (auto& offset : offsets) offset = bytes.value<std::int64_t>("offset");
    for (auto& stride : strides) stride = bytes.value<std::int64_t>("stride");
    std::vector<float> values(bytes.left() / sizeof(float));
    bytes.raw("pixels", std::span(values));
    for (int i = 0; i < width * height; ++i)
      for (int c = 0; c < 3; ++c)
        picture.at(x0 + i % width, y0 + i / width)[c] =
            values.at(static_cast<std::size_t>(offsets[c] + i * strides[c]));
    if (y0 + height == picture.height) shown.seen[name].push_back(picture);
  }
  bytes.expect_end();
}

class TevListener {
 public:
  /// Port 0: a free one.
  explicit TevListener(int port = 0) : fd_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int again = 1;
    ::setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &again, sizeof again);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(fd_, 4), 0);
    socklen_t size = sizeof address;
    ::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~TevListener() { stop(); }

  int port() const { return port_; }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  /// All that came until those who were connected have gone; nobody listens after.
  const TevImages& shown() {
    stop();
    return shown_;
  }

 private:
  void stop() {
    if (!thread_.joinable()) return;
    const int last = ::socket(AF_INET, SOCK_STREAM, 0);  // an empty connection is the end
    sockaddr_in address{};
    address.sin_family = AF_INET, address.sin_port = htons(static_cast<std::uint16_t>(port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(last, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ::close(last);
    thread_.join();
    ::close(fd_);
  }
  void serve() {
    for (bool any = true; any;) {
      const int peer = ::accept(fd_, nullptr, nullptr);
      any = false;
      std::uint32_t length = 0;
      while (take(peer, &length, sizeof length)) {
        any = true;
        std::vector<std::byte> packet(length - sizeof length);
        if (!take(peer, packet.data(), packet.size())) break;
        take_tev_packet(packet, shown_);
      }
      ::close(peer);
    }
  }
  static bool take(int peer, void* to, std::size_t size) {
    return ::recv(peer, to, size, MSG_WAITALL) == static_cast<ssize_t>(size);
  }

  int fd_, port_ = 0;
  TevImages shown_;
  std::thread thread_;
};

}  // namespace ssphh::test
