#pragma once
/// Broker and worker on threads of their own, on loopback, and foreign peers in raw frames.

#include <memory>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zmq.hpp>

#include <ssphh/majordomo/broker.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/majordomo/worker.h>

#include "socket.h"
#include "temp_dir.h"

namespace ssphh::majordomo::test {

class RunningBroker {
 public:
  explicit RunningBroker(
      BrokerOptions options = {}, BrokerEventSink on_event = [](const BrokerEvent&) {}) {
    if (options.bind == BrokerOptions{}.bind) options.bind = "tcp://127.0.0.1:0";
    if (options.drain == BrokerOptions{}.drain) options.drain = 2000;
    broker_ = std::make_unique<Broker>(std::move(options), std::move(on_event));
    thread_ = std::thread([this] { broker_->run(); });
  }
  ~RunningBroker() { end(); }
  void end() {
    if (!broker_) return;
    broker_->stop();
    thread_.join();
    broker_.reset();
  }
  std::string endpoint() const { return broker_->endpoint(); }
  Broker& operator*() { return *broker_; }

 private:
  std::unique_ptr<Broker> broker_;
  std::thread thread_;
};

class RunningWorker {
 public:
  RunningWorker(WorkerOptions options, Handler handler) : worker_(std::move(options)) {
    thread_ = std::thread([this, handler = std::move(handler)] { worker_.run(handler); });
  }
  ~RunningWorker() {
    worker_.abandon();
    if (thread_.joinable()) thread_.join();
  }
  Worker& operator*() { return worker_; }
  void join() { thread_.join(); }

 private:
  Worker worker_;
  std::thread thread_;
};

inline Frames echo(const Job& job) {
  return job.body;
}

/// A foreign peer.
class RawPeer {
 public:
  RawPeer(zmq::socket_type type, const std::string& endpoint) : socket_(context_, type) {
    socket_.set(zmq::sockopt::linger, 0);
    socket_.connect(endpoint);
  }
  void send(const Frames& frames) {
    while (send_message(socket_, nullptr, frames, nullptr) != Sent::yes)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  /// The next message within five seconds, HEARTBEATs of the broker aside; empty when none comes.
  Frames receive(Millis timeout = 5000) {
    for (const Millis end = steady_now() + timeout; steady_now() < end;) {
      zmq::pollitem_t item{socket_.handle(), 0, ZMQ_POLLIN, 0};
      zmq::poll(&item, 1, std::chrono::milliseconds(20));
      auto message = receive_message(socket_);
      if (!message) continue;
      if (message->frames == Frames{"", "MDPW01", "\x04"} || message->frames == Frames{"MDPW02", "\x05"})
        continue;
      return message->frames;
    }
    return {};
  }

 private:
  zmq::context_t context_;
  zmq::socket_t socket_;
};

}  // namespace ssphh::majordomo::test
