#include <algorithm>

#include "state.h"

namespace ssphh::majordomo {
namespace {

constexpr int scan = 16;                    // candidates looked at per step, so that a step's cost is bounded
constexpr std::size_t measurements = 5;     // before a median means anything
constexpr std::size_t most_attempts = 100;  // handed back again and again is a failure, too

Millis median(const Service& service) {
  auto values = service.durations;
  const std::size_t count = std::min(service.measured, values.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

}  // namespace

std::size_t QueuedJob::live() const {
  return static_cast<std::size_t>(std::ranges::count_if(attempts, [](const Attempt& a) { return a.live; }));
}

void BrokerCore::Impl::put_in_lane(QueuedJob& job) {
  Service& service = *job.service;
  Lane& lane = service.lanes[job.owner];
  job.place = Place::lane;
  job.at = lane.jobs.insert(lane.jobs.end(), job.number);
  if (!lane.turn) lane.turn = service.turns.insert(service.turns.end(), job.owner);
  ++service.queued;
  ++queued_count;
}

void BrokerCore::Impl::put_in_choosy(QueuedJob& job) {
  job.place = Place::choosy;
  job.at = job.service->choosy.insert(job.service->choosy.end(), job.number);
  ++job.service->queued;
  ++queued_count;
}

void BrokerCore::Impl::unqueue(QueuedJob& job) {
  Service& service = *job.service;
  if (job.place == Place::lane) {
    Lane& lane = service.lanes.at(job.owner);
    lane.jobs.erase(job.at);
    if (lane.jobs.empty()) {
      service.turns.erase(*lane.turn);
      lane.turn.reset();
    }
  } else if (job.place == Place::choosy) {
    service.choosy.erase(job.at);
  } else {
    timers.cancel(job.backoff);
    job.place = Place::none;
    return;
  }
  job.place = Place::none;
  --service.queued;
  --queued_count;
}

void BrokerCore::Impl::dispatch(Service& service) {
  while (!draining && !service.idle.empty() &&
         (dispatch_choosy(service) || dispatch_lane(service) || dispatch_straggler(service))) {
  }
}

std::optional<std::string> BrokerCore::Impl::pick_worker(const Service& service, const QueuedJob& job) const {
  if (job.avoid.empty()) return service.idle.front();
  std::size_t avoided = 0;
  for (const std::string& name : job.avoid)
    if (const auto found = service.names.find(name); found != service.names.end()) avoided += found->second;
  if (avoided >= service.workers) return service.idle.front();  // there is nobody else
  int left = scan;
  for (const std::string& id : service.idle) {
    if (std::ranges::find(job.avoid, peers.at(id).worker->name) == job.avoid.end()) return id;
    if (--left == 0) break;
  }
  return std::nullopt;
}

bool BrokerCore::Impl::dispatch_choosy(Service& service) {
  const std::size_t candidates = std::min<std::size_t>(scan, service.choosy.size());
  for (std::size_t i = 0; i < candidates; ++i) {
    QueuedJob& job = jobs.at(service.choosy.front());
    if (const auto worker = pick_worker(service, job)) {
      unqueue(job);
      start(job, *worker);
      return true;
    }
    service.choosy.splice(service.choosy.end(), service.choosy, service.choosy.begin());
  }
  return false;
}

bool BrokerCore::Impl::dispatch_lane(Service& service) {
  if (service.turns.empty()) return false;
  Lane& lane = service.lanes.at(service.turns.front());
  QueuedJob& job = jobs.at(lane.jobs.front());
  unqueue(job);
  if (lane.turn) service.turns.splice(service.turns.end(), service.turns, *lane.turn);
  start(job, service.idle.front());
  return true;
}

bool BrokerCore::Impl::dispatch_straggler(Service& service) {
  if (service.measured < measurements || service.running.empty()) return false;
  const Millis late = std::max(times.straggler_least,
                               static_cast<Millis>(times.straggler * static_cast<double>(median(service))));
  int left = scan;
  Millis next = Timers::never;
  for (const JobNumber number : service.running) {
    QueuedJob& job = jobs.at(number);
    const Lane& lane = service.lanes.at(job.owner);
    const double done = static_cast<double>(lane.finished);
    const bool nearly = done >= times.straggler_after * (done + static_cast<double>(lane.outstanding)) &&
                        job.place == Place::none;
    const Millis due = job.attempts.back().started + late;
    if (nearly && now >= due) {
      if (const auto worker = pick_worker(service, job)) {
        ++sums.hedged;
        event(LogLevel::info, "job-hedged", Field("job", std::to_string(number)),
              Field("service", service.name), Field("age_ms", std::to_string(now - due + late)));
        start(job, *worker);
        return true;
      }
    } else if (nearly) {
      next = std::min(next, due);
      break;  // the others began later
    }
    if (--left == 0) break;
  }
  timers.cancel(service.straggle);
  if (next != Timers::never) {
    service.straggle = timers.set(next, [this, &service](Millis) {
      service.straggle = {};
      dispatch(service);
    });
  }
  return false;
}

void BrokerCore::Impl::start(QueuedJob& job, const std::string& worker_id) {
  const std::string id = worker_id;  // may be the element of `idle` that is erased here
  Service& service = *job.service;
  WorkerState& worker = *peers.at(id).worker;
  service.idle.erase(*worker.idle);
  worker.idle.reset();
  worker.busy = true;
  worker.since = now;
  const auto bits = random();
  const Millis timeout = std::min<Millis>(job.attempt_timeout, 0xffffffff);
  worker.token = {.high = bits[0],
                  .low = bits[1],
                  .job = job.number,
                  .timeout = static_cast<std::uint32_t>(timeout),
                  .attempt = static_cast<std::uint8_t>(std::min<std::size_t>(job.attempts.size() + 1, 255))};
  worker.attempt = timers.set(now + timeout, [this, id](Millis) { attempt_overdue(id); });
  if (job.live() == 0) {
    ++running_count;
    job.run = service.running.insert(service.running.end(), job.number);
  } else if (job.run) {
    service.running.erase(*job.run);
    job.run.reset();
  }
  job.attempts.push_back({.token = worker.token, .worker = id, .started = now});
  tokens.emplace(RequestId{bits[0], bits[1]}, job.number);
  ++sums.attempts;
  if (wants(LogLevel::debug))
    event(LogLevel::debug, "job-started", Field("job", std::to_string(job.number)),
          Field("service", service.name), Field("worker", worker.name),
          Field("attempt", std::to_string(job.attempts.size())));
  to_worker(id, worker, Command::request, worker.token.frame(), job.body);
}

void BrokerCore::Impl::fail_attempt(QueuedJob& job, Attempt& attempt, const std::string& why,
                                    bool handed_back) {
  attempt.live = false;
  Service& service = *job.service;
  const std::string worker = peer_text(attempt.worker);
  if (!handed_back) {
    job.failures.push_back(worker + ": " + why);
    job.avoid.push_back(worker);
  }
  if (job.live() > 0) return;
  --running_count;
  if (job.run) {
    service.running.erase(*job.run);
    job.run.reset();
  }
  if (job.requests.empty()) return erase_job(job);
  if (job.failures.size() >= static_cast<std::size_t>(limits.attempts) ||
      job.attempts.size() >= most_attempts) {
    return park(job);
  }
  if (job.place != Place::none) return;
  ++sums.retries;
  event(LogLevel::warning, "job-retry", Field("job", std::to_string(job.number)),
        Field("service", service.name), Field("worker", worker),
        Field("attempt", std::to_string(job.attempts.size())), Field("reason", why));
  if (handed_back) {
    put_in_choosy(job);
    return dispatch(service);
  }
  Millis pause = times.retry_backoff;
  for (std::size_t i = 1; i < job.failures.size() && pause < times.retry_backoff_max; ++i) pause *= 2;
  job.place = Place::backoff;
  job.backoff =
      timers.set(now + std::min(pause, times.retry_backoff_max), [this, number = job.number](Millis) {
        QueuedJob& again = jobs.at(number);
        again.backoff = {};
        put_in_choosy(again);
        dispatch(*again.service);
      });
}

}  // namespace ssphh::majordomo
