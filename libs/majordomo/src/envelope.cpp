#include <algorithm>
#include <bit>
#include <cstring>

#include <ssphh/majordomo/envelope.h>

namespace ssphh::majordomo {
namespace {

static_assert(std::endian::native == std::endian::little, "integers are copied as they lie in memory");

constexpr std::string_view magic = "SSPJ";
constexpr std::string_view token_magic = "SSJ";
constexpr std::size_t token_bytes = 32;
constexpr std::size_t reason_bytes = 4000;

enum Tag : std::uint8_t {
  tag_ids = 1,
  tag_deadline,
  tag_attempt_timeout,
  tag_content_key,
  tag_flags,
  tag_outcome,
  tag_reason,
  tag_attempts,
  tag_sequence,
  tag_retry_after,
  tag_token,
  tag_end
};
enum Flags : std::uint8_t { flag_persistent = 1, flag_retry = 2 };

template <class T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
bool read(std::string_view in, T& value) {
  if (in.size() != sizeof value) return false;
  std::memcpy(&value, in.data(), sizeof value);
  return true;
}

void field(std::string& out, Tag tag, std::string_view value) {
  append<std::uint8_t>(out, tag);
  append(out, static_cast<std::uint16_t>(value.size()));
  out += value;
}

template <class T>
void number(std::string& out, Tag tag, T value) {
  if (value != 0) field(out, tag, {reinterpret_cast<const char*>(&value), sizeof value});
}

bool read_millis(std::string_view in, Millis& value) {
  return read(in, value) && value >= 0 && value <= most_millis;
}

bool read_field(Envelope& e, std::uint8_t tag, std::string_view value) {
  std::uint8_t byte = 0;
  switch (tag) {
    case tag_ids: {
      if (value.size() % 16 != 0 || value.size() / 16 > envelope_ids) return false;
      e.ids.resize(value.size() / 16);
      if (!value.empty()) std::memcpy(static_cast<void*>(e.ids.data()), value.data(), value.size());
      return true;
    }
    case tag_deadline:
      return read_millis(value, e.deadline);
    case tag_attempt_timeout:
      return read_millis(value, e.attempt_timeout);
    case tag_content_key:
      return read(value, e.content_key.emplace());
    case tag_flags:
      if (!read(value, byte)) return false;
      e.persistent = byte & flag_persistent;
      e.retry = byte & flag_retry;
      return true;
    case tag_outcome:
      if (!read(value, byte) || byte > static_cast<std::uint8_t>(Outcome::no_answer)) return false;
      e.outcome = static_cast<Outcome>(byte);
      return true;
    case tag_reason:
      e.reason = value;
      return value.size() <= reason_bytes;
    case tag_attempts:
      return read(value, e.attempts);
    case tag_sequence:
      return read(value, e.sequence);
    case tag_retry_after:
      return read_millis(value, e.retry_after);
    case tag_token:
      e.token = Token::parse(value);
      return e.token.has_value();
    default:
      return true;  // of a later version
  }
}

bool is_kind(std::uint8_t kind) {
  return (kind >= 1 && kind <= 4) || (kind >= 16 && kind <= 20) || kind == 32 || kind == 48 || kind == 49;
}

}  // namespace

Frame Token::frame() const {
  Frame out(token_magic);
  append(out, attempt);
  append(out, timeout);
  append(out, job);
  append(out, high);
  append(out, low);
  return out;
}

std::optional<Token> Token::parse(std::string_view frame) {
  if (frame.size() != token_bytes || !frame.starts_with(token_magic)) return std::nullopt;
  Token token;
  read(frame.substr(3, 1), token.attempt);
  read(frame.substr(4, 4), token.timeout);
  read(frame.substr(8, 8), token.job);
  read(frame.substr(16, 8), token.high);
  read(frame.substr(24, 8), token.low);
  return token;
}

bool is_envelope(std::string_view frame) {
  return frame.starts_with(magic);
}

Frame encode_envelope(const Envelope& e) {
  Frame out(magic);
  append(out, static_cast<std::uint8_t>(envelope_version));
  append(out, static_cast<std::uint8_t>(e.kind));
  if (!e.ids.empty()) {
    const std::size_t count = std::min(e.ids.size(), envelope_ids);
    field(out, tag_ids, {reinterpret_cast<const char*>(e.ids.data()), count * sizeof(RequestId)});
  }
  number(out, tag_deadline, e.deadline);
  number(out, tag_attempt_timeout, e.attempt_timeout);
  if (e.content_key)
    field(out, tag_content_key, {reinterpret_cast<const char*>(&*e.content_key), sizeof(Hash128)});
  number(out, tag_flags,
         static_cast<std::uint8_t>((e.persistent ? flag_persistent : 0) | (e.retry ? flag_retry : 0)));
  number(out, tag_outcome, static_cast<std::uint8_t>(e.outcome));
  if (!e.reason.empty()) field(out, tag_reason, std::string_view(e.reason).substr(0, reason_bytes));
  number(out, tag_attempts, e.attempts);
  number(out, tag_sequence, e.sequence);
  number(out, tag_retry_after, e.retry_after);
  if (e.token) field(out, tag_token, e.token->frame());
  return out;
}

std::optional<Envelope> decode_envelope(std::string_view frame) {
  if (!is_envelope(frame) || frame.size() < 6) return std::nullopt;
  if (frame[4] != envelope_version || !is_kind(static_cast<std::uint8_t>(frame[5]))) return std::nullopt;
  Envelope envelope;
  envelope.kind = static_cast<EnvelopeKind>(frame[5]);
  std::uint32_t seen = 0;
  for (std::string_view rest = frame.substr(6); !rest.empty();) {
    std::uint16_t size = 0;
    const auto tag = static_cast<std::uint8_t>(rest[0]);
    if (!read(rest.substr(1, 2), size) || rest.size() < 3u + size) return std::nullopt;
    if (tag < tag_end) {
      if (seen & (1u << tag)) return std::nullopt;
      seen |= 1u << tag;
    }
    if (!read_field(envelope, tag, rest.substr(3, size))) return std::nullopt;
    rest.remove_prefix(3u + size);
  }
  return envelope;
}

}  // namespace ssphh::majordomo
