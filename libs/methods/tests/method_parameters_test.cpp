#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/methods/method_list.h>

namespace ssphh::methods {
namespace {

using testing::HasSubstr;
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
  EXPECT_THAT([] { read({"photon=3"}); }, ThrowsMessage<Error>(HasSubstr("did you mean \"photons\"")));
  EXPECT_THAT([] { read({"photons=x"}); }, ThrowsMessage<Error>(HasSubstr("photons of method vpl: \"x\"")));
  EXPECT_THAT([] { read({"photons=1.5"}); }, ThrowsMessage<Error>(HasSubstr("whole")));
  EXPECT_THAT([] { read({"photons=1001"}); }, ThrowsMessage<Error>(HasSubstr("1 to 1000")));
  EXPECT_THAT([] { read({"clamp=nan"}); }, ThrowsMessage<Error>(HasSubstr("no number")));
  EXPECT_THAT([] { read({"clamp=1m"}); }, ThrowsMessage<Error>(HasSubstr("no number")));
  EXPECT_THAT([] { read({"kind=disc"}); }, ThrowsMessage<Error>(HasSubstr("point, sphere")));
  EXPECT_THAT([] { read({"clamp"}); }, ThrowsMessage<Error>(HasSubstr("NAME=VALUE")));
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
