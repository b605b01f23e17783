#include <array>
#include <utility>

#include <ssphh/core/require.h>
#include <ssphh/majordomo/mdp.h>

namespace ssphh::majordomo {
namespace {

constexpr std::string_view headers[2][2] = {{"MDPC01", "MDPW01"}, {"MDPC02", "MDPW02"}};  // [version][side]

// 0 is no command byte in any version; the client's side of 0.1 has none at all.
constexpr char no_code = 0;
constexpr std::array commands = {Command::ready, Command::request,   Command::partial,
                                 Command::reply, Command::heartbeat, Command::disconnect};
constexpr char codes[2][2][commands.size()] = {{{}, {1, 2, no_code, 3, 4, 5}},  // [version][side][command]
                                               {{no_code, 1, 2, 3, no_code, no_code}, {1, 2, 3, 4, 5, 6}}};

char code_of(Version version, Side side, Command command) {
  return codes[static_cast<int>(version)][static_cast<int>(side)][static_cast<int>(command)];
}

std::optional<Command> command_of(Version version, Side side, const Frame& frame) {
  if (frame.size() != 1 || frame[0] == no_code) return std::nullopt;
  for (const Command command : commands)
    if (code_of(version, side, command) == frame[0]) return command;
  return std::nullopt;
}

bool may_send(Side side, Command command, Direction direction) {
  if (side == Side::client) return (command == Command::request) == (direction == Direction::to_broker);
  if (command == Command::heartbeat || command == Command::disconnect) return true;
  return (command == Command::request) == (direction == Direction::to_peer);
}

void move_body(Frames& frames, std::size_t from, Frames& body) {
  body.assign(std::make_move_iterator(frames.begin() + static_cast<std::ptrdiff_t>(from)),
              std::make_move_iterator(frames.end()));
}

}  // namespace

bool is_service_name(std::string_view name, std::size_t limit) {
  if (name.empty() || name.size() > limit) return false;
  for (const char c : name)
    if (c < ' ' || c > '~') return false;
  return true;
}

Decoded decode(Frames&& frames, Direction direction, const BrokerLimits& limits) {
  const auto bad = [](const char* problem) { return Decoded{std::nullopt, problem}; };
  if (frames.size() > limits.message_frames) return bad("too many frames");
  std::size_t bytes = 0;
  for (const Frame& frame : frames) {
    if (frame.size() > limits.frame_bytes) return bad("frame too large");
    bytes += frame.size();
  }
  if (bytes > limits.message_bytes) return bad("message too large");
  if (frames.empty()) return bad("no frames");

  Message message;
  message.version = frames[0].empty() ? Version::v01 : Version::v02;
  std::size_t at = message.version == Version::v01 ? 1 : 0;
  if (at >= frames.size()) return bad("no header");
  const auto& known = headers[static_cast<int>(message.version)];
  if (frames[at] == known[0]) {
    message.side = Side::client;
  } else if (frames[at] == known[1]) {
    message.side = Side::worker;
  } else {
    return bad("unknown header");
  }
  ++at;

  if (message.side == Side::client && message.version == Version::v01) {
    message.command = direction == Direction::to_broker ? Command::request : Command::reply;
  } else {
    if (at >= frames.size()) return bad("no command");
    const auto command = command_of(message.version, message.side, frames[at++]);
    if (!command) return bad("unknown command");
    message.command = *command;
  }
  if (!may_send(message.side, message.command, direction)) return bad("command of the other side");

  switch (message.command) {
    case Command::heartbeat:
      break;
    case Command::disconnect:
      if (at != frames.size()) return bad("frames after the command");
      break;
    case Command::ready:
      if (at + 1 != frames.size()) return bad("READY without exactly one service");
      message.name = std::move(frames[at++]);
      if (!is_service_name(message.name, limits.service_name_bytes)) return bad("bad service name");
      break;
    default:
      if (at >= frames.size()) return bad("no service or address");
      message.name = std::move(frames[at++]);
      if (message.side == Side::worker) {
        if (at >= frames.size() || !frames[at].empty()) return bad("no empty frame after the address");
        ++at;
      } else if (!is_service_name(message.name, limits.service_name_bytes)) {
        return bad("bad service name");
      }
      if (at >= frames.size()) return bad("no body");
  }
  move_body(frames, at, message.body);
  return {std::move(message), nullptr};
}

Frames encode_head(Version version, Side side, Command command, std::string_view name) {
  require(version <= Version::v02, "message", "there is no version of that number");
  require(side <= Side::worker, "message", "there is no side of that number");
  require(command <= Command::disconnect, "message", "there is no command of that number");
  Frames frames;
  frames.reserve(5);
  if (version == Version::v01) frames.emplace_back();
  frames.emplace_back(headers[static_cast<int>(version)][static_cast<int>(side)]);
  if (const char code = code_of(version, side, command); code != no_code) frames.emplace_back(1, code);
  if (command == Command::heartbeat || command == Command::disconnect) return frames;
  frames.emplace_back(name);
  if (side == Side::worker && command != Command::ready) frames.emplace_back();
  return frames;
}

Frames encode(const Message& message) {
  Frames frames = encode_head(message.version, message.side, message.command, message.name);
  frames.insert(frames.end(), message.body.begin(), message.body.end());
  return frames;
}

}  // namespace ssphh::majordomo
