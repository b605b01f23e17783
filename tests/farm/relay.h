#pragma once
/// A piece of network between a worker and the broker that can be cut, stalled and slowed down.

#include <atomic>
#include <chrono>
#include <cstring>
#include <deque>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace ssphh::test {

/// Listens on a TCP port of loopback and passes every connection on to a Unix socket.
class Relay {
 public:
  explicit Relay(std::string target) : target_(std::move(target)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listener_, 16) != 0)
      std::abort();
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    endpoint_ = "tcp://127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    thread_ = std::thread([this] { run(); });
  }
  ~Relay() {
    ended_ = true;
    thread_.join();
    ::close(listener_);
  }
  const std::string& endpoint() const { return endpoint_; }

  /// Passes nothing on in either direction, and nobody is told: a cable that was pulled out.
  void stall(bool on) { stalled_ = on; }
  /// Ends all connections; new ones are taken.
  void cut() { cut_ = true; }
  /// Every byte arrives so much later, and at most so many of them a second in each direction of a
  /// connection.
  void slow(std::chrono::milliseconds delay, double bytes_per_second) {
    delay_ms_ = delay.count(), rate_ = bytes_per_second;
  }
  std::uint64_t passed() const { return passed_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Way {
    int from, to;
    std::deque<std::pair<Clock::time_point, std::string>> flying = {};
    std::size_t waiting = 0;  ///< bytes in `flying`
    double allowance = 0;
    bool over = false;
  };
  struct Link {
    int near, far;
    Way out{near, far}, back{far, near};
  };
  static constexpr std::size_t most_waiting = 256 << 10;

  void run() {
    auto last = Clock::now();
    while (!ended_) {
      std::vector<pollfd> items = {{listener_, POLLIN, 0}};
      for (const Link& link : links_)
        items.push_back({link.near, POLLIN, 0}), items.push_back({link.far, POLLIN, 0});
      ::poll(items.data(), items.size(), stalled_ ? 0 : 2);
      if (stalled_) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      if (items[0].revents & POLLIN) accept_one();
      const auto now = Clock::now();
      const double seconds = std::chrono::duration<double>(now - last).count();
      last = now;
      const bool cut = cut_.exchange(false);
      for (auto it = links_.begin(); it != links_.end();) {
        if (!stalled_) pass(it->out, now, seconds), pass(it->back, now, seconds);
        if (cut || it->out.over || it->back.over) {
          ::close(it->near), ::close(it->far);
          it = links_.erase(it);
        } else {
          ++it;
        }
      }
    }
    for (const Link& link : links_) ::close(link.near), ::close(link.far);
  }

  void accept_one() {
    const int near = ::accept(listener_, nullptr, nullptr);
    const int far = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, target_.c_str(), sizeof address.sun_path - 1);
    if (near < 0 || ::connect(far, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      ::close(near), ::close(far);
      return;
    }
    for (const int fd : {near, far}) ::fcntl(fd, F_SETFL, O_NONBLOCK);
    links_.push_back({near, far});
  }

  void pass(Way& way, Clock::time_point now, double seconds) {
    char buffer[65536];
    while (way.waiting < most_waiting) {
      const ssize_t got = ::recv(way.from, buffer, sizeof buffer, 0);
      if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) way.over = true;
      if (got <= 0) break;
      way.flying.emplace_back(now + std::chrono::milliseconds(delay_ms_),
                              std::string(buffer, static_cast<std::size_t>(got)));
      way.waiting += static_cast<std::size_t>(got);
    }
    const double rate = rate_;
    way.allowance = std::min(way.allowance + rate * seconds, rate / 20);
    while (!way.flying.empty() && way.flying.front().first <= now && (rate <= 0 || way.allowance >= 1)) {
      std::string& bytes = way.flying.front().second;
      const std::size_t size =
          rate > 0 ? std::min(bytes.size(), static_cast<std::size_t>(way.allowance)) : bytes.size();
      const ssize_t sent = ::send(way.to, bytes.data(), size, MSG_NOSIGNAL);
      if (sent <= 0) break;
      passed_ += static_cast<std::uint64_t>(sent);
      way.allowance -= static_cast<double>(sent);
      way.waiting -= static_cast<std::size_t>(sent);
      bytes.erase(0, static_cast<std::size_t>(sent));
      if (!bytes.empty()) break;
      way.flying.pop_front();
    }
  }

  std::string target_, endpoint_;
  int listener_;
  std::list<Link> links_;
  std::atomic<bool> ended_{false}, stalled_{false}, cut_{false};
  std::atomic<std::int64_t> delay_ms_{0};
  std::atomic<double> rate_{0};
  std::atomic<std::uint64_t> passed_{0};
  std::thread thread_;
};

}  // namespace ssphh::test
