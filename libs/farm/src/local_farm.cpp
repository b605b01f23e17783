#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ssphh/core/error.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/farm/local_farm.h>

namespace ssphh::farm {
namespace {

namespace fs = std::filesystem;

std::string temporary_folder() {
  std::string pattern = (fs::temp_directory_path() / "ssphh-farm-XXXXXX").string();
  if (!::mkdtemp(pattern.data()))
    throw Error(pattern, fmt::format("cannot be made: {}", std::strerror(errno)));
  return pattern;
}

/// Starts the tool in a process group of its own, so that Ctrl-C reaches the parent alone, and bound to the
/// parent's life.
pid_t spawn(const fs::path& tool, const std::vector<std::string>& arguments, const fs::path& log) {
  std::vector<char*> argv = {const_cast<char*>(tool.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) throw Error(tool.string(), fmt::format("cannot be started: {}", std::strerror(errno)));
  if (pid > 0) return pid;
  // Between fork and exec only what is safe in signal handlers.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  // One by one: where the parent has no stdin, the next file opened gets its number
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  ::dup2(out, STDOUT_FILENO), ::dup2(out, STDERR_FILENO);
  ::execv(tool.c_str(), argv.data());
  ::_exit(127);
}

/// Else its processes would end and be started again, with nobody told why.
void require_program(const fs::path& tool) {
  std::error_code ignored;
  if (!fs::is_regular_file(tool, ignored) || ::access(tool.c_str(), X_OK) != 0)
    throw Error(tool.string(), "is no program: it cannot be started", "name the ssphh tool");
}

/// How a process has ended; none: it has not.
struct Ending {
  int exit_code = -1;  ///< −1: by a signal
  std::string text;
};

std::optional<Ending> ended(pid_t pid) {
  int status = 0;
  if (::waitpid(pid, &status, WNOHANG) == 0) return {};
  if (WIFSIGNALED(status))
    return Ending{-1, fmt::format("signal {}, {}", WTERMSIG(status), ::strsignal(WTERMSIG(status)))};
  return Ending{WEXITSTATUS(status), fmt::format("exit code {}", WEXITSTATUS(status))};
}

/// The last lines of a log, for a message that ends with them; empty: there are none.
std::string tail_of(const fs::path& log) {
  std::string text;
  if (FILE* file = std::fopen(log.c_str(), "r")) {
    char buffer[1024];
    if (std::fseek(file, -1000, SEEK_END) != 0) std::rewind(file);
    text.assign(buffer, std::fread(buffer, 1, sizeof(buffer), file));
    std::fclose(file);
  }
  while (text.ends_with('\n')) text.pop_back();
  return text.empty() ? "" : "; its log ends: " + text;
}

}  // namespace

struct LocalFarm::Impl {
  LocalFarmOptions options;
  fs::path folder;
  std::string endpoint;
  pid_t broker = -1;
  mutable std::mutex mutex;
  std::vector<pid_t> workers;
  int restarts = 0;
  std::string failure;
  std::atomic<bool> stopping{false};
  std::thread watcher;

  pid_t start_worker(std::size_t i) const {
    const auto count = static_cast<std::size_t>(options.workers);
    const int threads = options.threads > 0 ? options.threads : std::max(1, thread_count() / options.workers);
    return spawn(options.tool,
                 {"worker", "--broker", endpoint, "--renderer", std::string(name_of(options.renderer)),
                  "--slots", "1", "--threads", std::to_string(threads), "--name",
                  fmt::format("local:{}", i % count), "--cache", options.cache.string(), "--cache-size",
                  std::to_string(std::max<std::uint64_t>(1, options.cache_bytes >> 20)), "--config", "none"},
                 log_of(i));
  }

  fs::path log_of(std::size_t worker) const { return folder / fmt::format("worker-{}.log", worker); }

  pid_t start_broker() const {
    return spawn(options.tool, {"broker", "--bind", endpoint, "--attempts", "5", "--config", "none"},
                 folder / "broker.log");
  }

  void watch() {
    while (!stopping) {
      std::this_thread::sleep_for(options.look);
      const std::lock_guard lock(mutex);
      if (const auto end = broker > 0 ? ended(broker) : std::nullopt) {
        failure = fmt::format("the local broker has ended ({}){}", end->text, tail_of(folder / "broker.log"));
        broker = -1;
      }
      for (std::size_t i = 0; i < workers.size() && !stopping; ++i) {
        if (const auto end = workers[i] > 0 ? ended(workers[i]) : std::nullopt) end_worker(i, *end);
      }
    }
  }

  void end_worker(std::size_t i, const Ending& end) {
    const bool again = end.exit_code != never_retry && restarts < 8 * options.workers;
    const std::string what = fmt::format("local worker {} has ended ({})", i, end.text);
    if (again) {
      log_warning("{}; it is started again", what);
      workers[i] = start_worker(i);
      ++restarts;
      return;
    }
    const std::string all = what + tail_of(log_of(i));
    workers[i] = -1;
    const bool left = std::ranges::any_of(workers, [](pid_t pid) { return pid > 0; });
    if (left || !failure.empty())
      log_warning("{}", all);
    else
      failure = "no worker is left: " + all;
  }

  void stop() {
    stopping = true;
    if (watcher.joinable()) watcher.join();
    std::vector<pid_t> left;
    for (const pid_t pid : workers)
      if (pid > 0) left.push_back(pid);
    if (broker > 0) left.push_back(broker);
    // Nothing of theirs is worth keeping: finished work has been handed over.
    for (const pid_t pid : left) {
      ::kill(pid, SIGKILL);
      int status;
      while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
      }
    }
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
};

LocalFarm::LocalFarm(LocalFarmOptions options) : impl_(new Impl) {
  Impl& s = *impl_;
  s.options = std::move(options);
  if (s.options.workers < 1 || s.options.workers > 1024) throw Error("--local", "must be 1 to 1024 workers");
  require(s.options.threads >= 0, "local farm", "workers of fewer than 0 threads");
  require(s.options.look.count() > 0, "local farm", "it would look at its processes without a pause");
  require_program(s.options.tool);
  s.folder = temporary_folder();
  s.endpoint = "ipc://" + (s.folder / "broker").string();
  try {
    s.broker = s.start_broker();
    for (int i = 0; i < s.options.workers; ++i)
      s.workers.push_back(s.start_worker(static_cast<std::size_t>(i)));
  } catch (...) {
    s.stop();
    throw;
  }
  s.watcher = std::thread([&s] { s.watch(); });
}

LocalFarm::~LocalFarm() {
  impl_->stop();
}

BrokerAddress LocalFarm::address() const {
  return {impl_->endpoint, std::nullopt};
}

int LocalFarm::broker_pid() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->broker;
}

std::string LocalFarm::failure() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->failure;
}

void LocalFarm::restart() {
  Impl& s = *impl_;
  const std::lock_guard lock(s.mutex);
  require_program(s.options.tool);
  if (s.broker < 0) s.broker = s.start_broker();
  for (std::size_t i = 0; i < s.workers.size(); ++i) {
    if (s.workers[i] < 0) s.workers[i] = s.start_worker(i);
  }
  s.restarts = 0;
  s.failure.clear();
}

std::vector<int> LocalFarm::worker_pids() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->workers;
}

}  // namespace ssphh::farm
