#include <algorithm>

#include <ssphh/farm/ask.h>
#include <ssphh/farm/status.h>

namespace ssphh::farm {
namespace {

const std::string stats_service = "mmi.stats", workers_service = "mmi.workers";

std::uint64_t count(const json::Cursor& of, const char* name) {
  const auto number = of.find(name);
  return number ? number->unsigned_integer() : 0;
}

/// Without questions to the broker, as those of a watch itself, which its totals count as well.
double finished_jobs(const json::Value& stats) {
  double sum = 0;
  for (const json::Cursor& service : json::elements(json::Cursor(stats, stats_service)["services"]))
    sum += told_number(service, "finished");
  return sum;
}

}  // namespace

FarmFigures figures_of(const FarmStatus& status) {
  const json::Cursor stats(status.stats, stats_service), workers(status.workers, workers_service);
  const json::Cursor now = stats["now"], total = stats["total"];
  FarmFigures f;
  f.workers = count(now, "workers"), f.idle = count(now, "idle");
  f.queued = count(now, "queued"), f.running = count(now, "running");
  f.finished = count(total, "finished"), f.retries = count(total, "retries");
  f.parked = count(total, "parked");
  const double left = told_number(now, "queued") + told_number(now, "running");
  if (status.per_second && *status.per_second > 0 && left > 0) f.seconds_left = left / *status.per_second;
  for (const json::Cursor& service : json::elements(stats["services"])) {
    f.services.push_back({service.text_or("name"), count(service, "workers"), count(service, "idle"),
                          count(service, "queued"), count(service, "finished")});
  }
  for (const json::Cursor& worker : json::elements(workers["workers"])) {
    f.each_worker.push_back({worker.text_or("name"), worker.text_or("state"),
                             told_number(worker, "since_ms") / 1000, count(worker, "served"),
                             worker.text_or("service")});
  }
  return f;
}

StatusWatch::StatusWatch(const BrokerAddress& broker) : client_(connect(broker)) {}

FarmStatus StatusWatch::look(const Control& control) {
  FarmStatus status{
      ask_json(client_, stats_service, control), ask_json(client_, workers_service, control), {}};
  const double finished = finished_jobs(status.stats);
  if (finished_) status.per_second = std::max(0.0, finished - *finished_) / since_.seconds();
  finished_ = finished, since_ = {};
  return status;
}

}  // namespace ssphh::farm
