/// What is meant where nobody says anything: every default once.

#include <gtest/gtest.h>

#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/broker_core.h>
#include <ssphh/majordomo/envelope.h>
#include <ssphh/majordomo/mdp.h>
#include <ssphh/majordomo/worker.h>

#include "broker/state.h"
#include "socket.h"
#include "worker_core.h"

namespace ssphh::majordomo::test {
namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;

TEST(MajordomoDefaults, OfLimits) {
  const BrokerLimits limits;
  const auto& [frame_bytes, message_frames, message_bytes, service_name_bytes, services, peers,
               queued_requests, queued_bytes, client_requests, client_bytes, reply_bytes, outbox_bytes,
               record_bytes, stored_bytes, parked_jobs, parked_bytes, messages_per_second, attempts] = limits;
  EXPECT_EQ(frame_bytes, 64 * mebibyte);
  EXPECT_EQ(message_frames, 64u);
  EXPECT_EQ(message_bytes, 256 * mebibyte);
  EXPECT_EQ(service_name_bytes, 255u);
  EXPECT_EQ(services, 4096u);
  EXPECT_EQ(peers, 65536u);
  EXPECT_EQ(queued_requests, 1'000'000u);
  EXPECT_EQ(queued_bytes, 4096 * mebibyte);
  EXPECT_EQ(client_requests, 200'000u);
  EXPECT_EQ(client_bytes, 2048 * mebibyte);
  EXPECT_EQ(reply_bytes, 256 * mebibyte);
  EXPECT_EQ(outbox_bytes, 512 * mebibyte);
  EXPECT_EQ(record_bytes, 256 * mebibyte);
  EXPECT_EQ(stored_bytes, 16384 * mebibyte);
  EXPECT_EQ(parked_jobs, 1000u);
  EXPECT_EQ(parked_bytes, 256 * mebibyte);
  EXPECT_EQ(messages_per_second, 200'000);
  EXPECT_EQ(attempts, 3);
}

TEST(MajordomoDefaults, OfTimers) {
  const BrokerTimers timers;
  const auto& [heartbeat, worker_expiry, request_expiry, retry_backoff, retry_backoff_max, attempt_timeout,
               record, stored_result, service_idle, straggler_least, client_grace, straggler,
               straggler_after] = timers;
  EXPECT_EQ(heartbeat, 2500);
  EXPECT_EQ(worker_expiry, 8000);
  EXPECT_EQ(request_expiry, 600'000);
  EXPECT_EQ(retry_backoff, 100);
  EXPECT_EQ(retry_backoff_max, 10'000);
  EXPECT_EQ(attempt_timeout, 3'600'000);
  EXPECT_EQ(record, 60'000);
  EXPECT_EQ(stored_result, 604'800'000);
  EXPECT_EQ(service_idle, 600'000);
  EXPECT_EQ(straggler_least, 1000);
  EXPECT_EQ(client_grace, 10'000);
  EXPECT_EQ(straggler, 1.5);
  EXPECT_EQ(straggler_after, 0.75);
}

TEST(MajordomoDefaults, OfPeersAndBrokers) {
  const BrokerOptions broker;
  EXPECT_EQ(broker.bind, "tcp://127.0.0.1:5555");
  EXPECT_EQ(broker.metrics_bind, "");
  EXPECT_FALSE(broker.security);
  EXPECT_TRUE(broker.store.empty());
  EXPECT_EQ(broker.connection_timeout, 6000);
  EXPECT_EQ(broker.drain, 10'000);
  EXPECT_EQ(broker.least_event, LogLevel::info);
  const ClientOptions client;
  EXPECT_EQ(client.endpoint, "");
  EXPECT_FALSE(client.security);
  EXPECT_EQ(client.dialect, Dialect::own);
  EXPECT_EQ(client.window, 1000u);
  EXPECT_EQ(client.ask_again, 2500);
  EXPECT_EQ(client.foreign_timeout, 2500);
  EXPECT_EQ(client.foreign_tries, 3);
  const RequestOptions request;
  EXPECT_EQ(request.deadline, 0);
  EXPECT_EQ(request.attempt_timeout, 0);
  EXPECT_FALSE(request.content_key);
  EXPECT_FALSE(request.persistent);
  EXPECT_FALSE(request.id);
  const WorkerOptions worker;
  EXPECT_EQ(worker.endpoint + worker.service + worker.name, "");
  EXPECT_FALSE(worker.security);
  EXPECT_EQ(worker.dialect, Dialect::own);
  EXPECT_EQ(worker.heartbeat, 2500);
  EXPECT_EQ(worker.broker_expiry, 10'000);
  EXPECT_EQ(worker.reconnect, 250);
  EXPECT_EQ(worker.reconnect_max, 10'000);
  const Job job;
  EXPECT_EQ(job.number, 0u);
  EXPECT_EQ(job.attempt, 1);
  EXPECT_EQ(job.cancel, nullptr);
  EXPECT_EQ(job.control().cancel, nullptr);
  const Rights rights;
  EXPECT_EQ(rights.name, "");
  EXPECT_TRUE(rights.client);
  EXPECT_TRUE(rights.admin);
  EXPECT_EQ(rights.services, std::vector<std::string>{"*"});
}

TEST(MajordomoDefaults, OfMessages) {
  const ClientEvent event;
  EXPECT_TRUE(event.final);
  EXPECT_EQ(event.outcome, Outcome::ok);
  EXPECT_EQ(event.attempts, 0);
  const Envelope envelope;
  EXPECT_EQ(envelope.kind, EnvelopeKind::submit);
  EXPECT_EQ(envelope.outcome, Outcome::ok);
  EXPECT_EQ(envelope.deadline + envelope.attempt_timeout + envelope.retry_after, 0);
  EXPECT_FALSE(envelope.persistent);
  EXPECT_FALSE(envelope.retry);
  EXPECT_EQ(envelope.attempts + envelope.sequence, 0u);
  EXPECT_FALSE(envelope.content_key);
  EXPECT_FALSE(envelope.token);
  const Token token;
  EXPECT_EQ(token.high + token.low + token.job + token.timeout + token.attempt, 0u);
  const Message message;
  EXPECT_EQ(message.version, Version::v02);
  EXPECT_EQ(message.side, Side::client);
  EXPECT_EQ(message.command, Command::request);
  const Decoded decoded;
  EXPECT_EQ(decoded.problem, nullptr);
  const BrokerEvent logged;
  EXPECT_EQ(logged.level, LogLevel::info);
  EXPECT_STREQ(logged.name, "");
  const StoredRequest stored;
  EXPECT_EQ(stored.attempt_timeout, 0);
  EXPECT_FALSE(stored.finished);
  EXPECT_EQ(stored.outcome, Outcome::ok);
  EXPECT_EQ(stored.attempts, 0u);
  const StoreOperation operation{};
  EXPECT_EQ(operation.kind, StoreOperation::add);
  const JobResult result;
  EXPECT_EQ(result.outcome, Outcome::ok);
  EXPECT_FALSE(result.retry);
  const Routed routed;
  EXPECT_EQ(routed.fd, -1);
  EXPECT_EQ(routed.user, "");
  EXPECT_EQ(RequestId().high + RequestId().low, 0u);
  EXPECT_EQ(envelope_version, 1);
  EXPECT_EQ(control_service, "mmi.request");
  EXPECT_EQ(own_worker_prefix, "ssphh1:");
  EXPECT_EQ(envelope_ids, 4000u);
}

TEST(MajordomoDefaults, OfTheBrokersBooks) {
  const BrokerStats s;
  EXPECT_EQ(s.received + s.sent + s.dropped + s.requests + s.finished + s.failed + s.parked + s.expired +
                s.cancelled + s.busy + s.attempts + s.retries + s.hedged + s.coalesced + s.repeated +
                s.late_replies + s.workers_lost,
            0u);
  EXPECT_EQ(
      s.peers + s.workers + s.idle + s.outstanding + s.queued + s.running + s.bytes + s.services + s.records,
      0u);
  const Service service{};
  EXPECT_EQ(service.workers + service.queued + service.requests + service.finished + service.measured, 0u);
  EXPECT_EQ(service.used, 0);
  const Attempt attempt;
  EXPECT_EQ(attempt.started, 0);
  EXPECT_EQ(attempt.partials, 0u);
  EXPECT_TRUE(attempt.live);
  const QueuedJob job{};
  EXPECT_EQ(job.number + job.bytes + job.reply_bytes, 0u);
  EXPECT_EQ(job.place, Place::none);
  EXPECT_EQ(job.attempt_timeout + job.submitted, 0);
  const Request request;
  EXPECT_EQ(request.route, Route::own);
  EXPECT_EQ(request.job, 0u);
  EXPECT_FALSE(request.persistent);
  const WorkerState worker;
  EXPECT_EQ(worker.version, Version::v02);
  EXPECT_EQ(worker.sent + worker.since, 0);
  EXPECT_EQ(worker.served, 0u);
  EXPECT_FALSE(worker.own || worker.busy || worker.suspect || worker.leaving);
  const Peer peer;
  EXPECT_FALSE(peer.invalid || peer.told || peer.gone);
  EXPECT_EQ(peer.heard + peer.filled, 0);
  EXPECT_EQ(peer.allowance, 0);
  const Record record;
  EXPECT_EQ(record.outcome, Outcome::ok);
  EXPECT_EQ(record.attempts + record.bytes, 0u);
  EXPECT_FALSE(record.persistent);
  const Orphan orphan;
  EXPECT_EQ(orphan.job + orphan.bytes, 0u);
  const Parked parked;
  EXPECT_EQ(parked.job, 0u);
  EXPECT_EQ(parked.attempt_timeout + parked.since, 0);
}

TEST(Outcomes, HaveTheirNumbersAndNames) {
  const char* const names[] = {"ok", "failed", "parked", "cancelled", "expired", "refused", "no answer"};
  const Outcome all[] = {Outcome::ok,      Outcome::failed,  Outcome::parked,   Outcome::cancelled,
                         Outcome::expired, Outcome::refused, Outcome::no_answer};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(all[i]), i);
    EXPECT_EQ(name_of(all[i]), names[i]);
  }
}

}  // namespace
}  // namespace ssphh::majordomo::test
