#include "results/tev.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <ssphh/core/bytes.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parse_number.h>

namespace ssphh::app {
namespace {

/// What a packet asks for, by the numbers of tev's protocol.
enum class Operation : std::uint8_t { create_image = 4, update_image = 6 };

constexpr int channels = 3;
constexpr int connect_milliseconds = 2000, stall_milliseconds = 5000;
constexpr std::size_t packet_bytes = std::size_t{1} << 24;  ///< about, of one update

/// The length of the whole stands first, texts end in a zero.
class Packet {
 public:
  Packet(Operation operation, bool grab_focus, const std::string& image) {
    bytes_.value(std::uint32_t{0});
    bytes_.value(static_cast<std::uint8_t>(operation));
    bytes_.value(static_cast<std::uint8_t>(grab_focus));
    text(image);
  }
  void number(int value) { bytes_.value(static_cast<std::int32_t>(value)); }
  void long_number(std::int64_t value) { bytes_.value(value); }
  void floats(std::span<const float> values) { bytes_.array(values); }
  void channel_names() {
    for (const char* name : {"R", "G", "B"}) text(name);
  }
  std::vector<std::byte> take() {
    std::vector<std::byte> packet = bytes_.take();
    const auto length = static_cast<std::uint32_t>(packet.size());
    std::memcpy(packet.data(), &length, sizeof(length));
    return packet;
  }

 private:
  void text(const std::string& text) {
    bytes_.array(std::span<const char>(text));
    bytes_.value(char{0});
  }

  ByteWriter bytes_;
};

[[noreturn]] void fail_with(int error) {
  throw Error("connection", std::strerror(error));
}

void wait_until_writable(int socket, int milliseconds) {
  pollfd waiting{socket, POLLOUT, 0};
  if (::poll(&waiting, 1, milliseconds) == 0) fail_with(ETIMEDOUT);
}

/// Waits for a connection that was begun; 0, or what kept it from being made.
int connect_within(int socket, const addrinfo& to) {
  if (::connect(socket, to.ai_addr, to.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  pollfd waiting{socket, POLLOUT, 0};
  if (::poll(&waiting, 1, connect_milliseconds) == 0) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof(error);
  ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

int connected_socket(const TevAddress& address) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int problem = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &wanted, &found))
    throw Error("connection", ::gai_strerror(problem));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, ::freeaddrinfo);
  int error = ECONNREFUSED;
  for (const addrinfo* to = found; to; to = to->ai_next) {
    const int socket = ::socket(to->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket < 0) fail_with(errno);
    error = connect_within(socket, *to);
    if (error == 0) return socket;
    ::close(socket);
  }
  fail_with(error);
}

void send_all(int socket, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent > 0)
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    else if (errno == EAGAIN)
      wait_until_writable(socket, stall_milliseconds);
    else if (errno != EINTR)
      fail_with(errno);
  }
}

}  // namespace

std::vector<std::byte> tev_create(const std::string& name, int width, int height) {
  Packet packet(Operation::create_image, true, name);
  packet.number(width), packet.number(height);
  packet.number(channels);
  packet.channel_names();
  return packet.take();
}

std::vector<std::byte> tev_update(const std::string& name, const image::Image& picture, int first, int rows) {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(rows) * channels);
  for (int y = first; y < first + rows; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const vec3 color = picture.rgb(x, y);
      values.insert(values.end(), {color.x, color.y, color.z});
    }
  }
  Packet packet(Operation::update_image, false, name);
  packet.number(channels);
  packet.channel_names();
  packet.number(0), packet.number(first), packet.number(picture.width), packet.number(rows);
  for (int c = 0; c < channels; ++c) packet.long_number(c);         // where each channel begins
  for (int c = 0; c < channels; ++c) packet.long_number(channels);  // from a pixel to the next
  packet.floats(values);
  return packet.take();
}

std::optional<TevAddress> tev_address(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  TevAddress address{text.substr(0, colon), text.substr(colon + 1)};
  if (address.host.starts_with('[') && address.host.ends_with(']'))
    address.host = address.host.substr(1, address.host.size() - 2);
  const int port = parse_number<int>(address.port).value_or(0);
  if (address.host.empty() || port < 1 || port > 65535) return std::nullopt;
  return address;
}

TevViewer::TevViewer(const std::string& address) {
  if (address.empty()) return;
  const auto found = tev_address(address);
  if (!found)
    throw Error("--tev " + address, "is no HOST:PORT", fmt::format("tev itself listens at {}", usual_tev));
  address_ = *found;
}

TevViewer::~TevViewer() {
  disconnect();
}

void TevViewer::disconnect() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
  shown_.clear();
}

void TevViewer::show(const std::string& name, const image::Image& picture) {
  const std::string problem = try_show(name, picture);
  if (!problem.empty() && !warned_) log_warning("{}", problem);
  warned_ = !problem.empty();
}

std::string TevViewer::try_show(const std::string& name, const image::Image& picture) {
  if (!*this || picture.empty()) return {};
  try {
    send(name, picture);
    return {};
  } catch (const Error& e) {
    disconnect();
    return fmt::format("--tev {}:{}: {} is not shown: {}; is tev there, and its --host the same?",
                       address_.host, address_.port, name, e.problem());
  }
}

void TevViewer::send(const std::string& name, const image::Image& picture) {
  if (socket_ < 0) socket_ = connected_socket(address_);
  const Shown shown{name, picture.width, picture.height};
  if (std::ranges::find(shown_, shown) == shown_.end()) {
    send_all(socket_, tev_create(name, picture.width, picture.height));
    std::erase_if(shown_, [&](const Shown& other) { return other.name == name; });
    shown_.push_back(shown);
  }
  const std::size_t row_bytes = static_cast<std::size_t>(picture.width) * channels * sizeof(float);
  const int rows = static_cast<int>(std::max<std::size_t>(packet_bytes / row_bytes, 1));
  for (int y = 0; y < picture.height; y += rows)
    send_all(socket_, tev_update(name, picture, y, std::min(rows, picture.height - y)));
}

}  // namespace ssphh::app
