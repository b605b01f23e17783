/// Jobs that were set aside, and what an administrator does with them.

#include <ssphh/core/counted.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/parse_number.h>

#include "state.h"

namespace ssphh::majordomo {

void BrokerCore::Impl::park(QueuedJob& job) {
  std::string reason = "failed on " + counted(job.failures.size(), "worker");
  for (const std::string& failure : job.failures) reason += "; " + failure;
  ++sums.parked;
  event(LogLevel::error, "job-parked", Field("job", std::to_string(job.number)),
        Field("service", job.service->name), Field("reason", reason));
  Parked entry{.job = job.number,
               .service = job.service->name,
               .failures = job.failures,
               .body = job.body,
               .attempt_timeout = job.attempt_timeout,
               .since = now};
  for (const RequestId& id : job.requests)
    if (requests.at(id).persistent) entry.persistent.push_back(id);
  keep_parked(std::move(entry));
  finish(job, Outcome::parked, reason, std::make_shared<const Frames>(Frames{Frame()}));
}

void BrokerCore::Impl::keep_parked(Parked&& entry) {
  parked_bytes += byte_count(*entry.body);
  parked.push_back(std::move(entry));
  while (parked.size() > limits.parked_jobs || (parked_bytes > limits.parked_bytes && parked.size() > 1)) {
    parked_bytes -= byte_count(*parked.front().body);
    parked.pop_front();
  }
}

void BrokerCore::Impl::release(const Parked& entry) {
  const JobNumber released = last_job + 1;
  event(LogLevel::info, "job-released", Field("job", std::to_string(entry.job)),
        Field("as", std::to_string(released)), Field("service", entry.service));
  Envelope options;
  options.attempt_timeout = entry.attempt_timeout;
  // Whoever left it on disk gets the result under its id.
  for (const RequestId& id : entry.persistent) {
    if (!records.contains(id)) continue;
    forget_record(id);
    out.store.push_back(
        {StoreOperation::add,
         {.id = id, .service = entry.service, .body = entry.body, .attempt_timeout = entry.attempt_timeout}});
    stored_bytes += byte_count(*entry.body);
    Request request{.id = id, .route = Route::stored, .persistent = true};
    if (QueuedJob* job = find_job(released)) {
      request.job = released;
      job->requests.push_back(id);
      requests.emplace(id, std::move(request));
    } else {
      enqueue(std::move(request), released_owner, entry.service, entry.body, options);
    }
  }
  if (last_job == released) return;
  // Nobody waits any more: the result is for whoever asks for the same again.
  const auto bits = random();
  const RequestId id{bits[0], bits[1]};
  const Hash128 key = content_hash(entry.service, *entry.body);
  const bool keep = !orphans.contains(key);
  if (keep) orphans.emplace(key, Orphan{.job = released, .body = entry.body});
  enqueue({.id = id, .route = Route::released}, released_owner, entry.service, entry.body, options);
  if (keep) jobs.at(released).orphan = key;
}

Frames BrokerCore::Impl::unpark(const std::string& which, bool run_again) {
  const auto number = parse_number<JobNumber>(which);
  if (which != "all" && !number) return {"400"};
  std::deque<Parked> taken;
  for (auto it = parked.begin(); it != parked.end();) {
    const bool chosen = which == "all" || it->job == number;
    if (chosen) {
      parked_bytes -= byte_count(*it->body);
      taken.push_back(std::move(*it));
    }
    it = chosen ? parked.erase(it) : std::next(it);
  }
  if (taken.empty() && which != "all") return {"404"};
  for (const Parked& entry : taken) {
    if (run_again) {
      release(entry);
      continue;
    }
    event(LogLevel::info, "job-forgotten", Field("job", std::to_string(entry.job)),
          Field("service", entry.service));
    for (const RequestId& id : entry.persistent) forget_record(id);
  }
  return {"200", std::to_string(taken.size())};
}

}  // namespace ssphh::majordomo
