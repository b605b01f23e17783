#pragma once
/// How a scene's parts get to workers: the client serves them at the broker as a worker of its own service,
/// chunk by chunk.

#include <memory>
#include <string>

#include <ssphh/farm/scene_package.h>
#include <ssphh/farm/scene_store.h>
#include <ssphh/majordomo/client.h>

namespace ssphh::farm {

/// Where the broker is, and with which keys.
struct BrokerAddress {
  std::string endpoint;
  std::optional<majordomo::PeerSecurity> security;
};

/// Serves a package and further blobs on a thread of its own until it is destroyed.
class BlobServer {
 public:
  BlobServer(const BrokerAddress& broker, ScenePackage package, std::vector<Blob> more = {});
  ~BlobServer();
  BlobServer(const BlobServer&) = delete;
  BlobServer& operator=(const BlobServer&) = delete;

  std::uint64_t bytes_sent() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Asks a package's BlobServer; for one thread. A server that does not answer in a minute is a
/// BlobUnavailable.
FetchChunk fetch_from_broker(const BrokerAddress& broker, const CancelToken* cancel);

}  // namespace ssphh::farm
