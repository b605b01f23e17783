// Pictures that another program shows: in the background, the newest of each name.

#include "model/picture_sender.h"

#include <atomic>
#include <mutex>

#include <gmock/gmock.h>

#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

using testing::ElementsAre;

std::shared_ptr<const image::Image> grey(float value) {
  auto picture = std::make_shared<image::Image>(1, 1, 1);
  picture->pixels = {value};
  return picture;
}

/// A program that shows pictures, slow until it is let go.
struct Elsewhere {
  std::mutex mutex;
  std::vector<std::pair<std::string, image::Image>> shown;
  std::string problem;
  std::atomic<bool> waits{false};

  ShowElsewhere show() {
    return [this](const std::string& name, const image::Image& picture) {
      while (waits) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const std::lock_guard lock(mutex);
      shown.emplace_back(name, picture);
      return problem;
    };
  }
  std::vector<std::string> names() {
    const std::lock_guard lock(mutex);
    std::vector<std::string> names;
    for (const auto& [name, picture] : shown) names.push_back(name);
    return names;
  }
};

std::string finish(PictureSender& sender) {
  std::string news = sender.poll();
  while (!sender.idle()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (const std::string now = sender.poll(); !now.empty()) news = now;
  }
  return news;
}

TEST(PictureSender, SendsTheNewestOfEachNameAndNeverWaits) {
  Elsewhere elsewhere;
  elsewhere.waits = true;
  PictureSender sender(elsewhere.show());
  for (int i = 0; i < 5; ++i) {
    sender.send("a", grey(static_cast<float>(i)));
    sender.send("b", grey(static_cast<float>(10 + i)));
  }
  EXPECT_FALSE(sender.idle());
  elsewhere.waits = false;
  EXPECT_EQ(finish(sender), "");
  ASSERT_THAT(elsewhere.names(), ElementsAre("a", "a", "b"));
  EXPECT_EQ(elsewhere.shown[0].second.pixels[0], 0);
  EXPECT_EQ(elsewhere.shown[1].second.pixels[0], 4);
  EXPECT_EQ(elsewhere.shown[2].second.pixels[0], 14);
}

TEST(PictureSender, TellsOnceWhyNothingIsShown) {
  Elsewhere elsewhere;
  elsewhere.problem = "nobody is there";
  PictureSender sender(elsewhere.show());
  sender.send("a", grey(1));
  EXPECT_EQ(finish(sender), "nobody is there");
  sender.send("a", grey(1));
  EXPECT_EQ(finish(sender), "");
  elsewhere.problem.clear();
  sender.send("a", grey(1));
  EXPECT_EQ(finish(sender), "");
  elsewhere.problem = "nobody is there";
  sender.send("a", grey(1));
  EXPECT_EQ(finish(sender), "nobody is there") << "it was, meanwhile";
}

class ShownElsewhere : public GlStage {
 protected:
  ShownElsewhere() { show_ = elsewhere_.show(); }
  void prepare() override { options_.probes = "off"; }
  void ready() override { app().open("builtin:cornell"); }
  Elsewhere elsewhere_;
};

TEST_F(ShownElsewhere, TheKeySendsThePictureAsLinearRadiance) {
  play("");
  EXPECT_TRUE(elsewhere_.names().empty());
  play("key Shift+F12");
  ASSERT_THAT(elsewhere_.names(), ElementsAre("cornell"));
  const image::Image& sent = elsewhere_.shown[0].second;
  EXPECT_EQ(sent.width, app().picture.width());
  EXPECT_EQ(sent.channels, 3);
  app().toggle_inspector();
  play("set exposure 3\nset exposure 3");
  EXPECT_EQ(sent.pixels, app().picture.linear().pixels) << "whatever the exposure";
  EXPECT_FALSE(std::filesystem::exists("cornell-01.png")) << "F12 alone writes it";
}

TEST_F(ShownElsewhere, PassesOfATruthAreSentWhereThatIsAskedFor) {
  options_.show_truth = true;
  play("set truth-spp 3\nset show wipe");
  ASSERT_FALSE(elsewhere_.shown.empty());
  EXPECT_EQ(elsewhere_.shown.back().first, "cornell path");
  EXPECT_EQ(elsewhere_.shown.back().second.pixels, app().reference.image().color->pixels) << "the last one";
  options_.show_truth = false;
  const std::size_t before = elsewhere_.shown.size();
  play("set truth-depth 3");
  EXPECT_EQ(elsewhere_.shown.size(), before);
  play("key Shift+F12");
  EXPECT_EQ(elsewhere_.shown.size(), before + 2) << "both";
}

TEST_F(ShownElsewhere, WhoeverIsNotThereIsTold) {
  elsewhere_.problem = "--tev somewhere: is not shown";
  play("key Shift+F12");
  EXPECT_EQ(app().message, elsewhere_.problem);
  EXPECT_FALSE(app().message_is_error) << "nothing is lost";
}

}  // namespace
}  // namespace ssphh::viewer
