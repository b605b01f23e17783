#pragma once
/// What a broker accepts from peers, and its clocks. Defaults suit a farm of some thousand workers.

#include <cstddef>

#include <ssphh/majordomo/frames.h>

namespace ssphh::majordomo {

/// Whatever is over a limit is dropped or refused with a counted, logged reason; own clients are told `busy`
/// and try again, foreign ones hear nothing, for their protocol has no word for it.
struct BrokerLimits {
  std::size_t frame_bytes = std::size_t{64} << 20;  ///< of one frame; the socket cuts the peer off beyond it
  std::size_t message_frames = 64;                  ///< of one message
  std::size_t message_bytes = std::size_t{256} << 20;
  std::size_t service_name_bytes = 255;              ///< printable ASCII only
  std::size_t services = 4096;                       ///< known at one time
  std::size_t peers = 65536;                         ///< remembered at one time
  std::size_t queued_requests = 1'000'000;           ///< of all clients
  std::size_t queued_bytes = std::size_t{4} << 30;   ///< of all clients
  std::size_t client_requests = 200'000;             ///< of one client
  std::size_t client_bytes = std::size_t{2} << 30;   ///< of one client
  std::size_t reply_bytes = std::size_t{256} << 20;  ///< of all PARTIALs and the FINAL of one request
  std::size_t outbox_bytes = std::size_t{512}
                             << 20;  ///< waiting for one slow peer; beyond it the peer is dropped
  std::size_t record_bytes = std::size_t{256} << 20;  ///< finished replies kept for clients that ask again
  std::size_t stored_bytes = std::size_t{16} << 30;   ///< persistent requests and results on disk
  std::size_t parked_jobs = 1000;                     ///< set aside; the oldest are forgotten first
  std::size_t parked_bytes = std::size_t{256} << 20;  ///< of their bodies
  double messages_per_second = 200'000;               ///< of one peer, with a burst of as many; 0: unlimited
  int attempts = 3;  ///< workers that a job may take down or time out on before it is parked
};

/// All in milliseconds.
struct BrokerTimers {
  Millis heartbeat = 2500;  ///< to each worker that was sent nothing else, 1 at least; workers beat as often
  Millis worker_expiry = 8000;      ///< of silence; at least three heartbeats
  Millis request_expiry = 600'000;  ///< of a foreign client's request that no worker ever took
  Millis retry_backoff = 100;       ///< before the second attempt; doubles with each further one
  Millis retry_backoff_max = 10'000;
  Millis attempt_timeout = 3'600'000;  ///< of one attempt on one worker, unless the request says otherwise
  Millis record = 60'000;              ///< how long a finished reply is kept for a client that asks again
  Millis stored_result = 7 * 86'400'000LL;  ///< how long a stored result waits to be fetched
  Millis service_idle = 600'000;            ///< a service without workers and requests is forgotten
  Millis straggler_least = 1000;            ///< attempts younger than this are never stragglers
  Millis client_grace = 10'000;   ///< how long requests of an own client wait for it to connect again
  double straggler = 1.5;         ///< an attempt over this many medians is a straggler
  double straggler_after = 0.75;  ///< and is run twice when this share of its client's requests is done
};

}  // namespace ssphh::majordomo
