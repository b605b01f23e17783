#include <algorithm>

#include "state.h"

namespace ssphh::majordomo {
namespace {

constexpr int logged_drops_per_second = 10;
constexpr Millis idle_client = 60'000;

}  // namespace

std::string peer_text(std::string_view id) {
  if (id.starts_with(own_worker_prefix)) {
    id.remove_prefix(own_worker_prefix.size());
    return std::string(id.substr(0, id.rfind('#')));
  }
  const bool printable = !id.empty() && std::ranges::all_of(id, [](char c) { return c > ' ' && c <= '~'; });
  if (printable) return std::string(id);
  std::string text;
  for (const char c : id) text += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return text;
}

std::string owner_of(const std::string& id, const Peer& peer) {
  return peer.user.empty() ? id : "user " + peer.user;
}

void BrokerCore::Impl::drop(const std::string& id, const char* reason) {
  ++sums.dropped;
  ++dropped[reason];
  // Hostile peers must not fill the log: the counters tell the rest.
  if (now / 1000 != drop_second) drop_second = now / 1000, drop_logged = 0;
  if (++drop_logged <= logged_drops_per_second)
    event(LogLevel::warning, "message-dropped", Field("peer", peer_text(id)), Field("reason", reason));
}

bool BrokerCore::Impl::over_rate(Peer& peer) {
  const double rate = limits.messages_per_second;
  if (rate <= 0) return false;
  peer.allowance = std::min(rate, peer.allowance + rate * static_cast<double>(now - peer.filled) / 1000);
  peer.filled = now;
  if (peer.allowance < 1) return true;
  peer.allowance -= 1;
  return false;
}

void BrokerCore::Impl::receive(const std::string& id, Frames&& frames, const Rights& rights) {
  ++sums.received;
  auto found = peers.find(id);
  if (found == peers.end()) {
    if (peers.size() >= limits.peers) return drop(id, "too many peers");
    found = peers.emplace(id, Peer{}).first;
    found->second.user = rights.name;
    found->second.allowance = limits.messages_per_second;
    found->second.filled = now;
  }
  Peer& peer = found->second;
  peer.heard = now;
  if (peer.gone) peer.gone = false, timers.cancel(peer.grace);
  if (over_rate(peer)) return drop(id, "too many messages per second");
  if (peer.invalid) return drop(id, "peer is invalid");

  Decoded decoded = decode(std::move(frames), Direction::to_broker, limits);
  if (!decoded.message) {
    drop(id, decoded.problem);
    peer.invalid = true;
    event(LogLevel::warning, "peer-invalid", Field("peer", peer_text(id)), Field("reason", decoded.problem));
    if (peer.worker) lose_worker(id, peer, decoded.problem, false);
    client_vanished(id);
    return;
  }
  if (decoded.message->side == Side::client) {
    from_client(id, peer, std::move(*decoded.message), rights);
  } else {
    from_worker(id, peer, std::move(*decoded.message), rights);
  }
}

void BrokerCore::Impl::from_worker(const std::string& id, Peer& peer, Message&& message,
                                   const Rights& rights) {
  WorkerState* worker = peer.worker.get();
  if (worker && worker->version != message.version) {
    drop(id, "other protocol version than in READY");
    return lose_worker(id, peer, "mixed versions", false), disconnect(id, peer, message.version);
  }
  if (worker && worker->suspect) {
    worker->suspect = false;
    event(LogLevel::info, "worker-heard-again", Field("worker", worker->name));
  }
  switch (message.command) {
    case Command::ready:
      return register_worker(id, peer, message, rights);
    case Command::heartbeat:
      if (!worker) disconnect(id, peer, message.version);
      return;
    case Command::disconnect:
      if (worker) lose_worker(id, peer, "disconnected", true);
      return;
    case Command::partial:
    case Command::reply:
      return from_attempt(id, peer, std::move(message));
    case Command::request:
      return;  // decode() lets no worker send it
  }
}

void BrokerCore::Impl::peer_gone(const std::string& id) {
  const auto found = peers.find(id);
  if (found == peers.end()) return;
  Peer& peer = found->second;
  if (peer.worker) lose_worker(id, peer, "connection lost", false);
  peer.gone = true;
  peer.invalid = peer.told = false;  // the next connection of this name is another peer
  client_vanished(id);
}

void BrokerCore::Impl::revoke(const std::string& id) {
  const auto found = peers.find(id);
  if (found == peers.end()) return;
  event(LogLevel::warning, "peer-revoked", Field("peer", peer_text(id)), Field("key", found->second.user));
  if (found->second.worker) {
    const Version version = found->second.worker->version;
    lose_worker(id, found->second, "its key was withdrawn", false);
    disconnect(id, found->second, version);
  }
  peer_gone(id);
}

void BrokerCore::Impl::client_vanished(const std::string& id) {
  Peer& peer = peers.at(id);
  const std::vector<RequestId> all(peer.requests.begin(), peer.requests.end());
  for (const RequestId& request : all) {
    const Route route = requests.at(request).route;
    if (route == Route::mdp01 || route == Route::mdp02) detach(request);
  }
  if (!peer.gone) return;
  if (peer.requests.empty()) {
    timers.cancel(peer.grace);
    peers.erase(id);
    return;
  }
  timers.cancel(peer.grace);
  peer.grace = timers.set(now + times.client_grace, [this, id](Millis) {
    const std::unordered_set<RequestId> left = std::move(peers.at(id).requests);
    peers.erase(id);
    for (const RequestId& request : left) {
      Request& r = requests.at(request);
      r.peer.clear();
      if (!r.persistent) detach(request);
    }
  });
}

void BrokerCore::Impl::sweep() {
  const Millis period = std::clamp<Millis>(times.request_expiry / 4, 50, 60'000);
  timers.set(now + period, [this](Millis) { sweep(); });
  for (auto it = peers.begin(); it != peers.end();) {
    const Peer& peer = it->second;
    const bool idle = !peer.worker && peer.requests.empty() && !peer.gone && now - peer.heard > idle_client;
    it = idle ? peers.erase(it) : std::next(it);
  }
  std::vector<RequestId> expired;
  for (auto it = services.begin(); it != services.end();) {
    Service& service = it->second;
    if (service.workers > 0) service.used = now;
    for (const auto& [owner, lane] : service.workers == 0 ? service.lanes : decltype(service.lanes){}) {
      for (const JobNumber number : lane.jobs) {
        const QueuedJob& job = jobs.at(number);
        if (now - job.submitted < times.request_expiry) break;
        for (const RequestId& id : job.requests)
          if (const Route route = requests.at(id).route; route == Route::mdp01 || route == Route::mdp02)
            expired.push_back(id);
      }
    }
    const bool forgotten =
        service.workers == 0 && service.lanes.empty() && now - service.used > times.service_idle;
    if (forgotten) timers.cancel(service.straggle);
    it = forgotten ? services.erase(it) : std::next(it);
  }
  for (const RequestId& id : expired) {
    ++dropped["request expired without a worker"];
    end_request(id, Outcome::expired, "no worker for the service");
  }
}

}  // namespace ssphh::majordomo
