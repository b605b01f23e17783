#pragma once
/// A broker's books, counted anew from its jobs, requests, peers and records.

#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "broker/state.h"

namespace ssphh::majordomo {

/// Bytes that the statistics do not tell.
struct BrokerBooks {
  std::size_t stored = 0, records = 0, orphans = 0, parked = 0;
  friend bool operator==(const BrokerBooks&, const BrokerBooks&) = default;
  friend void PrintTo(const BrokerBooks& b, std::ostream* out) {
    *out << fmt::format("stored {}, records {}, orphans {}, parked {}", b.stored, b.records, b.orphans,
                        b.parked);
  }
};

class BrokerRecount {
 public:
  static BrokerBooks books(const BrokerCore& core) {
    const auto& s = *core.impl_;
    return {s.stored_bytes, s.record_bytes, s.orphan_bytes, s.parked_bytes};
  }

  /// What does not agree, one line each; empty when all does.
  static std::string disagreements(const BrokerCore& core) {
    BrokerRecount recount(*core.impl_);
    recount.jobs();
    recount.services();
    recount.requests();
    recount.workers();
    recount.kept();
    return recount.text_;
  }

 private:
  explicit BrokerRecount(const BrokerCore::Impl& s) : s_(s) {}

  template <class A, class B>
  void equal(const std::string& what, const A& kept, const B& counted) {
    if (!std::cmp_equal(kept, counted)) text_ += fmt::format("{}: {}, counted {}\n", what, kept, counted);
  }
  void demand(bool holds, const std::string& what) {
    if (!holds) text_ += what + "\n";
  }
  static bool queued(const QueuedJob& job) { return job.place == Place::lane || job.place == Place::choosy; }

  void jobs() {
    std::size_t bytes = 0, running = 0, waiting = 0, tokens = 0, keys = 0;
    std::map<std::string, Owner> owners;
    for (const auto& [number, job] : s_.jobs) {
      equal("bytes of a job", job.bytes, byte_count(*job.body));
      bytes += job.bytes;
      running += job.live() > 0;
      waiting += queued(job);
      tokens += job.attempts.size();
      keys += job.key.has_value();
      ++owners[job.owner].requests;
      owners[job.owner].bytes += job.bytes;
      demand(job.live() > 0 || job.place != Place::none, "a job neither runs nor waits");
      demand(job.live() > 0 || !job.requests.empty(), "a job that nobody wants waits");
    }
    equal("queued bytes", s_.queued_bytes, bytes);
    equal("running", s_.running_count, running);
    equal("queued", s_.queued_count, waiting);
    equal("tokens", s_.tokens.size(), tokens);
    equal("content keys", s_.keys.size(), keys);
    equal("owners", s_.owners.size(), owners.size());
    for (const auto& [name, owner] : owners) {
      equal("jobs of " + name, s_.owners.at(name).requests, owner.requests);
      equal("bytes of " + name, s_.owners.at(name).bytes, owner.bytes);
    }
  }

  void services() {
    for (const auto& [name, service] : s_.services) {
      std::map<std::string, std::size_t> outstanding, in_lane;
      std::size_t choosy = 0, run = 0;
      for (const auto& [number, job] : s_.jobs) {
        if (job.service != &service) continue;
        ++outstanding[job.owner];
        in_lane[job.owner] += job.place == Place::lane;
        choosy += job.place == Place::choosy;
        run += job.run.has_value();
        demand(!job.run || job.live() == 1, "one attempt is not the only one");
      }
      std::size_t lanes = 0, turns = 0;
      for (const auto& [owner, lane] : service.lanes) {
        equal("outstanding in a lane", lane.outstanding, outstanding[owner]);
        equal("jobs in a lane", lane.jobs.size(), in_lane[owner]);
        demand(lane.turn.has_value() == !lane.jobs.empty(), "a lane's turn");
        lanes += lane.jobs.size();
        turns += lane.turn.has_value();
      }
      equal("lanes", service.lanes.size(), outstanding.size());
      equal("turns", service.turns.size(), turns);
      equal("choosy jobs", service.choosy.size(), choosy);
      equal("jobs with one attempt", service.running.size(), run);
      equal("queued in a service", service.queued, lanes + choosy);
      std::map<std::string, std::size_t> names;
      std::size_t idle = 0;
      for (const auto& [id, peer] : s_.peers) {
        if (!peer.worker || peer.worker->service != &service) continue;
        ++names[peer.worker->name];
        idle += peer.worker->idle.has_value();
      }
      std::size_t workers = 0;
      for (const auto& [worker, count] : names) {
        workers += count;
        equal("workers of a name", service.names.contains(worker) ? service.names.at(worker) : 0, count);
      }
      equal("names of workers", service.names.size(), names.size());
      equal("workers of a service", service.workers, workers);
      equal("idle workers", service.idle.size(), idle);
      demand(s_.draining || idle == 0 || lanes == 0, "a job waits beside an idle worker");
    }
  }

  void requests() {
    std::size_t of_jobs = 0, of_peers = 0, waited_for = 0;
    for (const auto& [number, job] : s_.jobs)
      for (const RequestId& id : job.requests) {
        ++of_jobs;
        demand(s_.requests.contains(id) && s_.requests.at(id).job == number, "a job's request is another's");
      }
    for (const auto& [id, peer] : s_.peers) of_peers += peer.requests.size();
    for (const auto& [id, request] : s_.requests) {
      if (!s_.peers.contains(request.peer)) continue;
      ++waited_for;
      demand(s_.peers.at(request.peer).requests.contains(id), "a peer does not know its request");
    }
    equal("requests", s_.requests.size(), of_jobs);
    equal("requests of peers", of_peers, waited_for);
  }

  void workers() {
    std::size_t workers = 0;
    for (const auto& [id, peer] : s_.peers) {
      if (!peer.worker) continue;
      ++workers;
      const WorkerState& worker = *peer.worker;
      demand(worker.busy + worker.idle.has_value() == 1 || worker.leaving, "a worker is busy or idle");
    }
    equal("workers", s_.worker_count, workers);
  }

  void kept() {
    BrokerBooks books;
    std::size_t in_order = 0;
    for (const auto& [id, request] : s_.requests)
      if (request.persistent) books.stored += s_.jobs.at(request.job).bytes;
    for (const auto& [id, record] : s_.records) {
      std::size_t bytes = 300 + byte_count(*record.reply);
      for (const Body& part : record.partials) bytes += byte_count(*part);
      (record.persistent ? books.stored : books.records) += bytes;
      in_order += !record.persistent;
      demand(!s_.requests.contains(id), "a request is finished and outstanding");
    }
    for (const auto& [key, orphan] : s_.orphans) {
      if (orphan.reply) books.orphans += byte_count(*orphan.reply);
      for (const Body& part : orphan.partials) books.orphans += byte_count(*part);
      demand(!orphan.job || s_.jobs.at(orphan.job).orphan == key, "an orphan's job is another's");
    }
    for (const Parked& job : s_.parked) books.parked += byte_count(*job.body);
    equal("stored bytes", s_.stored_bytes, books.stored);
    equal("bytes of records", s_.record_bytes, books.records);
    equal("records in order", s_.record_order.size(), in_order);
    equal("bytes of orphans", s_.orphan_bytes, books.orphans);
    equal("parked bytes", s_.parked_bytes, books.parked);
  }

  const BrokerCore::Impl& s_;
  std::string text_;
};

}  // namespace ssphh::majordomo
