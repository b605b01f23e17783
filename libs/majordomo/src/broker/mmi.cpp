#include <algorithm>

#include <ssphh/core/json.h>

#include "state.h"

namespace ssphh::majordomo {
namespace {

std::string text(const json::Value& json) {
  return json::print(json);
}

}  // namespace

bool BrokerCore::Impl::is_internal(std::string_view service) const {
  return service.starts_with("mmi.") || (has_store && service.starts_with("titanic."));
}

void BrokerCore::Impl::internal(const std::string& id, Peer& peer, const Message& message,
                                const Envelope* envelope, const Rights& rights) {
  ++sums.requests;
  Frames body(message.body.begin() + (envelope ? 1 : 0), message.body.end());
  if (body.empty()) body.emplace_back();
  Frames reply = message.name.starts_with("mmi.") ? mmi(message, body, rights)
                                                  : titanic(message, body, owner_of(id, peer));
  ++sums.finished;
  answer(id, message, envelope, std::move(reply));
}

Frames BrokerCore::Impl::mmi(const Message& message, const Frames& body, const Rights& rights) {
  if (message.name == "mmi.service") {
    const auto found = services.find(body[0]);
    return {found != services.end() && found->second.workers > 0 ? "200" : "404"};
  }
  if (message.name == "mmi.workers") {
    json::Array list;
    for (const auto& [id, peer] : peers) {
      if (!peer.worker) continue;
      const WorkerState& worker = *peer.worker;
      json::Value entry = {{"name", worker.name},
                           {"service", worker.service->name},
                           {"version", worker.version == Version::v01 ? "0.1" : "0.2"},
                           {"state", worker.suspect   ? "suspect"
                                     : worker.busy    ? "busy"
                                     : worker.leaving ? "leaving"
                                                      : "idle"},
                           {"since_ms", now - worker.since},
                           {"heard_ms", now - peer.heard},
                           {"served", worker.served}};
      if (worker.busy) entry["job"] = worker.token.job;
      if (!peer.user.empty()) entry["key"] = peer.user;
      list.push_back(std::move(entry));
    }
    std::ranges::sort(list, [](const json::Value& a, const json::Value& b) {
      return a["name"].string() < b["name"].string();
    });
    return {"200", text({{"format", "ssphh-broker-workers"}, {"version", 1}, {"workers", std::move(list)}})};
  }
  if (message.name == "mmi.stats") {
    json::Array list;
    for (const auto& [name, service] : services) {
      list.push_back({{"name", name},
                      {"workers", service.workers},
                      {"idle", service.idle.size()},
                      {"queued", service.queued},
                      {"clients", service.lanes.size()},
                      {"requests", service.requests},
                      {"finished", service.finished}});
    }
    std::ranges::sort(list, [](const json::Value& a, const json::Value& b) {
      return a["name"].string() < b["name"].string();
    });
    const BrokerStats s = stats();
    return {"200", text({{"format", "ssphh-broker-stats"},
                         {"version", 1},
                         {"uptime_ms", now - started},
                         {"draining", draining},
                         {"total",
                          {{"received", s.received},
                           {"sent", s.sent},
                           {"dropped", s.dropped},
                           {"requests", s.requests},
                           {"finished", s.finished},
                           {"failed", s.failed},
                           {"parked", s.parked},
                           {"expired", s.expired},
                           {"cancelled", s.cancelled},
                           {"busy", s.busy},
                           {"attempts", s.attempts},
                           {"retries", s.retries},
                           {"hedged", s.hedged},
                           {"coalesced", s.coalesced},
                           {"repeated", s.repeated},
                           {"late_replies", s.late_replies},
                           {"workers_lost", s.workers_lost}}},
                         {"now",
                          {{"peers", s.peers},
                           {"workers", s.workers},
                           {"idle", s.idle},
                           {"outstanding", s.outstanding},
                           {"queued", s.queued},
                           {"running", s.running},
                           {"bytes", s.bytes},
                           {"records", s.records}}},
                         {"dropped", dropped},
                         {"services", std::move(list)}})};
  }
  if (message.name == "mmi.parked") {
    json::Value list = json::Value::array();
    for (const Parked& job : parked)
      list.push_back({{"job", job.job},
                      {"service", job.service},
                      {"failures", job.failures},
                      {"since_ms", now - job.since},
                      {"bytes", byte_count(*job.body)}});
    return {"200", text({{"format", "ssphh-broker-parked"}, {"version", 1}, {"jobs", std::move(list)}})};
  }
  if (message.name == "mmi.release" || message.name == "mmi.drop") {
    if (!rights.admin) return {"403"};
    return unpark(body[0], message.name == "mmi.release");
  }
  if (message.name == "mmi.drain") {
    if (!rights.admin) return {"403"};
    std::size_t told = 0;
    for (auto& [id, peer] : peers) {
      WorkerState* worker = peer.worker.get();
      if (!worker || !worker->own || worker->leaving || !worker->name.starts_with(body[0])) continue;
      worker->leaving = true;
      if (worker->idle) worker->service->idle.erase(*worker->idle), worker->idle.reset();
      to_worker(id, *worker, Command::heartbeat, {},
                std::make_shared<const Frames>(Frames{encode_envelope({.kind = EnvelopeKind::leave})}));
      ++told;
    }
    return {"200", std::to_string(told)};
  }
  return {"501"};
}

BrokerStats BrokerCore::Impl::stats() const {
  BrokerStats s = sums;
  s.peers = peers.size();
  s.workers = worker_count;
  for (const auto& [name, service] : services) s.idle += service.idle.size();
  s.outstanding = requests.size();
  s.queued = queued_count;
  s.running = running_count;
  s.bytes = queued_bytes;
  s.services = services.size();
  s.records = records.size();
  return s;
}

}  // namespace ssphh::majordomo
