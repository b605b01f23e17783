/// The readers of jobs, results and scene manifests on arbitrary bytes: an Error or something valid. The
/// first byte chooses the reader.

#include <ssphh/core/error.h>
#include <ssphh/farm/job_codec.h>
#include <ssphh/farm/scene_package.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ssphh::farm;
  if (size == 0) return 0;
  const std::string_view body(reinterpret_cast<const char*>(data + 1), size - 1);
  try {
    switch (data[0] % 3) {
      case 0: {
        const Job job = decode_job(body);
        const std::string again = encode_job(job, ContentType::binary);
        if (encode_job(decode_job(again), ContentType::binary) != again) __builtin_trap();
        break;
      }
      case 1: {
        const std::string again = encode_result(decode_result(body), ContentType::binary);
        if (encode_result(decode_result(again), ContentType::binary) != again) __builtin_trap();
        break;
      }
      default:
        unpack_scene(std::as_bytes(std::span(body)), [](const ssphh::Hash128&, std::uint64_t bytes) {
          if (bytes > 1 << 20) throw ssphh::Error("blob", "is too large for a fuzzer");
          return std::vector<std::byte>(bytes);
        });
    }
  } catch (const ssphh::Error&) {
    return 0;
  }
  return 0;
}
