#pragma once
/// The commands of 7/MDP 0.1 and 18/MDP 0.2 and their frames, as a ROUTER sees them after its identity frame.
///
/// The same byte is another command in the other version (0x04: HEARTBEAT in 0.1, FINAL in 0.2), so the
/// header decides first.

#include <optional>
#include <string>
#include <string_view>

#include <ssphh/majordomo/frames.h>
#include <ssphh/majordomo/limits.h>

namespace ssphh::majordomo {

enum class Version : std::uint8_t { v01, v02 };
enum class Side : std::uint8_t { client, worker };
/// `reply` is 0.1's REPLY and 0.2's FINAL; `partial` exists in 0.2 only. A client's messages are `request`
/// toward the broker, `partial` and `reply` toward the client.
enum class Command : std::uint8_t { ready, request, partial, reply, heartbeat, disconnect };

struct Message {
  Version version = Version::v02;
  Side side = Side::client;
  Command command = Command::request;
  std::string name =
      {};  ///< service (client's messages, READY) or client address (worker's REQUEST and replies)
  Frames body = {};
};

/// A message, or what is wrong with it.
struct Decoded {
  std::optional<Message> message;
  const char* problem = nullptr;  ///< a few words for logs and counters; null when there is a message
};

enum class Direction { to_broker, to_peer };

/// Takes the frames apart. Never throws, whatever the bytes. HEARTBEAT may carry a body (our envelope); its
/// meaning is the caller's affair.
Decoded decode(Frames&& frames, Direction direction, const BrokerLimits& limits = {});

/// All frames before the body: `name` is the service or the client address, where the command has one.
Frames encode_head(Version version, Side side, Command command, std::string_view name = {});
/// Head and body.
Frames encode(const Message& message);

/// 1 to `limit` printable ASCII characters.
bool is_service_name(std::string_view name, std::size_t limit = BrokerLimits{}.service_name_bytes);

}  // namespace ssphh::majordomo
