/// mdp_probe: what does a Majordomo broker do? Black-box checks of 7/MDP, 18/MDP and 8/MMI and of what makes
/// a broker dependable, against any implementation.
///
///   mdp_probe --endpoint tcp://127.0.0.1:5555
///   mdp_probe -- ssphh broker --bind tcp://127.0.0.1:5555      (endpoint: --endpoint, else 127.0.0.1:5555)
///   mdp_probe --only times --beat 400 -- quick_broker ENDPOINT 400  (those that wait for heartbeats: 2500 ms
///                                                                    unless --beat says otherwise)
///
/// With a command, the broker is started, started again when a check kills it, and must end on SIGTERM.
/// Prints one line per check; exit code 0 when all pass, 1 otherwise, 2 for wrong usage.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <future>
#include <string>
#include <vector>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "checks.h"
#include "peer.h"

namespace ssphh::probe {
namespace {

class BrokerProcess {
 public:
  BrokerProcess(std::string endpoint, std::vector<char*> command)
      : endpoint_(std::move(endpoint)), command_(std::move(command)) {
    if (!command_.empty()) command_.push_back(nullptr);
    start();
  }
  ~BrokerProcess() { end(); }
  bool has_command() const { return !command_.empty(); }
  /// Whether it has died; then it is started again.
  bool died() {
    int status = 0;
    if (pid_ <= 0 || ::waitpid(pid_, &status, WNOHANG) != pid_) return false;
    start();
    return true;
  }
  /// SIGTERM; whether it ends by itself within ten seconds.
  bool end() {
    if (pid_ <= 0) return true;
    ::kill(pid_, SIGTERM);
    for (int i = 0; i < 500; ++i, pause(20)) {
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = 0;
        return true;
      }
    }
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
    return false;
  }

 private:
  void start() {
    if (command_.empty()) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) ::_exit(126);
      ::execvp(command_[0], command_.data());
      ::_exit(127);
    }
    Peer(endpoint_).connected();
  }

  std::string endpoint_;
  std::vector<char*> command_;
  pid_t pid_ = 0;
};

struct Tally {
  int passed = 0, all = 0;
  void tell(const Check& check, const char* verdict) {
    std::printf("%-6s %-11s %s\n", verdict, check.source, check.name);
    std::fflush(stdout);
    ++all;
    passed += std::strcmp(verdict, "pass") == 0;
  }
};

bool passes(const Check& check, const std::string& endpoint) {
  try {
    return check.passes(endpoint);
  } catch (const std::exception&) {
    return false;
  }
}

struct Options {
  std::string endpoint = "tcp://127.0.0.1:5555", only;
  int beat = 2500;
  std::vector<char*> command;
  bool wants(const char* part) const { return only.empty() || only == part; }
};

void check_side_by_side(const std::vector<Check>& checks, const std::string& endpoint, Tally& tally) {
  std::vector<std::future<bool>> verdicts;
  for (const Check& check : checks)
    verdicts.push_back(
        std::async(std::launch::async, [&check, &endpoint] { return passes(check, endpoint); }));
  for (std::size_t i = 0; i < checks.size(); ++i) tally.tell(checks[i], verdicts[i].get() ? "pass" : "FAIL");
}

int run(const Options& options) {
  const std::string& endpoint = options.endpoint;
  BrokerProcess broker(endpoint, options.command);
  Tally tally;
  std::vector<Check> side_by_side;
  if (options.wants("rules")) side_by_side = rules();
  if (options.wants("times"))
    for (Check& check : times(options.beat)) side_by_side.push_back(std::move(check));
  check_side_by_side(side_by_side, endpoint, tally);
  broker.died();
  for (const Check& check : options.wants("rules") ? hostile() : std::vector<Check>{}) {
    const bool good = passes(check, endpoint);
    tally.tell(check, broker.died() ? "CRASH" : good ? "pass" : "FAIL");
  }
  if (broker.has_command()) {
    Peer client(endpoint);
    for (int i = 0; i < 1000; ++i) client.send(request01("p.nobody", {std::string(1000, 'x')}));
    const Check check{"ends on SIGTERM under load", "dependable", nullptr};
    tally.tell(check, broker.end() ? "pass" : "FAIL");
  }
  std::printf("%d of %d\n", tally.passed, tally.all);
  return tally.passed == tally.all ? 0 : 1;
}

}  // namespace
}  // namespace ssphh::probe

int main(int argc, char** argv) {
  ssphh::probe::Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--endpoint" && i + 1 < argc) {
      options.endpoint = argv[++i];
    } else if (word == "--beat" && i + 1 < argc) {
      options.beat = std::atoi(argv[++i]);
    } else if (word == "--only" && i + 1 < argc) {
      options.only = argv[++i];
    } else if (word == "--" && i + 1 < argc) {
      options.command.assign(argv + i + 1, argv + argc);
      break;
    } else {
      std::fprintf(
          stderr,
          "usage: mdp_probe [--endpoint ENDPOINT] [--only rules|times] [--beat MS] [-- COMMAND...]\n");
      return 2;
    }
  }
  return ssphh::probe::run(options);
}
