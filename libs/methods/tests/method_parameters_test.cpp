#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/methods/method_list.h>

#include "error_message.h"

namespace ssphh::methods {
namespace {

using testing::ThrowsMessage;

const std::vector<MethodParameter> declared = {{"photons", 64, 1, 1000, "per light", true},
                                               {"clamp", 0.5, 0, 10, "of the geometry term [m⁻²]"},
                                               {"kind", 1, 0, 1, "of light", true, {"point", "sphere"}}};

MethodParameters read(const std::vector<std::string>& settings) {
  return MethodParameters("vpl", declared, settings);
}

TEST(MethodParameters, DefaultsAndSettings) {
  const MethodParameters p = read({"clamp=1.5", "kind=point"});
  EXPECT_EQ(p.integer("photons"), 64);
  EXPECT_EQ(p.number("clamp"), 1.5);
  EXPECT_EQ(p.choice("kind"), "point");
  EXPECT_EQ(read({}).choice("kind"), "sphere");
}

TEST(MethodParameters, LieBetweenTheirLimits) {
  for (const char* good : {"photons=1", "photons=1000", "clamp=0", "clamp=10", "photons=1e3", "photons=64.0"})
    EXPECT_NO_THROW(read({good})) << good;
  for (const char* bad : {"photons=0", "photons=1001", "clamp=-0.001", "clamp=10.001"})
    EXPECT_THROW(read({bad}), Error) << bad;
}

TEST(MethodParameters, BadOnesAreNamed) {
  const auto said = [](const std::string& setting) { return test::message_of([&] { read({setting}); }); };
  EXPECT_EQ(said("photon=3"), "method vpl: there is no parameter \"photon\" (did you mean \"photons\"?)");
  EXPECT_EQ(said("photons=x"), "photons of method vpl: \"x\" is no number");
  EXPECT_EQ(said("photons=1.5"), "photons of method vpl: 1.5 is no whole number");
  EXPECT_EQ(said("photons=1001"), "photons of method vpl: 1001 is not within 1 to 1000");
  EXPECT_EQ(said("clamp=nan"), "clamp of method vpl: \"nan\" is no number");
  EXPECT_EQ(said("clamp=1m"), "clamp of method vpl: \"1m\" is no number");
  EXPECT_EQ(said("kind=disc"), "kind of method vpl: \"disc\" is none of: point, sphere");
  EXPECT_EQ(said("clamp"), "parameter \"clamp\": has no value (write NAME=VALUE)");
  EXPECT_EQ(test::message_of([] { MethodParameters("vpl", {}, std::vector<std::string>{"clamp=1"}); }),
            "method vpl: there is no parameter \"clamp\": it has none");
}

TEST(MethodTable, NamesAreUniqueAndDefaultsValid) {
  std::vector<std::string> names;
  for (const MethodEntry& entry : all_methods()) {
    EXPECT_THAT(names, testing::Not(testing::Contains(entry.name)));
    names.emplace_back(entry.name);
    EXPECT_EQ(&find_method(entry.name), &entry);
    for (const MethodParameter& p : entry.parameters) {
      EXPECT_GE(p.value, p.least) << entry.name << " " << p.name;
      EXPECT_LE(p.value, p.most) << entry.name << " " << p.name;
      if (p.choices.empty()) continue;
      EXPECT_EQ(static_cast<double>(p.choices.size()), p.most + 1) << entry.name << " " << p.name;
    }
  }
  EXPECT_THAT([] { find_method("radiosity"); },
              ThrowsMessage<Error>("method radiosity: there is no such method (choose one of ambient, ddgi, "
                                   "direct, irradiance-volume, prt, ssphh, ssphh-paper, vct, vpl)"));
}

}  // namespace
}  // namespace ssphh::methods
