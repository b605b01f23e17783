#include <gtest/gtest.h>

#include <ssphh/majordomo/envelope.h>

namespace ssphh::majordomo {
namespace {

Envelope full() {
  return {.kind = EnvelopeKind::final,
          .ids = {{1, 2}, {3, 4}},
          .deadline = 5000,
          .attempt_timeout = 70000,
          .content_key = Hash128{8, 9},
          .persistent = true,
          .outcome = Outcome::parked,
          .retry = true,
          .reason = "w: crashed",
          .attempts = 3,
          .sequence = 17,
          .retry_after = 250,
          .token = Token{11, 12, 13, 14, 15}};
}

TEST(Envelope, RoundTrip) {
  EXPECT_EQ(decode_envelope(encode_envelope(full())), full());
  EXPECT_EQ(decode_envelope(encode_envelope({})), Envelope{});
}

TEST(Envelope, EveryTruncationIsRefusedOrShorter) {
  const Frame whole = encode_envelope(full());
  for (std::size_t size = 0; size < whole.size(); ++size)
    if (const auto cut = decode_envelope(whole.substr(0, size))) {
      EXPECT_NE(*cut, full()) << size;
    }
}

TEST(Envelope, UnknownTagsAreSkippedRepeatedOnesRefused) {
  const Frame plain = encode_envelope({.kind = EnvelopeKind::ack, .ids = {{1, 2}}});
  EXPECT_EQ(decode_envelope(plain + std::string("\xc8\x02\x00zz", 5))->ids.size(), 1u);
  EXPECT_FALSE(decode_envelope(plain + plain.substr(6)));
}

TEST(Envelope, HoldsFourThousandIdsAndBytesOfAReason) {
  const Envelope large{.kind = EnvelopeKind::cancel,
                       .ids = std::vector<RequestId>(4001, {1, 2}),
                       .reason = std::string(4001, 'r')};
  const auto cut = decode_envelope(encode_envelope(large));
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->ids.size(), 4000u);
  EXPECT_EQ(cut->reason.size(), 4000u);
}

TEST(Envelope, TimesAreFromZeroToNineThousandYears) {
  for (const auto& [time, good] :
       {std::pair(Millis{1} << 48, true), {(Millis{1} << 48) + 1, false}, {Millis{-1}, false}}) {
    EXPECT_EQ(decode_envelope(encode_envelope({.deadline = time})).has_value(), good) << time;
    EXPECT_EQ(decode_envelope(encode_envelope({.attempt_timeout = time})).has_value(), good) << time;
    EXPECT_EQ(decode_envelope(encode_envelope({.retry_after = time})).has_value(), good) << time;
  }
}

TEST(Envelope, OutcomesAreThoseThatThereAre) {
  EXPECT_TRUE(decode_envelope(encode_envelope({.outcome = Outcome::no_answer})));
  EXPECT_FALSE(decode_envelope(encode_envelope({.outcome = static_cast<Outcome>(7)})));
}

TEST(Envelope, OtherVersionsAndKindsAreRefused) {
  Frame frame = encode_envelope({});
  frame[4] = 2;
  EXPECT_FALSE(decode_envelope(frame));
  frame[4] = 1;
  frame[5] = 99;
  EXPECT_FALSE(decode_envelope(frame));
  EXPECT_FALSE(decode_envelope("SSPJ"));
}

TEST(Token, RoundTrip) {
  const Token token{1, 2, 3, 4, 5};
  EXPECT_EQ(token.frame().size(), 32u);
  EXPECT_EQ(Token::parse(token.frame()), token);
  EXPECT_FALSE(Token::parse(token.frame() + "x"));
  EXPECT_FALSE(Token::parse(std::string(32, 'x')));
}

TEST(RequestId, HexRoundTripAndRefusals) {
  const RequestId id = RequestId::random();
  EXPECT_EQ(RequestId::parse(id.hex()), id);
  EXPECT_EQ(RequestId::parse("0123456789ABCDEFabcdef0123456789")->hex(), "0123456789abcdefabcdef0123456789");
  for (const char* bad : {"", "../../../../../../../etc/passwd", "0123456789abcdef0123456789abcde",
                          "0123456789abcdef0123456789abcdefa", "0123456789abcdef0123456789abcdeg"})
    EXPECT_FALSE(RequestId::parse(bad)) << bad;
  EXPECT_NE(RequestId::random(), RequestId::random());
}

}  // namespace
}  // namespace ssphh::majordomo
