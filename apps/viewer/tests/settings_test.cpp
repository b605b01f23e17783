#include "model/settings.h"

#include <set>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>

#include "model/script.h"

namespace ssphh::viewer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class Call>
std::string message(const Call& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(Settings, EveryNameSetsAndTellsItsValue) {
  std::set<std::string> names;
  for (const SettingName& setting : setting_names()) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name << " twice";
    EXPECT_FALSE(setting.help.empty() || setting.group.empty());
    // What is told can be set again, and every choice changes what is told.
    Settings settings;
    const std::string before = setting.get(settings);
    set_setting(settings, setting.name, before);
    EXPECT_EQ(settings, Settings{}) << setting.name;
    for (const std::string& choice : setting.choices) {
      set_setting(settings, setting.name, choice);
      EXPECT_EQ(setting.get(settings), choice);
    }
    if (setting.choices.empty()) {
      set_setting(settings, setting.name, before == "1" ? "2" : "1");
      EXPECT_NE(settings, Settings{}) << setting.name;
    }
  }
}

TEST(Settings, WrongOnesSayWhatWouldBeRight) {
  Settings s;
  EXPECT_THAT(message([&] { set_setting(s, "exposre", "1"); }), HasSubstr("exposure, tonemap"));
  EXPECT_THAT(message([&] { set_setting(s, "exposure", "bright"); }),
              HasSubstr("\"bright\" is not a number"));
  EXPECT_THAT(message([&] { set_setting(s, "exposure", "nan"); }), HasSubstr("not a number"));
  EXPECT_THAT(message([&] { set_setting(s, "wipe", "2"); }), HasSubstr("not within 0 to 1"));
  EXPECT_THAT(message([&] { set_setting(s, "degree", "1.5"); }), HasSubstr("not a whole number"));
  EXPECT_THAT(message([&] { set_setting(s, "show", "all"); }), HasSubstr("realtime, truth, wipe"));
  EXPECT_EQ(s, Settings{});
}

TEST(Script, IsReadLineByLine) {
  const auto lines = parse_script("# a demo\n\ntime 1\r\n  light \"ceiling lamp\" on off  # dark\nquit", "d");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0].words, ElementsAre("time", "1"));
  EXPECT_THAT(lines[1].words, ElementsAre("light", "ceiling lamp", "on", "off"));
  EXPECT_EQ(lines[1].where, "d: line 4");
  EXPECT_THAT(lines[2].words, ElementsAre("quit"));
  EXPECT_THAT(message([] { parse_script("a\nb \"c", "d"); }), HasSubstr("d: line 2: a quote does not end"));
  EXPECT_THAT(message([&] { expect_words(lines[0], 2, "time A B"); }),
              HasSubstr("d: line 3: is not of the form"));
}

}  // namespace
}  // namespace ssphh::viewer
