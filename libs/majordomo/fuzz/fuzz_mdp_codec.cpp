/// Both codecs on arbitrary frames: a message or a problem; what was decoded encodes to the same frames. The
/// input is a list of frames, each of one length byte and that many bytes.

#include <algorithm>
#include <cstdint>
#include <string>

#include <ssphh/majordomo/envelope.h>
#include <ssphh/majordomo/mdp.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ssphh::majordomo;
  Frames frames;
  for (std::size_t at = 0; at < size;) {
    const std::size_t length = std::min<std::size_t>(data[at], size - at - 1);
    frames.emplace_back(reinterpret_cast<const char*>(data + at + 1), length);
    at += 1 + length;
  }
  for (const Frame& frame : frames) {
    if (const auto envelope = decode_envelope(frame);
        envelope && decode_envelope(encode_envelope(*envelope)) != envelope)
      __builtin_trap();
    if (const auto token = Token::parse(frame); token && token->frame() != frame) __builtin_trap();
  }
  for (const Direction direction : {Direction::to_broker, Direction::to_peer}) {
    const Decoded decoded = decode(Frames(frames), direction);
    if (decoded.message.has_value() == (decoded.problem != nullptr)) __builtin_trap();
    if (decoded.message && encode(*decoded.message) != frames) __builtin_trap();
  }
  return 0;
}
