#pragma once
/// What the published protocol has no words for, between our own peers: request ids, deadlines, cancellation,
/// outcomes. An envelope is one frame at the front of a body; foreign peers never get one.
///
/// Layout: "SSPJ", version (1 byte), kind (1 byte), then fields of tag (1 byte), length (2 bytes,
/// little-endian) and value, each at most once; integers are little-endian. Unknown tags are skipped.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <ssphh/core/hash.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/frames.h>

namespace ssphh::majordomo {

inline constexpr int envelope_version = 1;
/// Service of the envelopes that belong to no service: cancel, query, ack.
inline constexpr std::string_view control_service = "mmi.request";
/// Beginning of the ZeroMQ identity of workers that understand envelopes; a name, '#' and random digits
/// follow.
inline constexpr std::string_view own_worker_prefix = "ssphh1:";

/// Proof that a worker was given a job: the client-address frame of its REQUEST, echoed in its replies.
struct Token {
  std::uint64_t high = 0, low = 0;  ///< random
  std::uint64_t job = 0;
  std::uint32_t timeout = 0;  ///< of the attempt, milliseconds; 0xffffffff: that long or longer
  std::uint8_t attempt = 0;
  friend bool operator==(const Token&, const Token&) = default;

  /// 32 bytes: "SSJ1"... see docs/protocol.md.
  Frame frame() const;
  static std::optional<Token> parse(std::string_view frame);
};

enum class EnvelopeKind : std::uint8_t {
  submit = 1,       ///< client: ids[0], deadline, attempt_timeout, content_key, persistent; then the body
  cancel = 2,       ///< client: ids
  query = 3,        ///< client: ids; answered by `unknown` when there are any
  ack = 4,          ///< client: ids whose FINAL has arrived; the broker forgets their replies
  accepted = 16,    ///< broker: ids[0] is stored on disk
  partial = 17,     ///< broker: ids[0], sequence; then the body
  final = 18,       ///< broker: ids[0], outcome, reason, attempts; then the body
  busy = 19,        ///< broker: ids[0] was not taken; submit it again after retry_after
  unknown = 20,     ///< broker: ids that it does not have; submit them again
  result = 32,      ///< worker: outcome, reason, token; then the body
  cancel_job = 48,  ///< broker to worker, in a HEARTBEAT: token
  leave = 49,       ///< broker to worker, in a HEARTBEAT: finish, disconnect and end
};

struct Envelope {
  EnvelopeKind kind = EnvelopeKind::submit;
  std::vector<RequestId> ids = {};
  Millis deadline = 0;         ///< from arrival; 0: none
  Millis attempt_timeout = 0;  ///< 0: the broker's default
  std::optional<Hash128> content_key = {};
  bool persistent = false;
  Outcome outcome = Outcome::ok;
  bool retry = false;  ///< in a result: another worker may be able to
  std::string reason = {};
  std::uint32_t attempts = 0;
  std::uint32_t sequence = 0;  ///< of a partial, from 0
  Millis retry_after = 0;
  std::optional<Token> token = {};
  friend bool operator==(const Envelope&, const Envelope&) = default;
};

/// At most this many ids in one envelope.
inline constexpr std::size_t envelope_ids = 4000;

/// Reasons longer than 4000 bytes are cut.
Frame encode_envelope(const Envelope& envelope);
/// None when the frame is no envelope of this version or malformed.
std::optional<Envelope> decode_envelope(std::string_view frame);
/// Whether the frame claims to be an envelope.
bool is_envelope(std::string_view frame);

}  // namespace ssphh::majordomo
