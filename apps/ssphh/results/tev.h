#pragma once
/// Pictures shown while they are made, in tev, a viewer of HDR images (https://github.com/Tom94/tev).

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/image/image.h>

namespace ssphh::app {

/// tev's packet that makes a black image of the channels R, G, B, in place of one of that name, and shows it.
std::vector<std::byte> tev_create(const std::string& name, int width, int height);
/// tev's packet with rows [first, first + rows) of a picture, in an image that was made before. A one-channel
/// picture is sent grey, without alpha.
std::vector<std::byte> tev_update(const std::string& name, const image::Image& picture, int first, int rows);

/// Where tev listens unless its --host says otherwise.
inline constexpr const char* usual_tev = "127.0.0.1:14158";

struct TevAddress {
  std::string host, port;
};
/// Of "HOST:PORT", where HOST is a name, or a number with or without brackets; none of any other text.
std::optional<TevAddress> tev_address(const std::string& text);

/// A tev that listens somewhere. What keeps a picture from being shown is a warning, never a failure:
/// pictures are made to be written.
class TevViewer {
 public:
  /// `address`: "HOST:PORT"; empty: there is none, and show() does nothing. Throws Error for any other text.
  explicit TevViewer(const std::string& address);
  ~TevViewer();
  TevViewer(const TevViewer&) = delete;
  TevViewer& operator=(const TevViewer&) = delete;

  explicit operator bool() const { return !address_.host.empty(); }
  /// Shows linear radiance under that name, in place of what was shown under it before. Connects where there
  /// is no connection, waiting two seconds at most, and warns once until a picture has come through again.
  void show(const std::string& name, const image::Image& picture);
  /// The same without a warning: why it is not shown, or an empty text.
  std::string try_show(const std::string& name, const image::Image& picture);

 private:
  void send(const std::string& name, const image::Image& picture);
  void disconnect();

  struct Shown {
    std::string name;
    int width, height;
    bool operator==(const Shown&) const = default;
  };

  TevAddress address_;
  int socket_ = -1;
  std::vector<Shown> shown_;  ///< over this connection
  bool warned_ = false;
};

}  // namespace ssphh::app
