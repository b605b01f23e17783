#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include <sys/stat.h>
#include <zmq.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/majordomo/security.h>

namespace ssphh::majordomo {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t key_characters = 40;
constexpr std::uint64_t key_file_bytes = 4096;
constexpr std::uint64_t allow_list_bytes = 16 << 20;

bool is_name(std::string_view name) {
  return !name.empty() && name.size() <= 100 && std::ranges::all_of(name, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  });
}

bool is_key(const std::string& text) {
  std::uint8_t raw[32];
  return text.size() == key_characters && zmq_z85_decode(raw, text.c_str()) != nullptr;
}

void require_key(const std::string& where, const std::string& text) {
  if (!is_key(text))
    throw Error(where, "is given a key that is no CURVE key", "make one with `ssphh farm keygen`");
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

AllowedKey parse_line(const std::vector<std::string>& fields, const std::string& where) {
  if (fields.size() < 3 || !is_name(fields[0]) || !is_key(fields[1]))
    throw Error(where, "is not NAME PUBLIC-KEY ROLE...", "the key is the text in NAME.pub");
  AllowedKey entry{fields[1], {.name = fields[0], .client = false, .admin = false, .services = {}}};
  for (std::size_t i = 2; i < fields.size(); ++i) {
    const std::string& role = fields[i];
    if (role == "client") {
      entry.rights.client = true;
    } else if (role == "admin") {
      entry.rights.admin = true;
    } else if (role == "worker") {
      entry.rights.services.emplace_back("*");
    } else if (role.starts_with("worker:") && role.size() > 7 && words(role) == std::vector{role}) {
      entry.rights.services.push_back(role.substr(7));
    } else {
      throw Error(where, "unknown role '" + role + "'", "use client, admin, worker or worker:SERVICE");
    }
  }
  return entry;
}

}  // namespace

KeyPair make_key_pair() {
  char public_key[key_characters + 1], secret_key[key_characters + 1];
  if (zmq_curve_keypair(public_key, secret_key) != 0)
    throw Error("CURVE", "this libzmq has none", "install libzmq with libsodium");
  return {public_key, secret_key};
}

void write_key_pair(const fs::path& dir, const std::string& name, const KeyPair& keys) {
  if (!is_name(name)) throw Error(name, "is no name for a key", "use A-Z a-z 0-9 . _ -, at most 100");
  require_key(name, keys.public_key);
  require_key(name, keys.secret_key);
  const fs::path secret = dir / (name + ".key"), open = dir / (name + ".pub");
  for (const fs::path& path : {secret, open})
    if (fs::exists(path))
      throw Error(path.string(), "exists already", "choose another name or remove it first");
  std::error_code error;
  fs::create_directories(dir, error);
  if (error) throw Error(dir.string(), "cannot be made: " + error.message());
  write_file(secret, "public " + keys.public_key + "\nsecret " + keys.secret_key + "\n",
             0600);  // nobody else's, not even for a moment
  write_file(open, keys.public_key + "\n");
}

KeyPair read_key_pair(const fs::path& path) {
  const std::string text = read_text_file(path, key_file_bytes);
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0 && (info.st_mode & 077) != 0)
    throw Error(path.string(), "others can read the secret key", "chmod 600 it, or make a new one");
  const std::vector<std::string> all = words(text);
  if (all.size() != 4 || all[0] != "public" || all[2] != "secret" || !is_key(all[1]) || !is_key(all[3]))
    throw Error(path.string(), "is no key file", "make one with `ssphh farm keygen`");
  return {all[1], all[3]};
}

std::string read_public_key(const fs::path& path) {
  const std::vector<std::string> all = words(read_text_file(path, key_file_bytes));
  if (all.size() != 1 || !is_key(all[0]))
    throw Error(path.string(), "is no public key", "copy NAME.pub here");
  return all[0];
}

bool Rights::may_serve(std::string_view service) const {
  return std::ranges::any_of(services, [&](const std::string& pattern) {
    return pattern.ends_with('*')
               ? service.starts_with(std::string_view(pattern).substr(0, pattern.size() - 1))
               : service == pattern;
  });
}

AllowList read_allow_list(const fs::path& path) {
  std::istringstream lines(read_text_file(path, allow_list_bytes));
  AllowList list;
  std::set<std::string> seen;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::vector<std::string> fields = words(line);
    if (fields.empty() || fields[0].starts_with('#')) continue;
    // A key may hold a #, so a comment begins only where a role could.
    for (std::size_t i = 2; i < fields.size(); ++i)
      if (fields[i].starts_with('#')) fields.resize(i);
    const std::string where = path.string() + ":" + std::to_string(number);
    AllowedKey entry = parse_line(fields, where);
    if (!seen.insert(entry.public_key).second || !seen.insert("name " + entry.rights.name).second)
      throw Error(where, "this name or key stands here twice", "one line per key");
    list.push_back(std::move(entry));
  }
  return list;
}

void add_to_allow_list(const fs::path& path, const std::string& name, const std::string& public_key,
                       const std::vector<std::string>& roles) {
  std::string text = fs::exists(path) ? read_text_file(path, allow_list_bytes) : std::string();
  std::vector<std::string> fields = {name, public_key};
  fields.insert(fields.end(), roles.begin(), roles.end());
  const AllowedKey entry = parse_line(fields, path.string());
  for (const AllowedKey& other : fs::exists(path) ? read_allow_list(path) : AllowList{})
    if (other.public_key == entry.public_key || other.rights.name == name)
      throw Error(path.string(), name + " stands there already", "remove its line first");
  if (!text.empty() && !text.ends_with('\n')) text += '\n';
  for (const std::string& field : fields) text += field + (&field == &fields.back() ? "\n" : " ");
  write_file(path, text);
}

void require_keys_of(const std::string& where, const PeerSecurity& security) {
  require_key(where, security.broker_key);
  require_key(where, security.keys.public_key);
  require_key(where, security.keys.secret_key);
}

PeerSecurity read_peer_security(const fs::path& dir, const std::string& name) {
  return {read_public_key(dir / "broker.pub"), read_key_pair(dir / (name + ".key"))};
}

BrokerSecurity read_broker_security(const fs::path& dir) {
  const fs::path list = dir / "allow.txt";
  return {read_key_pair(dir / "broker.key"), read_allow_list(list), list};
}

bool is_local_endpoint(std::string_view endpoint) {
  if (endpoint.starts_with("ipc://") || endpoint.starts_with("inproc://")) return true;
  if (!endpoint.starts_with("tcp://")) return false;
  std::string_view host = endpoint.substr(6);
  if (const auto source = host.find(';'); source != host.npos) host.remove_prefix(source + 1);
  host = host.substr(0, host.rfind(':'));
  if (host == "localhost" || host == "[::1]" || host == "::1") return true;
  if (!host.starts_with("127.")) return false;
  return std::ranges::all_of(host, [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
}

void require_port(std::string_view endpoint, const std::string& option) {
  const std::string_view port = endpoint.substr(endpoint.rfind(':') + 1);
  if (!endpoint.starts_with("tcp://") || port.find_first_not_of("0123456789") != std::string_view::npos)
    return;
  unsigned number = 0;
  const bool fits =
      std::from_chars(port.data(), port.data() + port.size(), number).ec != std::errc::result_out_of_range;
  if (!fits || number > 65535) {
    throw Error(option + " " + std::string(endpoint), "has the port " + std::string(port),
                "ports are 0 to 65535");
  }
}

void require_keys(std::string_view endpoint, bool have_keys, const std::string& option) {
  const bool known =
      endpoint.starts_with("tcp://") || endpoint.starts_with("ipc://") || endpoint.starts_with("inproc://");
  if (!known)
    throw Error(option + " " + std::string(endpoint), "is no endpoint",
                "write tcp://HOST:PORT or ipc://PATH");
  require_port(endpoint, option);
  if (!have_keys && !is_local_endpoint(endpoint)) {
    throw Error(option + " " + std::string(endpoint), "leaves this machine, and there are no keys",
                "make keys with `ssphh farm keygen` and give their folder with --keys");
  }
}

}  // namespace ssphh::majordomo
