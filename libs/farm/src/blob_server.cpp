#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <thread>

#include <ssphh/core/log.h>
#include <ssphh/farm/blob_server.h>
#include <ssphh/farm/engine.h>
#include <ssphh/majordomo/worker.h>

#include "message.h"

namespace ssphh::farm {
namespace {

constexpr std::int64_t max_chunk = std::int64_t{8} << 20;
constexpr majordomo::Millis answer_within = 60'000;

std::string encode_request(const Hash128& blob, std::uint64_t offset, std::uint64_t length) {
  const json::Value request = {{"format", "ssphh-blob-request"},
                               {"version", 1},
                               {"blob", blob.hex()},
                               {"offset", offset},
                               {"length", length}};
  return json::print(request);
}

}  // namespace

struct BlobServer::Impl {
  ScenePackage package;
  std::vector<Blob> more;
  std::map<std::string, std::span<const std::byte>> blobs;
  std::atomic<std::uint64_t> sent{0};
  std::unique_ptr<majordomo::Worker> worker;
  std::thread thread;

  majordomo::Frames serve(const majordomo::Job& job) {
    const Message message = parse_message(job.body.at(0), "blob request");
    const Field root = message.root();
    root.expect_format("ssphh-blob-request", 1);
    const auto found = blobs.find(root["blob"].hash().hex());
    if (found == blobs.end()) throw Error("blob " + root["blob"].text(), "is not of this package");
    const auto size = static_cast<std::int64_t>(found->second.size());
    const std::int64_t offset = root["offset"].integer(0, size);
    const std::int64_t length = std::min({root["length"].integer(1, max_chunk), size - offset});
    const auto* begin = reinterpret_cast<const char*>(found->second.data()) + offset;
    sent += static_cast<std::uint64_t>(length);
    return {std::string(begin, static_cast<std::size_t>(length))};
  }
};

BlobServer::BlobServer(const BrokerAddress& broker, ScenePackage package, std::vector<Blob> more)
    : impl_(new Impl) {
  Impl& s = *impl_;
  s.package = std::move(package);
  s.more = std::move(more);
  s.blobs[s.package.id.hex()] = s.package.manifest;
  for (const auto* list : {&s.package.blobs, &s.more})
    for (const Blob& blob : *list) s.blobs[blob.hash.hex()] = blob.bytes;
  majordomo::WorkerOptions options;
  options.endpoint = broker.endpoint;
  options.security = broker.security;
  options.service = blob_service(s.package.id);
  s.worker = std::make_unique<majordomo::Worker>(options);
  s.thread = std::thread([&s] {
    try {
      s.worker->run([&s](const majordomo::Job& job) { return s.serve(job); });
    } catch (const std::exception& e) {
      log(LogLevel::error, fmt::format("scene server: {}", e.what()));
    }
  });
}

BlobServer::~BlobServer() {
  impl_->worker->abandon();
  impl_->thread.join();
}

std::uint64_t BlobServer::bytes_sent() const {
  return impl_->sent;
}

FetchChunk fetch_from_broker(const BrokerAddress& broker, const CancelToken* cancel) {
  const auto client = std::make_shared<std::unique_ptr<majordomo::Client>>();
  return [client, broker, cancel](const Hash128& package, const Hash128& blob, std::uint64_t offset,
                                  std::uint64_t length) {
    try {
      if (!*client) {
        majordomo::ClientOptions options;
        options.endpoint = broker.endpoint;
        options.security = broker.security;
        *client = std::make_unique<majordomo::Client>(options);
      }
      majordomo::RequestOptions request;
      request.deadline = request.attempt_timeout = answer_within;
      const majordomo::Frames reply = (*client)->call(
          blob_service(package), {encode_request(blob, offset, length)}, request, {nullptr, cancel});
      std::vector<std::byte> chunk(reply.at(0).size());
      if (!chunk.empty()) std::memcpy(chunk.data(), reply[0].data(), chunk.size());
      return chunk;
    } catch (const Error& e) {
      throw BlobUnavailable(e.what());
    }
  };
}

}  // namespace ssphh::farm
