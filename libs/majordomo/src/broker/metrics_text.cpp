/// The broker's numbers as Prometheus scrapes them.

#include <prometheus/text_serializer.h>

#include "state.h"

namespace ssphh::majordomo {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;

MetricFamily counter(const char* name, const char* help, std::uint64_t value) {
  ClientMetric metric;
  metric.counter.value = static_cast<double>(value);
  return {std::string("ssphh_broker_") + name, help, MetricType::Counter, {metric}};
}

ClientMetric gauge_of(std::uint64_t value) {
  ClientMetric metric;
  metric.gauge.value = static_cast<double>(value);
  return metric;
}

MetricFamily gauge(const char* name, const char* help, std::uint64_t value) {
  return {std::string("ssphh_broker_") + name, help, MetricType::Gauge, {gauge_of(value)}};
}

}  // namespace

std::string BrokerCore::metrics_text() const {
  const BrokerStats s = stats();
  std::vector<MetricFamily> families = {
      counter("messages_received_total", "Messages from peers.", s.received),
      counter("messages_sent_total", "Messages to peers.", s.sent),
      counter("messages_dropped_total", "Messages that broke a rule or a limit.", s.dropped),
      counter("requests_total", "Requests taken.", s.requests),
      counter("jobs_finished_total", "Jobs answered.", s.finished),
      counter("jobs_failed_total", "Jobs that ended without a result.", s.failed),
      counter("jobs_parked_total", "Jobs set aside after failing on several workers.", s.parked),
      counter("attempts_total", "Jobs given to a worker.", s.attempts),
      counter("retries_total", "Jobs that went back into the queue.", s.retries),
      counter("hedged_total", "Jobs run by a second worker at the same time.", s.hedged),
      counter("late_replies_total", "Replies that nobody waited for.", s.late_replies),
      counter("workers_lost_total", "Workers that died or fell silent.", s.workers_lost),
      gauge("workers", "Workers registered.", s.workers),
      gauge("workers_idle", "Workers without a job.", s.idle),
      gauge("jobs_queued", "Jobs that wait for a worker.", s.queued),
      gauge("jobs_running", "Jobs that a worker has.", s.running),
      gauge("requests_outstanding", "Requests without a reply.", s.outstanding),
      gauge("request_bytes", "Bytes of the bodies of all jobs.", s.bytes),
  };
  MetricFamily& queued = families.emplace_back();
  queued.name = "ssphh_broker_service_queued";
  queued.help = "Jobs of a service that wait for a worker.";
  queued.type = MetricType::Gauge;
  for (const auto& [name, service] : impl_->services) {
    queued.metric.push_back(gauge_of(service.queued));
    queued.metric.back().label = {{"service", name}};
  }
  return prometheus::TextSerializer().Serialize(families);
}

}  // namespace ssphh::majordomo
