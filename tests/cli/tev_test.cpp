// --tev: what a stand-in for the viewer tev gets is what is written, pass by pass; without one nothing is
// lost.

#include "results/tev.h"

#include <memory>

#include <gmock/gmock.h>

#include <ssphh/image/io.h>

#include "commands/command.h"
#include "here.h"
#include "temp_dir.h"
#include "tev_listener.h"

namespace ssphh {
namespace {

using image::Image;
using test::TevListener;
using testing::AllOf;
using testing::HasSubstr;

std::vector<std::string> render(const std::string& output, const std::string& address) {
  return {"render", "builtin:cornell", "--width", "9",  "--height", "6",     "--passes",
          "3",      "--spp",           "1",       "-o", output,     "--tev", address};
}

TEST(Tev, PacketsAreTheBytesOfItsDescription) {
  Image picture(1, 2);
  picture.set_rgb(0, 1, {1, 2, 3});
  const auto text = [](const std::vector<std::byte>& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const std::string rgb("R\0G\0B\0", 6), three("\3\0\0\0", 4), one("\1\0\0\0", 4), zero(4, '\0');
  EXPECT_EQ(text(app::tev_create("ab", 1, 2)),
            std::string("\x1b\0\0\0\4\1ab\0", 9) + one + std::string("\2\0\0\0", 4) + three + rgb);
  const std::string long_zero(8, '\0'), long_one = one + zero, long_two = std::string("\2\0\0\0", 4) + zero,
                                        long_three = three + zero;
  EXPECT_EQ(text(app::tev_update("ab", picture, 1, 1)),
            std::string("\x5f\0\0\0\6\0ab\0", 9) + three + rgb + zero + one + one + one + long_zero +
                long_one + long_two + long_three + long_three + long_three +
                std::string("\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40", 12));
}

TEST(Tev, ShowsEachPassOfARenderAndThenWhatWasWritten) {
  const test::TempDir dir;
  TevListener listener;
  const std::string out = dir / "a.exr";
  test::run_here(render(out, listener.address()));
  const test::TevImages& shown = listener.shown();
  const Image written = image::read_image(out);
  ASSERT_EQ(shown.seen.count(out), 1u);
  const std::vector<Image>& seen = shown.seen.at(out);
  ASSERT_EQ(seen.size(), 4u) << "three passes and the end";
  EXPECT_EQ(shown.creations.at(out), 1);
  EXPECT_EQ(seen.back().pixels, written.pixels);
  EXPECT_EQ(seen[2].pixels, written.pixels);
  EXPECT_NE(seen[0].pixels, seen[1].pixels);
}

TEST(Tev, ShowsPicturesOfManyPacketsAndOfOtherSizesUnderTheirNames) {
  TevListener listener;
  Image large(2000, 1500), grey(3, 2, 1);
  for (std::size_t i = 0; i < large.pixels.size(); ++i) large.pixels[i] = static_cast<float>(i % 7919);
  grey.pixels = {1, 2, 3, 4, 5, 6};
  {
    app::TevViewer viewer(listener.address());
    viewer.show("large", large);
    viewer.show("other", Image(5, 5));
    viewer.show("other", grey);
  }
  const test::TevImages& shown = listener.shown();
  EXPECT_EQ(shown.images.at("large").pixels, large.pixels);
  EXPECT_EQ(shown.creations.at("large"), 1);
  EXPECT_EQ(shown.creations.at("other"), 2);
  EXPECT_EQ(shown.images.at("other").rgb(2, 1), vec3(6));
}

TEST(Tev, NobodyThereIsAWarningAndThePictureIsWritten) {
  const test::TempDir dir;
  std::string address;
  { address = TevListener().address(); }
  const std::string out = dir / "a.exr", plain = dir / "b.exr";
  const test::HereResult result = test::run_here(render(out, address));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--tev " + address), HasSubstr("Connection refused")));
  EXPECT_EQ(result.err.find("--tev"), result.err.rfind("--tev")) << "told once";
  auto without = render(plain, "");
  without.resize(without.size() - 2);
  test::run_here(without);
  EXPECT_EQ(image::read_image(out).pixels, image::read_image(plain).pixels);
}

TEST(Tev, WarnsOnceWhileNobodyIsThereAndShowsPicturesAgainAfter) {
  const Image picture(2, 1);
  auto first = std::make_unique<TevListener>();
  auto viewer = std::make_unique<app::TevViewer>(first->address());
  const int port = first->port();
  first.reset();
  testing::internal::CaptureStderr();
  viewer->show("a", picture), viewer->show("a", picture);
  TevListener second(port);
  viewer->show("a", picture);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(told.find("a is not shown"), told.rfind("a is not shown"));
  EXPECT_THAT(told, HasSubstr("a is not shown"));
  viewer.reset();
  EXPECT_EQ(second.shown().seen.at("a").size(), 1u);
  app::TevViewer nobody("");
  EXPECT_FALSE(nobody);
  nobody.show("a", picture);
}

TEST(Tev, AddressesAreHostAndPort) {
  const auto address = app::tev_address("[::1]:14158");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->host, "::1");
  EXPECT_EQ(address->port, "14158");
  for (const char* wrong : {"", "localhost", "localhost:", ":14158", "a:0", "a:65536", "a:1x", "[]:1"}) {
    EXPECT_FALSE(app::tev_address(wrong)) << wrong;
    if (*wrong) {
      EXPECT_THROW(app::TevViewer{wrong}, Error) << wrong;
    }
  }
  EXPECT_THROW(test::run_here(render("a.exr", "nowhere")), app::ParsingEnded);
}

TEST(Tev, ShowsBothPicturesOfAComparisonAndTheirDifference) {
  const test::TempDir dir;
  TevListener listener;
  Image a(4, 3), b(4, 3);
  a.set_rgb(1, 1, vec3(2)), b.set_rgb(1, 1, {2.5f, 2, 1});
  const std::string first = dir / "a.exr", second = dir / "b.exr";
  image::write_image(first, a), image::write_image(second, b);
  test::run_here({"compare", first, second, "--map", "signed", "--tev", listener.address()});
  const auto& images = listener.shown().images;
  ASSERT_EQ(images.size(), 3u);
  EXPECT_EQ(images.at(first).pixels, a.pixels);
  EXPECT_EQ(images.at(second).pixels, b.pixels);
  EXPECT_GT(images.at(second + ": signed error").rgb(1, 1).x, 0.0f);
}

}  // namespace
}  // namespace ssphh
