#include "model/settings.h"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

#include "model/script.h"
#include "temp_dir.h"

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

/// The defaults of the tool's options, of scripts and of the panels.
TEST(Settings, StartAtTheirDefaults) {
  const std::map<std::string, std::string> wanted = {
      {"exposure", "auto"},   {"tonemap", "filmic"},    {"debug", "none"},     {"scale", "1"},
      {"wipe", "0.5"},        {"indirect-scale", "3"},  {"show", "realtime"},  {"block", "16"},
      {"against", "path"},    {"truth-depth", "25"},    {"degree", "4"},       {"truth-spp", "256"},
      {"hier", "off"},        {"lookup", "irradiance"}, {"quality", "window"}, {"layer", "sum"},
      {"weights", "surface"}, {"operator", "mean"},     {"neighbors", "-1"},   {"threshold", "0"},
      {"balls", "off"},       {"ball", "radiance"},     {"ball-size", "0"},    {"lobes", "off"},
      {"graph", "off"},       {"names", "off"},         {"play", "off"},       {"speed", "0.5"},
      {"antialias", "on"},    {"histogram", "off"},     {"waveform", "off"},   {"views", "1"},
      {"false-color", "off"}, {"draw", "none"},         {"snap", "off"},       {"snap-step", "0"},
      {"snap-angle", "15"}};
  std::map<std::string, std::string> got;
  for (const SettingName& setting : setting_names()) got[setting.name] = setting.get(Settings{});
  EXPECT_EQ(got, wanted);
}

TEST(Settings, NumbersHaveLimits) {
  struct Limits {
    const char *name, *under, *low, *high, *over;
  };
  for (const Limits& l : {Limits{"exposure", "-20.01", "-20", "20", "20.01"},
                          {"views", "0", "1", "4", "5"},
                          {"scale", "0.099", "0.1", "2", "2.01"},
                          {"indirect-scale", "0", "1", "8", "9"},
                          {"wipe", "-0.01", "0", "1", "1.01"},
                          {"block", "0", "1", "1024", "1025"},
                          {"truth-depth", "-1", "0", "1000", "1001"},
                          {"truth-spp", "0", "1", "1000000", "1000001"},
                          {"degree", "-1", "0", "4", "5"},
                          {"neighbors", "-2", "-1", "65536", "65537"},
                          {"threshold", "-0.01", "0", "1", "1.01"},
                          {"ball-size", "-0.01", "0", "1000", "1000.5"},
                          {"snap-step", "-0.01", "0", "1000000", "1000001"},
                          {"snap-angle", "0.09", "0.1", "180", "180.5"},
                          {"speed", "-100.5", "-100", "100", "100.5"}}) {
    Settings s;
    for (const char* good : {l.low, l.high}) {
      set_setting(s, l.name, good);
      const auto& names = setting_names();
      const auto setting = std::ranges::find(names, l.name, &SettingName::name);
      EXPECT_FLOAT_EQ(std::stof(setting->get(s)), std::stof(good)) << l.name;
    }
    for (const char* bad : {l.under, l.over})
      EXPECT_THAT(message([&] { set_setting(s, l.name, bad); }), HasSubstr("not within")) << l.name;
  }
}

TEST(Settings, GoWhereTheirNameSays) {
  struct Case {
    const char *name, *value;
    void (*change)(Settings& s);
  };
  const Case cases[] = {
      {"exposure", "2", [](Settings& s) { s.exposure = 2, s.auto_exposure = false; }},
      {"tonemap", "clip", [](Settings& s) { s.curve = image::ToneCurve::clip; }},
      {"debug", "leak", [](Settings& s) { s.debug = DebugView::leak; }},
      {"histogram", "on", [](Settings& s) { s.histogram = true; }},
      {"waveform", "on", [](Settings& s) { s.waveform = true; }},
      {"false-color", "on", [](Settings& s) { s.false_color = true; }},
      {"draw", "voxels", [](Settings& s) { s.draw = {methods::Drawing::voxels}; }},
      {"antialias", "off", [](Settings& s) { s.antialias = false; }},
      {"views", "3", [](Settings& s) { s.views = 3; }},
      {"scale", "0.5", [](Settings& s) { s.scale = 0.5f; }},
      {"indirect-scale", "2", [](Settings& s) { s.indirect_scale = 2; }},
      {"show", "signed", [](Settings& s) { s.show = Show::signed_; }},
      {"wipe", "0.25", [](Settings& s) { s.wipe = 0.25f; }},
      {"block", "8", [](Settings& s) { s.block = 8; }},
      {"against", "vpl", [](Settings& s) { s.against = "vpl"; }},
      {"truth-depth", "3", [](Settings& s) { s.truth_depth = 3; }},
      {"truth-spp", "9", [](Settings& s) { s.truth_passes = 9; }},
      {"lookup", "light", [](Settings& s) { s.lookup = probes::LookupMethod::light; }},
      {"quality", "best", [](Settings& s) { s.quality = Quality::best; }},
      {"weights", "trilinear", [](Settings& s) { s.weights = probes::WeightMethod::trilinear; }},
      {"layer", "neighbor", [](Settings& s) { s.layer = probes::ProbeLayer::neighbor; }},
      {"degree", "3", [](Settings& s) { s.degree = 3; }},
      {"hier", "on", [](Settings& s) { s.hier = true; }},
      {"operator", "matrix", [](Settings& s) { s.hier_params.op = probes::HierOperator::matrix; }},
      {"neighbors", "5", [](Settings& s) { s.hier_params.neighbors = 5; }},
      {"threshold", "0.125", [](Settings& s) { s.hier_params.threshold = 0.125f; }},
      {"balls", "on", [](Settings& s) { s.balls = true; }},
      {"ball", "neighbor", [](Settings& s) { s.ball = Ball::neighbor; }},
      {"ball-size", "0.25", [](Settings& s) { s.ball_size = 0.25f; }},
      {"lobes", "on", [](Settings& s) { s.lobes = true; }},
      {"graph", "on", [](Settings& s) { s.graph = true; }},
      {"names", "on", [](Settings& s) { s.names = true; }},
      {"snap", "on", [](Settings& s) { s.snap = true; }},
      {"snap-step", "0.25", [](Settings& s) { s.snap_step = 0.25f; }},
      {"snap-angle", "5", [](Settings& s) { s.snap_angle = 5; }},
      {"play", "on", [](Settings& s) { s.play = true; }},
      {"speed", "-2", [](Settings& s) { s.speed = -2; }}};
  EXPECT_EQ(std::size(cases), setting_names().size());
  for (const Case& c : cases) {
    Settings set, wanted;
    set_setting(set, c.name, c.value);
    c.change(wanted);
    EXPECT_EQ(set, wanted) << c.name;
  }
}

TEST(Settings, ChoicesAreCalledWhatTheyAre) {
  EXPECT_EQ(name_of(Show::pixelated), "pixelated");
  EXPECT_EQ(name_of(Show::wipe), "wipe");
  EXPECT_EQ(name_of(DebugView::sphl), "sphl");
  EXPECT_EQ(name_of(DebugView::albedo), "albedo");
  EXPECT_EQ(name_of(Ball::irradiance), "irradiance");
  EXPECT_EQ(name_of(Ball::sum), "sum");
  Settings s;
  for (const char* name : {"absolute", "truth", "wipe"}) {
    set_setting(s, "show", name);
    EXPECT_EQ(name_of(s.show), name);
  }
  EXPECT_THAT(message([&] { set_setting(s, "against", "paht"); }), HasSubstr("\"paht\" is none of: path, "));
  EXPECT_THAT(message([&] { set_setting(s, "wipe", "0.5 "); }), HasSubstr("\"0.5 \" is not a number"));
  EXPECT_THAT(message([&] { set_setting(s, "wipe", "inf"); }), HasSubstr("is not a number"));
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

TEST(Script, WordsArePartedByAnyBlank) {
  const auto lines = parse_script("\t a\t b \r\n\"\" \"x\"y\n#\n \n", "d");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0].words, ElementsAre("a", "b"));
  EXPECT_EQ(lines[0].where, "d: line 1");
  EXPECT_THAT(lines[1].words, ElementsAre("", "x", "y"));
  EXPECT_THAT(parse_script("a b#c", "d")[0].words, ElementsAre("a", "b#c")) << "no comment within a word";
  EXPECT_TRUE(parse_script("", "d").empty());
}

TEST(Script, HasAsManyWordsAsItsUsageSays) {
  const ScriptLine line{"d: line 1", {"time", "1"}};
  EXPECT_EQ(message([&] { expect_words(line, 1, "time SECONDS"); }), "no error");
  EXPECT_EQ(message([&] { expect_words(line, 0, "time"); }), "d: line 1: is not of the form: time");
}

TEST(Script, IsReadFromAFileUpToAMebibyte) {
  const test::TempDir dir;
  write_file(dir / "s.txt", std::string_view("one\n\ntwo 2"));
  const auto lines = read_script(dir / "s.txt");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1].where, (dir / "s.txt").string() + ": line 3");
  write_file(dir / "large.txt", std::string(std::size_t{1} << 20, ' '));
  EXPECT_TRUE(read_script(dir / "large.txt").empty());
  write_file(dir / "large.txt", std::string((std::size_t{1} << 20) + 1, ' '));
  EXPECT_THROW(read_script(dir / "large.txt"), Error);
}

}  // namespace
}  // namespace ssphh::viewer
