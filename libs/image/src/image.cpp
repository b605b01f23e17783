#include <ssphh/image/image.h>

namespace ssphh::image {

void require_whole(const Image& image, const char* where) {
  require(image.width > 0 && image.height > 0, where, "the image is empty");
  require(image.channels == 1 || image.channels == 3 || image.channels == 4, where,
          "an image must have 1, 3 or 4 channels");
  require(image.pixels.size() == image.offset(0, image.height), where,
          "the image's size and its number of pixels do not agree");
}

}  // namespace ssphh::image
