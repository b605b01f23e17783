/// What every format of probes reads alike (probe_codec.h), here from bytes; JSON: probe_schema_test.cpp and
/// the farm's job_codec_test.cpp.

#include <gtest/gtest.h>

#include <ssphh/probes/byte_parts.h>

#include "error_message.h"
#include "random_set.h"

namespace ssphh::probes {
namespace {

using test::message_of;
using test::random_sh;

constexpr int degree = 1;

Edge edge_from(int from, bool with_matrix) {
  Pcg32 rng(static_cast<std::uint64_t>(from));
  Edge edge{from, 0.25f, random_sh(rng, degree), {}};
  if (with_matrix) {
    edge.matrix = sh::TransferMatrix(degree, degree);
    edge.matrix.values = random_sh(rng, 3).values;  // 4 × 4, as the matrix
  }
  return edge;
}

/// Of probe 2 of ten.
std::vector<Edge> read_back(const std::vector<std::byte>& bytes) {
  ByteReader in(bytes, "bytes");
  std::vector<Edge> edges = read_edges(ByteReaderParts(in), degree, 2, 10);
  in.expect_end();
  return edges;
}

std::vector<std::byte> written(const std::vector<Edge>& edges) {
  ByteWriter out;
  write_edges(out, edges);
  return out.take();
}

std::string said_of(const std::vector<std::byte>& bytes) {
  const std::string message = message_of([&] { read_back(bytes); });
  return message.substr(message.find(": ") + 2);  // without the place
}

TEST(ProbeCodec, EdgesComeBack) {
  const std::vector<Edge> edges = {edge_from(0, true), edge_from(1, false), edge_from(9, true)};
  const std::vector<Edge> back = read_back(written(edges));
  EXPECT_EQ(back, edges);
  EXPECT_EQ(back[0].matrix.arriving_degree, degree);
  EXPECT_EQ(back[0].matrix.emitted_degree, degree);
  EXPECT_EQ(back[1].matrix.arriving_degree, -1);
}

TEST(ProbeCodec, EdgesComeFromOtherProbesInAscendingOrder) {
  const std::string wrong = "from must be another probe's index, in ascending order";
  EXPECT_EQ(said_of(written({edge_from(1, false), edge_from(1, false)})), wrong);
  EXPECT_EQ(said_of(written({edge_from(3, false), edge_from(1, false)})), wrong);
  EXPECT_EQ(said_of(written({edge_from(2, false)})), wrong) << "the probe itself";
  EXPECT_EQ(said_of(written({edge_from(10, false)})), "from is out of range");
  Edge strong = edge_from(1, false);
  strong.transfer = 1.01f;
  EXPECT_EQ(said_of(written({strong})), said_of(written({edge_from(1, false)}))) << "an SPHL that is near";
  strong.transfer = -0.01f;
  EXPECT_EQ(said_of(written({strong})), "transfer is out of range");
}

TEST(ProbeCodec, SizesAreLookedAtBeforeMemoryIsTaken) {
  std::vector<std::byte> bytes = written({edge_from(0, true)});
  ASSERT_EQ(bytes.size(), 4u + 4 + 4 + 1 + 4 * 12 + 1 + 16 * 12);
  EXPECT_EQ(said_of({bytes.begin(), bytes.end() - 1}), "matrix is cut off");
  bytes[0] = std::byte{9};
  EXPECT_EQ(said_of(bytes), "count of parts needs more bytes than the file has");
  bytes[0] = std::byte{10};
  EXPECT_EQ(said_of(bytes), "count of parts is over the limit of 9");
  bytes[0] = std::byte{1}, bytes[12] = std::byte{0};
  EXPECT_EQ(said_of(bytes), "h is out of range") << "only a matrix may be missing";
}

TEST(ProbeCodec, EmittedLightMayBeMissingAndReflectedLightMayNot) {
  Pcg32 rng(7);
  const std::vector<GroupLight> groups = {{{}, random_sh(rng, degree)},
                                          {random_sh(rng, degree), random_sh(rng, degree)}};
  ByteWriter out;
  write_groups(out, groups);
  ByteReader in(out.bytes(), "bytes");
  EXPECT_EQ(read_groups(in, degree, 2), groups);
  in.expect_end();
  const std::vector<std::byte> dark(2);
  ByteReader none(dark, "bytes");
  EXPECT_EQ(message_of([&] { read_groups(none, degree, 1); }), "bytes at byte 2: reflected is out of range");
}

}  // namespace
}  // namespace ssphh::probes
