#include <set>

#include "checks.h"
#include "peer.h"

namespace ssphh::probe {
namespace {

bool old_round_trip(const std::string& e) {
  Worker01 worker(e, "p.old");
  Peer client(e);
  client.send(request01("p.old", {"a", "", "b"}));
  if (!worker.job() || worker.body != Frames{"a", "", "b"}) return false;
  worker.reply({"x", "y"});
  return client.receive() == Frames{"", "MDPC01", "p.old", "x", "y"};
}

bool new_round_trip(const std::string& e) {
  Worker02 worker(e, "p.new");
  Peer client(e);
  client.send(request02("p.new", {"a"}));
  if (!worker.job()) return false;
  worker.partial({"1"});
  worker.partial({"2"});
  worker.final({"3"});
  return client.receive() == Frames{"MDPC02", "\x02", "p.new", "1"} &&
         client.receive() == Frames{"MDPC02", "\x02", "p.new", "2"} &&
         client.receive() == Frames{"MDPC02", "\x03", "p.new", "3"};
}

bool folded(const std::string& e) {
  Worker02 worker(e, "p.fold");
  Peer client(e);
  client.send(request01("p.fold", {"a"}));
  if (!worker.job()) return false;
  worker.partial({"1"});
  worker.final({"2"});
  return client.receive() == Frames{"", "MDPC01", "p.fold", "1", "2"};
}

bool final_of_old(const std::string& e) {
  Worker01 worker(e, "p.final");
  Peer client(e);
  client.send(request02("p.final", {"a"}));
  if (!worker.job()) return false;
  worker.reply({"1"});
  return client.receive() == Frames{"MDPC02", "\x03", "p.final", "1"};
}

bool queues(const std::string& e) {
  Peer client(e);
  client.send(request01("p.queue", {"a"}));
  pause(300);
  Worker01 worker(e, "p.queue");
  return worker.job();
}

bool one_at_a_time(const std::string& e) {
  Worker01 worker(e, "p.one");
  Peer client(e);
  client.send(request01("p.one", {"1"}));
  client.send(request01("p.one", {"2"}));
  if (!worker.job() || !worker.receive_command(Milliseconds(300)).empty()) return false;
  worker.reply({"x"});
  return worker.job();
}

bool least_recently_used(const std::string& e) {
  Worker01 a(e, "p.lru");
  pause(50);
  Worker01 b(e, "p.lru");
  pause(50);
  Peer client(e);
  for (Worker01* worker : {&a, &b, &a, &b}) {
    client.send(request01("p.lru", {"x"}));
    if (!worker->job()) return false;
    worker->reply({"y"});
    if (client.receive().empty()) return false;
  }
  return true;
}

bool second_ready(const std::string& e) {
  Worker01 worker(e, "p.ready");
  worker.send({"", "MDPW01", "\x01", "p.ready"});
  return worker.receive_command() == disconnect01;
}

bool second_reply(const std::string& e) {
  Worker01 worker(e, "p.twice");
  Peer client(e);
  client.send(request01("p.twice", {"a"}));
  if (!worker.job()) return false;
  worker.reply({"1"});
  worker.reply({"2"});
  return client.receive() == Frames{"", "MDPC01", "p.twice", "1"} &&
         client.receive(Milliseconds(300)).empty() && worker.receive_command() == disconnect01;
}

bool spoofing(const std::string& e) {
  Worker01 honest(e, "p.spoof"), liar(e, "p.liar");
  Peer client(e), other(e);
  client.send(request01("p.spoof", {"a"}));
  other.send(request01("p.liar", {"b"}));
  if (!honest.job() || !liar.job()) return false;
  std::swap(liar.address, honest.address);
  liar.address[liar.address.size() / 2] = static_cast<char>(liar.address[liar.address.size() / 2] ^ 1);
  liar.reply({"lie"});
  return client.receive(Milliseconds(300)).empty();
}

bool mmi_follows(const std::string& e) {
  if (!mmi_status(e, "p.mmi", "404")) return false;
  Worker01 worker(e, "p.mmi");
  if (!mmi_status(e, "p.mmi", "200", 50)) return false;
  worker.send(disconnect01);
  return mmi_status(e, "p.mmi", "404", 50);
}

bool mmi_not_implemented(const std::string& e) {
  Peer client(e);
  client.send(request01("mmi.nonsense", {"x"}));
  return client.receive() == Frames{"", "MDPC01", "mmi.nonsense", "501"};
}

bool mmi_after_death(const std::string& e) {
  {
    Worker01 worker(e, "p.dead");
    if (!mmi_status(e, "p.dead", "200", 50)) return false;
  }
  return mmi_status(e, "p.dead", "404", 100);
}

bool idle_worker_dies(const std::string& e) {
  {
    Worker01 worker(e, "p.idledead");
    pause(200);
  }
  Peer client(e);
  client.send(request01("p.idledead", {"a"}));
  Worker01 second(e, "p.idledead");
  return second.job(Milliseconds(4000));
}

bool busy_worker_dies(const std::string& e) {
  Peer client(e);
  {
    Worker01 worker(e, "p.busydead");
    client.send(request01("p.busydead", {"a"}));
    if (!worker.job()) return false;
  }
  Worker01 second(e, "p.busydead");
  if (!second.job(Milliseconds(4000))) return false;
  second.reply({"b"});
  return client.receive() == Frames{"", "MDPC01", "p.busydead", "b"};
}

bool busy_worker_disconnects(const std::string& e) {
  Peer client(e);
  Worker01 worker(e, "p.leave");
  client.send(request01("p.leave", {"a"}));
  if (!worker.job()) return false;
  worker.send(disconnect01);
  Worker01 second(e, "p.leave");
  return second.job(Milliseconds(4000));
}

bool reconnected_worker_answers(const std::string& e) {
  Peer client(e);
  std::string address;
  {
    Worker02 worker(e, "p.moved");
    client.send(request02("p.moved", {"a"}));
    if (!worker.job()) return false;
    address = worker.address;
  }
  Worker02 again(e, "p.elsewhere");
  again.address = address;
  again.final({"late"});
  return client.receive() == Frames{"MDPC02", "\x03", "p.moved", "late"};
}

bool impatient_client(const std::string& e) {
  Worker01 worker(e, "p.slow");
  pause(100);  // the first to be ready is the first to work
  Worker01 spare(e, "p.slow");
  pause(100);
  {
    Peer client(e);
    client.send(request01("p.slow", {"a"}));
    if (!worker.job() && !spare.job()) return false;
  }
  pause(200);
  Peer again(e);
  again.send(request01("p.slow", {"a"}));
  if (spare.receive_command(Milliseconds(500)) != Frames{}) return false;
  worker.reply({"once"});
  return again.receive() == Frames{"", "MDPC01", "p.slow", "once"};
}

bool vanished_client(const std::string& e) {
  {
    Peer client(e);
    for (int i = 0; i < 5; ++i) client.send(request01("p.vanish", {"a"}));
    pause(300);
  }
  pause(500);
  Worker01 worker(e, "p.vanish");
  return !worker.job(Milliseconds(500));
}

bool slow_reader(const std::string& e) {
  constexpr int count = 3000;
  Peer client(e);
  std::thread serve([&] {
    Worker01 worker(e, "p.reader");
    for (int i = 0; i < count && worker.job(Milliseconds(5000)); ++i) worker.reply(worker.body);
    pause(300);
  });
  for (int i = 0; i < count; ++i)
    client.send(request01("p.reader", {std::to_string(i), std::string(1000, 'x')}));
  serve.join();
  std::set<std::string> seen;
  for (int i = 0; i < count; ++i)
    if (const Frames reply = client.receive(); reply.size() == 5) seen.insert(reply[3]);
  return seen.size() == count;
}

bool fairness(const std::string& e) {
  Peer greedy(e), modest(e);
  for (int i = 0; i < 20; ++i) greedy.send(request01("p.fair", {"greedy"}));
  pause(200);
  modest.send(request01("p.fair", {"modest"}));
  pause(200);
  Worker01 worker(e, "p.fair");
  for (int i = 0; i < 3; ++i) {
    if (!worker.job()) return false;
    if (worker.body == Frames{"modest"}) return true;
    worker.reply({"x"});
  }
  return false;
}

}  // namespace

std::vector<Check> rules() {
  return {
      {"request and reply of 0.1, frames kept", "7/MDP", old_round_trip},
      {"PARTIALs and FINAL of 0.2", "18/MDP", new_round_trip},
      {"0.1 client of a 0.2 worker: PARTIALs folded", "both", folded},
      {"0.2 client of a 0.1 worker: REPLY is FINAL", "both", final_of_old},
      {"requests wait for a worker", "7/MDP", queues},
      {"one request per worker at a time", "7/MDP", one_at_a_time},
      {"least recently used worker first", "7/MDP", least_recently_used},
      {"second READY: DISCONNECT", "7/MDP", second_ready},
      {"second REPLY: not delivered, DISCONNECT", "7/MDP", second_reply},
      {"mmi.service follows READY and DISCONNECT", "8/MMI", mmi_follows},
      {"other mmi. services: 501", "8/MMI", mmi_not_implemented},
      {"mmi.service after a worker's death: 404", "8/MMI", mmi_after_death},
      {"a worker cannot answer for another", "dependable", spoofing},
      {"idle worker dies: nothing is sent to it", "dependable", idle_worker_dies},
      {"busy worker dies: its job runs elsewhere", "dependable", busy_worker_dies},
      {"busy worker disconnects: its job runs elsewhere", "dependable", busy_worker_disconnects},
      {"answer from a new connection is taken", "dependable", reconnected_worker_answers},
      {"client asks again on a new socket: one computation", "dependable", impatient_client},
      {"queued requests of vanished clients are dropped", "dependable", vanished_client},
      {"slow reader gets every reply", "dependable", slow_reader},
      {"clients take turns", "dependable", fairness},
  };
}

}  // namespace ssphh::probe
