/// What survives a file: pictures of random sizes whose values reach to the ends of what floats hold.

#include <bit>

#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/image/transfer.h>

#include "property.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

using namespace ssphh::test;
using test::same_bits;

/// A picture by its size and a seed, since what it shows does not matter.
struct Shape {
  int width, height, channels;
};
Generator<Shape> shapes(std::vector<int> channels) {
  const Generator<int> side = integers(1, 40), kind = one_of(std::move(channels));
  return {[=](Pcg32& random) {
            const int width = side.draw(random), height = side.draw(random);
            return Shape{width, height, kind.draw(random)};
          },
          [=](const Shape& s) {
            std::vector<Shape> result;
            for (const int w : side.simpler(s.width)) result.push_back({w, s.height, s.channels});
            for (const int h : side.simpler(s.height)) result.push_back({s.width, h, s.channels});
            for (const int c : kind.simpler(s.channels)) result.push_back({s.width, s.height, c});
            return result;
          }};
}
using ssphh::test::describe;
std::string describe(const Shape& s) {
  return std::to_string(s.width) + "x" + std::to_string(s.height) + "x" + std::to_string(s.channels);
}

/// Every value by `draw`.
template <class Draw>
Image painted(const Shape& shape, std::uint64_t seed, const Draw& draw) {
  Image image(shape.width, shape.height, shape.channels);
  Pcg32 random(seed);
  for (float& value : image.pixels) value = draw(random);
  return image;
}

/// Finite, of any magnitude and either sign.
float any_number(Pcg32& random) {
  const float x = std::bit_cast<float>(random.next());
  return std::isfinite(x) ? x : 0.5f;
}

Image there_and_back(const std::vector<std::byte>& file) {
  return decode_image(file, "memory");
}

/// Silences the warnings about values that a format does not hold.
class Quiet {
 public:
  Quiet() : before_(set_log_sink([](LogLevel, const std::string&) {})) {}
  ~Quiet() { set_log_sink(before_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  LogSink before_;
};

TEST(FileProperty, ExrKeepsEveryBitPatternInEverySize) {
  const Quiet quiet;
  EXPECT_TRUE(for_all(shapes({1, 3, 4}), seeds()).cases(40).holds([](const Shape& shape, std::uint64_t seed) {
    const Image image = painted(shape, seed, [](Pcg32& r) { return std::bit_cast<float>(r.next()); });
    return same_bits(there_and_back(encode_exr(image)), image);
  }));
}

TEST(FileProperty, HdrErrsByHalfAStepOfThePixelsLargestChannelAndOnlyOnce) {
  EXPECT_TRUE(for_all(shapes({3}), seeds(), integers(-100, 100))
                  .cases(40)
                  .holds([](const Shape& shape, std::uint64_t seed, int exponent) {
                    const Image image =
                        painted(shape, seed, [&](Pcg32& r) { return std::ldexp(1 - r.uniform(), exponent); });
                    const Image back = there_and_back(encode_hdr(image));
                    float worst = 0;
                    for (int y = 0; y < shape.height; ++y) {
                      for (int x = 0; x < shape.width; ++x)
                        worst = std::max(worst, max_component(glm::abs(back.rgb(x, y) - image.rgb(x, y))) /
                                                    max_component(image.rgb(x, y)));
                    }
                    if (!same_bits(there_and_back(encode_hdr(back)), back))
                      return testing::AssertionFailure() << "the second trip changed it again";
                    // Where the largest rounds up to the next power of two, the others' step is 1/255.5 of
                    // it.
                    return at_most(static_cast<double>(worst), 0.5 / 127.75);
                  }));
}

TEST(FileProperty, HdrHoldsEveryNumberThatIsNotNegativeUpToItsLargest) {
  const Quiet quiet;
  EXPECT_TRUE(for_all(shapes({3}), seeds()).cases(40).holds([](const Shape& shape, std::uint64_t seed) {
    const Image image = painted(shape, seed, any_number);
    const Image back = there_and_back(encode_hdr(image));
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const vec3 kept = glm::min(glm::max(image.rgb(x, y), 0.0f), 0x1.fep126f), found = back.rgb(x, y);
        // Below 2⁻¹²⁸ there is no exponent.
        if (!(max_component(glm::abs(found - kept)) <= max_component(kept) / 256 + 0x1p-128f))
          return testing::AssertionFailure() << describe(found) << ", not " << describe(kept);
      }
    }
    return testing::AssertionSuccess();
  }));
}

TEST(FileProperty, PngRoundsToTheNearestCodeAndIsThenStable) {
  EXPECT_TRUE(for_all(shapes({1, 3, 4}), seeds()).cases(40).holds([](const Shape& shape, std::uint64_t seed) {
    const Image image = painted(shape, seed, [](Pcg32& r) { return 1.4f * r.uniform() - 0.2f; });
    const std::vector<std::byte> file = encode_png(image);
    const Image back = there_and_back(file);
    if (back.channels != shape.channels || encode_png(back) != file)
      return testing::AssertionFailure() << "the second trip changed it again";
    double worst = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const bool alpha = shape.channels == 4 && i % 4 == 3;
      const auto code = [&](float x) {
        const float clamped = glm::clamp(x, 0.0f, 1.0f);
        return 255.0 * static_cast<double>(alpha ? clamped : linear_to_srgb(clamped));
      };
      worst = std::max(worst, std::abs(code(back.pixels[i]) - code(image.pixels[i])));
    }
    return at_most(worst, 0.5 + 1e-4);  // the curve there and back in float
  }));
}

TEST(FileProperty, EightBitPicturesComeBackByteByByte) {
  EXPECT_TRUE(for_all(shapes({4}), seeds()).cases(40).holds([](const Shape& shape, std::uint64_t seed) {
    Rgba8 image{shape.width, shape.height, {}};
    Pcg32 random(seed);
    for (int i = 0; i < 4 * shape.width * shape.height; ++i)
      image.rgba.push_back(static_cast<std::uint8_t>(random.next() >> 24));
    const Rgba8 back = decode_rgba8(encode_png(image), "memory");
    return back.width == image.width && back.height == image.height && back.rgba == image.rgba;
  }));
}

TEST(TransferProperty, TheCurveRisesAndIsUndoneByItsInverse) {
  EXPECT_TRUE(for_all(floats(-2, 2), floats(0, 1)).cases(300).holds([](float x, float more) {
    if (!(srgb_to_linear(x) <= srgb_to_linear(x + more))) return testing::AssertionFailure() << "it falls";
    // The slope 1/12.92 .. 2.3 and its inverse: a few roundings of numbers up to 5.
    return at_most(static_cast<double>(std::abs(linear_to_srgb(srgb_to_linear(x)) - x)), 2e-6);
  }));
}

}  // namespace
}  // namespace ssphh::image
