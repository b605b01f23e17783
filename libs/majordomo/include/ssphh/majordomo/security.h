#pragma once
/// CURVE keys, the allow-list with roles, and which endpoints may be plain.
///
/// Plain connections are for loopback and ipc only; everywhere else both ends need keys, and the broker lets
/// in only the public keys that its allow-list names. Keys are Z85 text of 40 characters (ZeroMQ RFC 32).

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ssphh::majordomo {

struct KeyPair {
  std::string public_key, secret_key;
};

/// A new CURVE pair from the system's random source.
KeyPair make_key_pair();

/// Writes DIR/NAME.key (both keys, readable by the owner only) and DIR/NAME.pub (the public key alone).
/// Throws Error when a file exists already, the name is not [A-Za-z0-9._-]+, the keys are none or the folder
/// cannot be made.
void write_key_pair(const std::filesystem::path& dir, const std::string& name, const KeyPair& keys);
/// Throws Error when the file is missing, malformed, or readable by others than its owner.
KeyPair read_key_pair(const std::filesystem::path& path);
std::string read_public_key(const std::filesystem::path& path);

/// What a peer may do at the broker.
struct Rights {
  std::string name = {};  ///< of the key; empty for plain connections
  bool client = true;     ///< may send requests
  bool admin = true;      ///< may drain and cancel what is not its own
  std::vector<std::string> services = {
      "*"};  ///< that it may serve as a worker; a final * stands for any rest

  bool may_serve(std::string_view service) const;
  friend bool operator==(const Rights&, const Rights&) = default;
};

struct AllowedKey {
  std::string public_key = {};
  Rights rights = {};
};

/// One key per line: `NAME PUBLIC-KEY ROLE...`, where a role is `client`, `admin`, `worker` (any service) or
/// `worker:SERVICE` (a final * stands for any rest); a word with # at its start begins a comment.
using AllowList = std::vector<AllowedKey>;
/// Throws Error naming the line.
AllowList read_allow_list(const std::filesystem::path& path);
/// Adds a line and replaces the file whole. Throws Error when the name stands there already or a
/// role is none.
void add_to_allow_list(const std::filesystem::path& path, const std::string& name,
                       const std::string& public_key, const std::vector<std::string>& roles);

/// What a client or worker needs to speak CURVE.
struct PeerSecurity {
  std::string broker_key = {};  ///< the broker's public key
  KeyPair keys = {};            ///< its own
};
/// Throws Error when one of the keys is none; `where` names whose they are.
void require_keys_of(const std::string& where, const PeerSecurity& security);
/// DIR/broker.pub and DIR/NAME.key.
PeerSecurity read_peer_security(const std::filesystem::path& dir, const std::string& name);

struct BrokerSecurity {
  KeyPair keys = {};
  AllowList allowed = {};
  std::filesystem::path allow_file = {};  ///< where `allowed` came from and is read again; empty: never
};
/// DIR/broker.key and DIR/allow.txt.
BrokerSecurity read_broker_security(const std::filesystem::path& dir);

/// Whether no other machine can reach the endpoint: ipc, inproc, or tcp on 127.0.0.0/8, ::1 or "localhost".
bool is_local_endpoint(std::string_view endpoint);
/// Throws Error when the endpoint is of tcp and its port a number over 65535, of which ZeroMQ keeps the lower
/// 16 bits; `option` names what the user typed.
void require_port(std::string_view endpoint, const std::string& option);
/// Throws Error when the endpoint is none, has no such port, or is not local and there are no keys; `option`
/// names what the user typed.
void require_keys(std::string_view endpoint, bool have_keys, const std::string& option);

}  // namespace ssphh::majordomo
