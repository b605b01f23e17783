#include <gtest/gtest.h>

#include <ssphh/majordomo/envelope.h>

namespace ssphh::majordomo {
namespace {

using std::string_literals::operator""s;

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

TEST(Envelope, KindsAreThoseThatThereAre) {
  Frame frame = encode_envelope({});
  for (int kind = 0; kind < 256; ++kind) {
    frame[5] = static_cast<char>(kind);
    const bool known =
        (kind >= 1 && kind <= 4) || (kind >= 16 && kind <= 20) || kind == 32 || kind == 48 || kind == 49;
    EXPECT_EQ(decode_envelope(frame).has_value(), known) << kind;
  }
}

// As docs/protocol.md has it: other programs speak it, too.
TEST(Envelope, LiesInItsFrameByteByByte) {
  const std::string id = "\1\0\0\0\0\0\0\0\2\0\0\0\0\0\0\0"s;
  const auto bytes = [](const Envelope& envelope) { return encode_envelope(envelope); };
  EXPECT_EQ(bytes({}), "SSPJ\1\1"s);
  EXPECT_EQ(bytes({.kind = EnvelopeKind::leave, .ids = {{1, 2}}}), "SSPJ\1\x31\1\x10\0"s + id);
  EXPECT_EQ(bytes({.deadline = 0x0102}), "SSPJ\1\1\2\x08\0\2\1\0\0\0\0\0\0"s);
  EXPECT_EQ(bytes({.attempt_timeout = 3}), "SSPJ\1\1\3\x08\0\3\0\0\0\0\0\0\0"s);
  EXPECT_EQ(bytes({.content_key = Hash128{1, 2}}), "SSPJ\1\1\4\x10\0"s + id);
  EXPECT_EQ(bytes({.persistent = true}), "SSPJ\1\1\5\1\0\1"s);
  EXPECT_EQ(bytes({.retry = true}), "SSPJ\1\1\5\1\0\2"s);
  EXPECT_EQ(bytes({.outcome = Outcome::parked}), "SSPJ\1\1\6\1\0\2"s);
  EXPECT_EQ(bytes({.reason = "ab"}), "SSPJ\1\1\7\2\0ab"s);
  EXPECT_EQ(bytes({.attempts = 7}), "SSPJ\1\1\x08\4\0\7\0\0\0"s);
  EXPECT_EQ(bytes({.sequence = 8}), "SSPJ\1\1\x09\4\0\x08\0\0\0"s);
  EXPECT_EQ(bytes({.retry_after = 9}), "SSPJ\1\1\x0a\x08\0\x09\0\0\0\0\0\0\0"s);
  const Token token{1, 2, 3, 4, 5};
  EXPECT_EQ(token.frame(), "SSJ\5\4\0\0\0\3\0\0\0\0\0\0\0"s + id);
  EXPECT_EQ(bytes({.token = token}), "SSPJ\1\1\x0b\x20\0"s + token.frame());
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
