#pragma once
/// The alphabet of bytes for probe_codec.h: parts follow each other without names, and a byte before numbers
/// tells whether there are any. Binary probe files and checkpoints. Functions may be packed, in one way in
/// all of a file.

#include <ssphh/core/bytes.h>
#include <ssphh/probes/probe_codec.h>
#include <ssphh/sh/packing.h>

namespace ssphh::probes {

class ByteWriterParts {
 public:
  explicit ByteWriterParts(ByteWriter& out, sh::Packing packing = sh::Packing::none)
      : out_(out), packing_(packing) {}

  void index(const char*, int value) { out_.value(static_cast<std::uint32_t>(value)); }
  void amount(const char*, float value) { out_.value(value); }
  void vectors(const char*, std::span<const vec3> values, Missing) {
    out_.value(static_cast<std::uint8_t>(!values.empty()));
    if (packing_ == sh::Packing::none || values.empty()) return out_.array(values);
    sh::RadianceSh function;
    function.values.assign(values.begin(), values.end());
    std::vector<std::byte> packed;
    sh::pack(function, packing_, packed);
    out_.array(std::span<const std::byte>(packed));
  }

 private:
  ByteWriter& out_;
  sh::Packing packing_;
};

class ByteReaderParts {
 public:
  explicit ByteReaderParts(ByteReader& in, sh::Packing packing = sh::Packing::none)
      : in_(in), packing_(packing) {}

  void members(std::initializer_list<std::string_view>, std::initializer_list<std::string_view>) const {}
  std::size_t size(std::size_t most, std::size_t floats_each) const {
    return in_.count("count of parts", most, floats_each * sizeof(float));
  }
  const ByteReaderParts& operator[](std::size_t) const { return *this; }
  int index(const char* name, std::size_t count) const {
    const auto value = in_.value<std::uint32_t>(name);
    if (value >= count) fail(name, "is out of range");
    return static_cast<int>(value);
  }
  float amount(const char* name) const { return in_.value_in<float>(name, 0, limits::coefficient); }
  std::vector<vec3> vectors(const char* name, std::size_t count, Missing missing) const {
    if (!in_.value_in<std::uint8_t>(name, missing == Missing::never ? 1 : 0, 1)) return {};
    if (packing_ != sh::Packing::none) {
      const int degree = sh::degree_of(count);
      return sh::unpack(in_.view(name, sh::packed_bytes(packing_, degree)), packing_, degree).values;
    }
    if (count > in_.left() / sizeof(vec3)) fail(name, "is cut off");
    std::vector<vec3> values(count);
    in_.array(name, values);
    return values;
  }
  [[noreturn]] void fail(const char* name, const std::string& problem) const { in_.fail(name, problem); }

 private:
  ByteReader& in_;
  sh::Packing packing_;
};

inline void write_groups(ByteWriter& out, const std::vector<GroupLight>& groups,
                         sh::Packing packing = sh::Packing::none) {
  for (const GroupLight& light : groups) write_light(ByteWriterParts(out, packing), light);
}
inline std::vector<GroupLight> read_groups(ByteReader& in, int degree, std::size_t count,
                                           sh::Packing packing = sh::Packing::none) {
  std::vector<GroupLight> groups(count);
  for (GroupLight& light : groups) light = read_light(ByteReaderParts(in, packing), degree);
  return groups;
}

inline void write_edges(ByteWriter& out, const std::vector<Edge>& edges) {
  out.value(static_cast<std::uint32_t>(edges.size()));
  for (const Edge& edge : edges) write_edge(ByteWriterParts(out), edge);
}

}  // namespace ssphh::probes
