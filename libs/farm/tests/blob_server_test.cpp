/// A scene's parts as the broker's clients get them.

#include <gtest/gtest.h>

#include <ssphh/farm/engine.h>

#include "broker_thread.h"
#include "error_message.h"

namespace ssphh::farm {
namespace {

using ssphh::test::message_of;
using test::BrokerThread;
using test::Quiet;

std::vector<std::byte> bytes_of(std::size_t size, unsigned seed) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * i + seed);
  return bytes;
}

Blob blob_of(std::size_t size, unsigned seed) {
  Blob blob{{}, bytes_of(size, seed)};
  blob.hash = content_hash(blob.bytes);
  return blob;
}

struct BlobServing : testing::Test {
  BlobServing() {
    package.manifest = bytes_of(100, 1);
    package.id = content_hash(package.manifest);
    package.blobs = {blob_of(2000, 2)};
  }
  /// A chunk as workers ask for it.
  std::vector<std::byte> chunk(const Hash128& blob, std::uint64_t offset, std::uint64_t length) {
    return fetch_from_broker(broker.address(), nullptr)(package.id, blob, offset, length);
  }
  /// What is said to a request of another kind.
  std::string said_to(const std::string& request) {
    majordomo::ClientOptions options;
    options.endpoint = broker.address().endpoint;
    majordomo::Client client(options);
    return message_of([&] { client.call(blob_service(package.id), {request}); });
  }

  Quiet quiet;
  BrokerThread broker;
  ScenePackage package;
};

std::vector<std::byte> part(const std::vector<std::byte>& bytes, std::size_t offset, std::size_t length) {
  const auto span = std::span(bytes).subspan(offset, length);
  return {span.begin(), span.end()};
}

TEST_F(BlobServing, GivesTheManifestTheBlobsAndWhatGoesWithThem) {
  const Blob more = blob_of(300, 3);
  const BlobServer server(broker.address(), package, {more});
  EXPECT_EQ(server.bytes_sent(), 0u);
  EXPECT_EQ(chunk(package.id, 0, 100), package.manifest);
  EXPECT_EQ(chunk(package.blobs[0].hash, 0, 2000), package.blobs[0].bytes);
  EXPECT_EQ(chunk(more.hash, 0, 300), more.bytes);
  EXPECT_EQ(server.bytes_sent(), 2400u);
}

TEST_F(BlobServing, GivesAsMuchAsThereIs) {
  const BlobServer server(broker.address(), package);
  const auto& bytes = package.blobs[0].bytes;
  const Hash128 hash = package.blobs[0].hash;
  EXPECT_EQ(chunk(hash, 10, 20), part(bytes, 10, 20));
  EXPECT_EQ(chunk(hash, 1990, 20), part(bytes, 1990, 10));
  EXPECT_TRUE(chunk(hash, 2000, 1).empty());
  EXPECT_EQ(server.bytes_sent(), 30u);
  EXPECT_EQ(chunk(hash, 0, 8 << 20), bytes) << "the most that may be asked for at once";
  EXPECT_THROW(chunk(hash, 0, (8 << 20) + 1), BlobUnavailable);
  EXPECT_THROW(chunk(hash, 0, 0), BlobUnavailable);
  EXPECT_THROW(chunk(hash, 2001, 1), BlobUnavailable);
}

TEST_F(BlobServing, SaysWhatItDoesNotHaveOrUnderstand) {
  const BlobServer server(broker.address(), package);
  const std::string unknown = Hash128{1, 2}.hex();
  const auto request = [](const std::string& format, int version, const std::string& blob) {
    return fmt::format(R"({{"format":"{}","version":{},"blob":"{}","offset":0,"length":9}})", format, version,
                       blob);
  };
  const auto expect_failure = [](const std::string& said, const std::string& reason) {
    EXPECT_NE(said.find(": failed: " + test::name_of_this_process() + ": " + reason), std::string::npos)
        << said;
  };
  EXPECT_EQ(said_to(request("ssphh-blob-request", 1, package.id.hex())), "no error");
  expect_failure(said_to(request("ssphh-blob-request", 1, unknown)),
                 "blob " + unknown + ": is not of this package");
  expect_failure(said_to(request("ssphh-blob", 1, package.id.hex())),
                 "blob request: format: must be \"ssphh-blob-request\"");
  expect_failure(said_to(request("ssphh-blob-request", 2, package.id.hex())),
                 "blob request: version: the version is 2; this program reads version 1");
  expect_failure(said_to("what?"), "blob request: is not valid JSON");
  EXPECT_EQ(server.bytes_sent(), 9u);
}

}  // namespace
}  // namespace ssphh::farm
