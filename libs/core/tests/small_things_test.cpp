/// What everything else is built on: defaults, who owns what, stages of long work, vectors.

#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include <ssphh/core/bytes.h>
#include <ssphh/core/contraction.h>
#include <ssphh/core/control.h>
#include <ssphh/core/counted.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/held.h>
#include <ssphh/core/json.h>
#include <ssphh/core/log.h>
#include <ssphh/core/math.h>
#include <ssphh/core/random.h>
#include <ssphh/core/stopwatch.h>

#include "error_message.h"

namespace ssphh {
namespace {

using test::message_of;

TEST(CoreDefaults, AreNamed) {
  EXPECT_EQ(Contraction().lower, 0);
  EXPECT_EQ(Contraction().upper, 0);
  const json::Limits limits;
  EXPECT_EQ(limits.bytes, 268435456u);
  EXPECT_EQ(limits.depth, 128);
  EXPECT_EQ(limits.containers, 4194304u);
  EXPECT_EQ(Hash128().high, 0u);
  EXPECT_EQ(Hash128().low, 0u);
  EXPECT_EQ((Hash128{0x0123456789abcdef, 0xfedcba9876543210}.hex()), "0123456789abcdeffedcba9876543210");
  EXPECT_EQ((Hash128{1, 2}.hex()), "00000000000000010000000000000002");
  const Control control;
  EXPECT_EQ(control.progress, nullptr);
  EXPECT_EQ(control.cancel, nullptr);
  EXPECT_FALSE(control.cancelled());
  EXPECT_FALSE(CancelToken().requested());
  EXPECT_STREQ(Cancelled().what(), "cancelled");
  EXPECT_EQ(pixel_seed(1, 2, 3), pixel_seed(1, 2, 3, 0));
}

TEST(Errors, HoldTheirParts) {
  const Error error("a.glb", "is broken", "export it again");
  EXPECT_EQ(error.where(), "a.glb");
  EXPECT_EQ(error.problem(), "is broken");
  EXPECT_EQ(error.hint(), "export it again");
  EXPECT_EQ(message_of([] { refuse("here", "is wrong"); }), "here: is wrong");
  EXPECT_EQ(message_of([] { require(false, "here", "is wrong"); }), "here: is wrong");
  EXPECT_EQ(message_of([] { require(true, "here", "is wrong"); }), "no error");
}

TEST(Counted, IsANumberWithItsNoun) {
  EXPECT_EQ(counted(0, "worker"), "0 workers");
  EXPECT_EQ(counted(1, "worker"), "1 worker");
  EXPECT_EQ(counted(std::size_t{12}, "worker"), "12 workers");
  EXPECT_EQ(counted(1u, "retry", "retries"), "1 retry");
  EXPECT_EQ(counted(0u, "retry", "retries"), "0 retries");
}

TEST(HeldThings, AreThereUntilTheyAreMovedAway) {
  Held<int> a(std::make_unique<int>(3));
  EXPECT_EQ(*a, 3);
  Held<int> b = std::move(a);
  EXPECT_EQ(*b, 3);
  EXPECT_EQ(message_of([&] { *a; }), "moved object: it was moved from and holds nothing");
  EXPECT_EQ(a.get(), nullptr);
  EXPECT_EQ(message_of([] { *Held<int>(); }), "moved object: it was moved from and holds nothing");
  a = Held<int>(std::make_unique<int>(4));
  EXPECT_EQ(*a.get(), 4);
}

/// Writes down what it is told.
struct Listener : Progress {
  void begin(const std::string& stage, std::uint64_t total, const std::string& unit) override {
    told += stage + " " + std::to_string(total) + " " + unit + ";";
  }
  void advance(std::uint64_t count) override { told += std::to_string(count) + ";"; }
  void end() override { told += "end;"; }
  std::string told;
};

TEST(Stages, TellHowFarTheyAre) {
  Listener listener;
  {
    ProgressStage stage({&listener, nullptr}, "bake", 7, "probes");
    stage.advance(3);
    EXPECT_EQ(listener.told, "bake 7 probes;3;");
  }
  EXPECT_EQ(listener.told, "bake 7 probes;3;end;");
  ProgressStage silent({}, "bake", 7, "probes");
  silent.advance(3);
}

TEST(Stages, StopWhenTheyAreAskedTo) {
  CancelToken token;
  const Control control{nullptr, &token};
  EXPECT_FALSE(control.cancelled());
  EXPECT_NO_THROW(control.check());
  token.request();
  EXPECT_TRUE(token.requested());
  EXPECT_TRUE(control.cancelled());
  EXPECT_THROW(control.check(), Cancelled);
}

// What is made earlier and read later tells more; nothing is said of how long anything takes.
TEST(Stopwatches, TellTheTimeSinceTheyWereMade) {
  const Stopwatch outer;
  const double inner = Stopwatch().seconds();
  const double milliseconds = outer.milliseconds(), seconds = outer.seconds();
  EXPECT_GE(inner, 0);
  EXPECT_GE(milliseconds, 1000 * inner);
  EXPECT_GE(1000 * seconds, milliseconds);
}

TEST(Vectors, HaveALuminanceALargestComponentAndAreFinite) {
  EXPECT_FLOAT_EQ(luminance(vec3(1, 0, 0)), 0.2126f);
  EXPECT_FLOAT_EQ(luminance(vec3(0, 1, 0)), 0.7152f);
  EXPECT_FLOAT_EQ(luminance(vec3(0, 0, 1)), 0.0722f);
  for (int c = 0; c < 3; ++c) {
    vec3 v(-1, -2, -3);
    v[c] = 5;
    EXPECT_EQ(max_component(v), 5);
    EXPECT_TRUE(is_finite(v));
    for (const float bad :
         {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
      v[c] = bad;
      EXPECT_FALSE(is_finite(v)) << c;
    }
  }
  EXPECT_FLOAT_EQ(pi, std::acos(-1.0f));
  EXPECT_DOUBLE_EQ(pi_d, std::acos(-1.0));
}

TEST(Logs, AreAtInfoUntilSomebodySaysOtherwiseAndGiveBackTheirSink) {
  std::vector<std::string> first, second;
  const LogSink old = set_log_sink([&](LogLevel, const std::string& line) { first.push_back(line); });
  log_info("{}", 1);
  const LogSink before = set_log_sink([&](LogLevel, const std::string& line) { second.push_back(line); });
  log_info("{}", 2);
  ASSERT_TRUE(before);
  before(LogLevel::info, "3");
  set_log_sink(old);
  EXPECT_EQ(first, (std::vector<std::string>{"1", "3"}));
  EXPECT_EQ(second, (std::vector<std::string>{"2"}));
}

TEST(ByteMessages, SayWhatAndWhere) {
  ByteWriter writer;
  writer.value<std::uint16_t>(7);
  const auto reader = [&] { return ByteReader(writer.bytes(), "file"); };
  EXPECT_EQ(message_of([&] { reader().value<std::uint32_t>("number"); }),
            "file at byte 0: number is cut off");
  EXPECT_EQ(message_of([&] { reader().value_in<std::uint16_t>("number", 8, 9); }),
            "file at byte 2: number is out of range");
  EXPECT_EQ(message_of([&] {
              ByteReader in = reader();
              in.value<std::uint8_t>("number");
              in.expect_end();
            }),
            "file at byte 1: end has 1 bytes too many");
  ByteWriter text;
  text.text("four");
  EXPECT_EQ(message_of([&] { ByteReader(text.bytes(), "file").text("name", 3); }),
            "file at byte 4: name is too long");
  EXPECT_EQ(message_of([&] { ByteReader(text.bytes(), "file").count("things", 3, 1); }),
            "file at byte 4: things is over the limit of 3");
  EXPECT_EQ(message_of([&] { ByteReader(text.bytes(), "file").count("things", 4, 2); }),
            "file at byte 4: things needs more bytes than the file has");
}

}  // namespace
}  // namespace ssphh
