#include <atomic>
#include <chrono>
#include <thread>

#include <unistd.h>

#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/farm/engine.h>
#include <ssphh/farm/job_codec.h>
#include <ssphh/farm/run_job.h>
#include <ssphh/farm/worker_pool.h>
#include <ssphh/majordomo/worker.h>

namespace ssphh::farm {
namespace {

std::string host_and_pid() {
  char host[256] = "host";
  ::gethostname(host, sizeof(host) - 1);
  return fmt::format("{}:{}", host, ::getpid());
}

std::size_t unit_count(const Job& job) {
  if (std::holds_alternative<TransportJob>(job)) return 1;
  const auto* probes = std::get_if<ProbeJob>(&job);
  return probes ? probes->probes.size() : std::get<TileJob>(job).tiles.size();
}

class Pool {
 public:
  explicit Pool(const WorkerPoolOptions& options)
      : options_(options), cache_(options.cache, options.cache_bytes), scenes_(cache_) {
    const std::string name = options.name.empty() ? host_and_pid() : options.name;
    for (int i = 0; i < options.slots; ++i) {
      majordomo::WorkerOptions worker;
      worker.endpoint = options.broker.endpoint;
      worker.security = options.broker.security;
      worker.service = job_service(options.other.renderer);
      worker.name = options.slots == 1 ? name : fmt::format("{}/{}", name, i);
      slots_.push_back(std::make_unique<Slot>(worker));
    }
  }

  WorkerPoolReport run(const Control& control) {
    const Stopwatch watch;
    for (const auto& slot : slots_) slot->thread = std::thread([this, s = slot.get()] { serve(*s); });
    while (!control.cancelled() && !idle_for_long() && !failed_ && left_ < options_.slots)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    for (const auto& slot : slots_) slot->worker.stop();
    WorkerPoolReport report;
    for (const auto& slot : slots_) {
      slot->thread.join();
      report.jobs += slot->worker.served();
      report.busy_seconds += slot->busy;
    }
    report.seconds = watch.seconds();
    if (failed_) throw Error(options_.broker.endpoint, failure_);
    return report;
  }

 private:
  struct Slot {
    explicit Slot(const majordomo::WorkerOptions& options) : name(options.name), worker(options) {}
    std::string name;
    majordomo::Worker worker;
    std::thread thread;
    double busy = 0;
  };

  void serve(Slot& slot) {
    try {
      slot.worker.run([&](const majordomo::Job& job) { return run_one(slot, job); });
      left_ += 1;  // asked to stop, or drained by an administrator
    } catch (const std::exception& e) {
      const std::lock_guard lock(failure_mutex_);
      failure_ = e.what();
      failed_ = true;
    }
  }

  majordomo::Frames run_one(Slot& slot, const majordomo::Job& request) {
    running_ += 1;
    struct Done {
      Pool& pool;
      Slot& slot;
      Stopwatch watch = {};
      ~Done() {
        slot.busy += watch.seconds();
        pool.last_job_ = pool.watch_.seconds();
        pool.running_ -= 1;
      }
    } done{*this, slot};
    const std::string& body = request.body.at(0);
    try {
      const Job job = decode_job(body);
      JobResult result = run_job(job, scenes_, fetch_from_broker(options_.broker, request.cancel),
                                 request.control(), options_.other);
      result.stats.worker = slot.name;
      log_info("job={} attempt={} slot={} kind={} units={} seconds={:.3f} rays={}", request.number,
               request.attempt, slot.name, name_of(kind_of(job)), unit_count(job), result.stats.seconds,
               result.stats.rays);
      return {encode_result(result, content_type(body))};
    } catch (const Cancelled&) {
      log_info("job={} attempt={} slot={} cancelled", request.number, request.attempt, slot.name);
      throw;
    } catch (const std::exception& e) {
      log_warning("job={} attempt={} slot={} failed: {}", request.number, request.attempt, slot.name,
                  e.what());
      throw;
    }
  }

  bool idle_for_long() const {
    return options_.idle_exit > 0 && running_ == 0 && watch_.seconds() - last_job_ > options_.idle_exit;
  }

  const WorkerPoolOptions& options_;
  DiskCache cache_;
  SceneStore scenes_;
  std::vector<std::unique_ptr<Slot>> slots_;
  std::atomic<int> running_{0};
  Stopwatch watch_;
  std::atomic<double> last_job_{0};  ///< by watch_, when it ended
  std::atomic<bool> failed_{false};
  std::atomic<int> left_{0};
  std::mutex failure_mutex_;
  std::string failure_;
};

}  // namespace

WorkerPoolReport run_workers(const WorkerPoolOptions& options, const Control& control) {
  if (options.slots < 1 || options.slots > 1024) throw Error("slots", "must be 1 to 1024");
  require(options.idle_exit >= 0, "idle exit", "must be 0 or more seconds");
  Pool pool(options);
  log_info("worker-ready broker={} service={} slots={} cache={}", options.broker.endpoint,
           job_service(options.other.renderer), options.slots, options.cache.string());
  return pool.run(control);
}

}  // namespace ssphh::farm
