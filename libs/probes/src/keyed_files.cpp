#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/parse_number.h>
#include <ssphh/probes/keyed_files.h>
#include <ssphh/probes/probe_file.h>

namespace ssphh::probes {

namespace {

bool is_probe_name(const std::string& name) {
  return name.ends_with(".sphl") || name.ends_with(".json") || name.ends_with(".tiles");
}

/// Where the key that begins there ends: at a comma behind its name or its time, not at one within its name.
std::size_t key_end(const std::string& text, std::size_t begin) {
  for (std::size_t end = text.find(',', begin); end != std::string::npos; end = text.find(',', end + 1)) {
    const std::string key = text.substr(begin, end - begin);
    if (is_probe_name(key) || is_probe_name(key.substr(0, key.rfind('@')))) return end;
  }
  return text.size();
}

}  // namespace

std::vector<ProbeKey> read_probe_keys(const std::string& text) {
  std::vector<ProbeKey> keys;
  for (std::size_t begin = 0;; ++begin) {
    const std::size_t end = key_end(text, begin);
    ProbeKey key{text.substr(begin, end - begin), {}};
    const std::size_t sign = key.file.rfind('@');
    if (sign != std::string::npos && !is_probe_name(key.file)) {
      key.time = parse_number<float>(std::string_view(key.file).substr(sign + 1));
      if (!key.time) throw Error(key.file, "has no time after its @", "write FILE@SECONDS, as door.sphl@0.5");
      key.file.resize(sign);
    }
    probe_file_format(key.file);
    keys.push_back(std::move(key));
    if (end == text.size()) return keys;
    begin = end;
  }
}

std::vector<KeyedSet> read_keyed_sets(const std::vector<ProbeKey>& keys) {
  std::vector<KeyedSet> sets;
  for (const ProbeKey& key : keys) {
    ProbeSet set = read_probe_file(key.file);
    const float time = key.time.value_or(set.generator.time);
    const auto same = std::ranges::find(sets, time, &KeyedSet::time);
    if (same != sets.end())
      throw Error(key.file, fmt::format("is a key at {:g} s, as another is", time),
                  "give keys their times: FILE@SECONDS,FILE@SECONDS");
    if (!sets.empty()) {
      try {
        blend(sets.front().set, set, 0.5f);
      } catch (const Error& e) {
        throw Error(fmt::format("{}, {}", keys.front().file, key.file), e.problem(), e.hint());
      }
    }
    sets.push_back({time, std::move(set)});
  }
  std::ranges::sort(sets, {}, &KeyedSet::time);
  return sets;
}

}  // namespace ssphh::probes
