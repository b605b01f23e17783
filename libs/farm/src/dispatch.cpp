#include <algorithm>
#include <numeric>
#include <unordered_map>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>
#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/farm/ask.h>
#include <ssphh/farm/dispatch.h>
#include <ssphh/farm/engine.h>
#include <ssphh/farm/job_cutter.h>

namespace ssphh::farm {
namespace {

using majordomo::ClientEvent;
using majordomo::RequestId;

constexpr majordomo::Millis look = 200;  // for a cancel, and for what the broker says of its workers

class Dispatcher {
 public:
  Dispatcher(const FarmOptions& options, const std::vector<UnitGroup>& groups, FarmReport& report,
             const std::function<void(std::size_t, const FarmReport&)>& finished)
      : groups_(groups),
        report_(report),
        finished_(finished),
        renderer_(options.renderer),
        service_(job_service(options.renderer)),
        messages_(options.messages),
        failure_(options.failure),
        patience_(options.patience),
        client_(connect(options.broker)) {
    for (const UnitGroup& group : groups) {
      next_.push_back(0);
      cutters_.emplace_back(options.job_seconds, group.most_per_job);
      left_ += group.count;
    }
  }

  void run(const Control& control) {
    std::optional<Stopwatch> asked;
    while (left_ > 0) {
      control.check();
      if ((!asked || asked->seconds() > 1) && !asking_) {
        majordomo::RequestOptions request;
        request.deadline = 5000;
        asking_ = client_.submit("mmi.stats", {""}, request);
        asked.emplace();
      }
      submit_more();
      if (auto event = client_.poll(look)) take(std::move(*event));
      complain();
      give_up();
    }
  }

 private:
  struct Sent {
    std::size_t group = 0;
    std::vector<std::size_t> units;
    std::uint64_t number = 0;  ///< of the job, from 1
  };

  /// Two jobs for each worker, so that none waits for the next one.
  void submit_more() {
    const auto window = std::max<std::size_t>(4, 2 * static_cast<std::size_t>(workers_));
    for (std::size_t g = 0; g < groups_.size() && sent_.size() < window; ++g) {
      while (next_[g] < groups_[g].count && sent_.size() < window) {
        Sent job{g, {}, ++report_.jobs};
        const std::size_t left = groups_[g].count - next_[g];
        job.units.resize(cutters_[g].next(left, static_cast<std::size_t>(workers_)));
        std::iota(job.units.begin(), job.units.end(), next_[g]);
        next_[g] += job.units.size();
        std::string body = groups_[g].body(job.units);
        keep(job.number, "job", body);
        majordomo::RequestOptions request;
        request.content_key = Hasher().text(body).finish();
        const RequestId id = client_.submit(service_, {std::move(body)}, request);
        sent_.emplace(id, std::move(job));
      }
    }
  }

  void take(ClientEvent event) {
    if (asking_ && event.id == *asking_) {
      asking_.reset();
      if (event.outcome == majordomo::Outcome::ok) take_stats(event.body);
      return;
    }
    const auto found = sent_.find(event.id);
    if (found == sent_.end() || !event.final) return;
    const Sent job = std::move(found->second);
    sent_.erase(found);
    if (event.attempts > 1) report_.retries += static_cast<std::uint64_t>(event.attempts - 1);
    if (event.outcome != majordomo::Outcome::ok) {
      throw Error(
          "the farm",
          fmt::format("a job of {} ended as \"{}\": {}", counted(job.units.size(), "unit"),
                      name_of(event.outcome), event.reason),
          event.outcome == majordomo::Outcome::parked ? "the broker keeps it: see `ssphh farm parked`" : "");
    }
    if (event.body.empty()) throw Error("the farm", "a worker answered without a result");
    keep(job.number, "result", event.body[0]);
    JobResult result = decode_result(event.body[0]);
    cutters_[job.group].learn(job.units.size(), result.stats.seconds);
    report_.compute_seconds += result.stats.seconds;
    groups_[job.group].done(job.units, std::move(result));
    left_ -= job.units.size();
    heard_ = true;
    finished_(job.units.size(), report_);
  }

  void take_stats(const majordomo::Frames& body) {
    if (body.size() < 2 || body[0] != "200") return;
    try {
      const std::string where = "mmi.stats";
      const json::Value stats = json::parse(body[1], where);
      int workers = 0;
      for (const json::Cursor& service : json::elements(json::Cursor(stats, where)["services"])) {
        if (service.text_or("name") == service_)
          workers = static_cast<int>(service["workers"].integer(0, INT32_MAX));
      }
      workers_ = workers;
      known_ = true;
      report_.workers = std::max(report_.workers, workers_);
    } catch (const Error&) {
      // Another broker may say nothing of workers, or say it otherwise.
    }
  }

  void keep(std::uint64_t job, const char* what, const std::string& body) const {
    if (messages_.empty()) return;
    const char* ending = content_type(body) == ContentType::json ? "json" : "bin";
    write_file(messages_ / fmt::format("{:04}.{}.{}", job, what, ending), body);
  }

  void give_up() const {
    if (!failure_ || left_ == 0) return;
    if (const std::string why = failure_(); !why.empty()) throw Error("the farm", why);
  }

  /// Says once what it waits for.
  void complain() {
    if (complained_ || heard_ || watch_.seconds() < patience_) return;
    if (!client_.connected()) {
      log_warning("the broker does not answer yet; still trying");
    } else if (known_ && workers_ == 0) {
      const std::string started =
          renderer_ == Renderer::path
              ? ""
              : fmt::format(" that was started with --renderer {}", name_of(renderer_));
      log_warning("the broker has no worker of this build (engine {}){}; jobs wait for one", engine_id(),
                  started);
    } else {
      return;
    }
    complained_ = true;
  }

  const std::vector<UnitGroup>& groups_;
  FarmReport& report_;
  const std::function<void(std::size_t, const FarmReport&)>& finished_;
  Renderer renderer_;
  std::string service_;
  std::filesystem::path messages_;
  const std::function<std::string()>& failure_;
  double patience_;
  majordomo::Client client_;
  std::vector<std::size_t> next_;  ///< first unit of each group that no job has
  std::vector<JobCutter> cutters_;
  std::unordered_map<RequestId, Sent> sent_;
  std::optional<RequestId> asking_;
  Stopwatch watch_;
  std::size_t left_ = 0;
  int workers_ = 0;
  bool known_ = false, heard_ = false, complained_ = false;
};

}  // namespace

void dispatch(const FarmOptions& options, const std::vector<UnitGroup>& groups, FarmReport& report,
              const std::function<void(std::size_t, const FarmReport&)>& finished, const Control& control) {
  const Stopwatch watch;
  const char* const where = "farm's work";
  require(options.patience >= 0, where, "its patience is no number of seconds");
  for (const UnitGroup& group : groups) {
    if (group.count == 0) continue;
    require(group.body != nullptr, where, "units have no body of a job");
    require(group.done != nullptr, where, "nobody takes what is done");
    require(finished != nullptr, where, "nobody is told what is finished");
  }
  if (!options.messages.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.messages, error);
    if (error) throw Error(options.messages.string(), "cannot be created: " + error.message());
  }
  Dispatcher(options, groups, report, finished).run(control);
  report.seconds += watch.seconds();
}

}  // namespace ssphh::farm
