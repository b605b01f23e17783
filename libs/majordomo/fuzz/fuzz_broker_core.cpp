/// The broker's state machine under arbitrary events from eight peers: it must neither crash nor keep bytes
/// of requests when all peers have gone and all time has passed. Each event is a few bytes: what happens, to
/// whom, and for messages the frames, with shorthands for what random bytes would never hit (headers, tokens,
/// envelopes).

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <ssphh/majordomo/broker_core.h>
#include <ssphh/majordomo/envelope.h>

namespace {

using namespace ssphh::majordomo;

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return size_ == 0; }
  std::uint8_t byte() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  std::string bytes(std::size_t count) {
    std::string text;
    while (count-- > 0 && size_ > 0) text += static_cast<char>(byte());
    return text;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

std::string frame(Input& in, const std::vector<std::string>& tokens) {
  switch (const std::uint8_t kind = in.byte() % 16) {
    case 0:
      return {};
    case 1:
      return "MDPC01";
    case 2:
      return "MDPW01";
    case 3:
      return "MDPC02";
    case 4:
      return "MDPW02";
    case 5:
    case 6:
      return std::string(1, static_cast<char>(in.byte() % 8));
    case 7:
      return "a";
    case 8:
      return std::array{"mmi.service", "mmi.stats", "mmi.drain", "titanic.request",
                        "titanic.close"}[in.byte() % 5];
    case 9:
    case 10:
      return tokens.empty() ? std::string() : tokens[in.byte() % tokens.size()];
    case 11:
    case 12: {
      constexpr EnvelopeKind kinds[] = {EnvelopeKind::submit, EnvelopeKind::cancel, EnvelopeKind::query,
                                        EnvelopeKind::ack, EnvelopeKind::result};
      Envelope envelope{.kind = kinds[in.byte() % 5], .ids = {{1, in.byte() % 8u}}};
      envelope.deadline = in.byte() * 50;
      envelope.persistent = in.byte() % 2 != 0;
      if (in.byte() % 2) envelope.content_key = ssphh::Hash128{1, in.byte() % 4u};
      envelope.outcome = static_cast<Outcome>(in.byte() % 4);
      envelope.retry = in.byte() % 2 != 0;
      if (!tokens.empty()) envelope.token = Token::parse(tokens[in.byte() % tokens.size()]);
      return encode_envelope(envelope);
    }
    default:
      return in.bytes(kind);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input in(data, size);
  BrokerLimits limits;
  limits.client_requests = 8;
  limits.record_bytes = 4000;
  std::uint64_t n = 0;
  BrokerCore core(
      limits, {},
      [&n] {
        return std::array<std::uint64_t, 2>{++n, ~n};
      },
      in.byte() % 2 != 0);
  std::vector<std::string> tokens;
  Millis now = 0;
  const auto name = [](std::uint8_t k) {
    return (k % 2 ? std::string(own_worker_prefix) : "") + std::to_string(k % 8);
  };
  const auto take = [&] {
    for (const Outgoing& message : core.take().messages)
      for (const Frame& f : message.head)
        if (Token::parse(f)) tokens.push_back(f);
  };
  while (!in.empty()) {
    const std::uint8_t what = in.byte();
    if (what < 200) {
      const std::string peer = name(in.byte());
      Frames frames;
      for (int count = what % 9; count > 0; --count) frames.push_back(frame(in, tokens));
      core.receive(now, peer, std::move(frames));
    } else if (what < 220) {
      core.peer_gone(now, name(in.byte()));
    } else {
      now += 1 + in.byte() * 100;
      core.tick(now);
    }
    take();
  }
  for (std::uint8_t k = 0; k < 8; ++k) core.peer_gone(now, name(k));
  for (int i = 0; i < 300; ++i) {
    now = std::max(now + 1, core.next_deadline());
    core.tick(now);
    core.take();
  }
  const BrokerStats stats = core.stats();
  if (stats.workers != 0 || stats.running != 0) __builtin_trap();
  return 0;
}
