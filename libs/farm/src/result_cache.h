#pragma once
/// Results of single units in a DiskCache.

#include <ssphh/core/log.h>
#include <ssphh/farm/dispatch.h>

namespace ssphh::farm {

/// None when it is not there, or of another version.
inline std::optional<JobResult> find_result(DiskCache* cache, const Hash128& key) {
  if (!cache) return std::nullopt;
  const auto bytes = cache->get(key);
  if (!bytes) return std::nullopt;
  try {
    return decode_result({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  } catch (const Error& e) {
    log_warning("{}: {}", cache->dir().string(), e.what());
    return std::nullopt;
  }
}

/// A full disk costs the cache, not the work.
inline void keep_result(DiskCache* cache, const Hash128& key, const JobResult& result) {
  if (!cache) return;
  const std::string body = encode_result(result, ContentType::binary);
  try {
    cache->put(key, std::as_bytes(std::span(body)));
  } catch (const Error& e) {
    log_warning("a result is not kept: {}", e.what());
  }
}

}  // namespace ssphh::farm
