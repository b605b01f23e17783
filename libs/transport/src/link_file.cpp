#include "link_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ssphh/core/error.h>

namespace ssphh::transport {
namespace {

struct Header {
  char magic[8];
  std::uint32_t version, patches;
  std::uint64_t rows, links;
};
static_assert(sizeof(Header) == 32 && sizeof(Link) == 8);
constexpr char magic[] = "SPHLLINK";
constexpr std::uint32_t link_file_version = 2;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw Error(path.string(), what);
}
[[noreturn]] void fail_by_system(const std::filesystem::path& path, const char* what) {
  fail(path, fmt::format("{}: {}", what, std::strerror(errno)));
}

}  // namespace

LinkFileWriter::LinkFileWriter(std::filesystem::path path, std::size_t patches)
    : path_(std::move(path)), patches_(patches) {
  temporary_ = path_;
  temporary_ += fmt::format(".{}.part", ::getpid());
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (!file_) fail_by_system(temporary_, "cannot write");
  const Header placeholder{};
  write(&placeholder, sizeof(placeholder));
}

LinkFileWriter::~LinkFileWriter() {
  if (!file_) return;
  std::fclose(file_);
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void LinkFileWriter::write(const void* data, std::size_t bytes) {
  if (bytes && std::fwrite(data, 1, bytes, file_) != bytes) fail_by_system(temporary_, "cannot write");
}

void LinkFileWriter::add_row(std::span<const Link> links) {
  write(links.data(), links.size_bytes());
  first_.push_back(first_.back() + links.size());
}

void LinkFileWriter::finish() {
  write(first_.data(), first_.size() * sizeof(first_[0]));
  Header header{
      {}, link_file_version, static_cast<std::uint32_t>(patches_), first_.size() - 1, first_.back()};
  std::memcpy(header.magic, magic, sizeof(header.magic));
  if (std::fseek(file_, 0, SEEK_SET) != 0) fail_by_system(temporary_, "cannot write");
  write(&header, sizeof(header));
  if (std::fclose(std::exchange(file_, nullptr)) != 0) {
    const int reason = errno;
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
    errno = reason;
    fail_by_system(temporary_, "cannot write");
  }
  std::filesystem::rename(temporary_, path_);
}

void write_link_file(const LinkRows& links, const std::filesystem::path& path) {
  LinkFileWriter writer(path, links.patches);
  std::vector<Link> row;
  for (const LinkRows::Row& r : links.rows) {
    row.assign(r.fixed.begin(), r.fixed.end());
    row.insert(row.end(), r.moving.begin(), r.moving.end());
    writer.add_row(row);
  }
  writer.finish();
}

MappedLinks::MappedLinks(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail_by_system(path, "cannot open");
  struct stat info {};
  if (::fstat(file, &info) == 0) bytes_ = static_cast<std::uint64_t>(info.st_size);
  if (bytes_ >= sizeof(Header)) data_ = ::mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, file, 0);
  ::close(file);
  if (bytes_ < sizeof(Header)) fail(path, "too short for a link file");
  if (data_ == MAP_FAILED) {
    data_ = nullptr;
    fail_by_system(path, "cannot map");
  }
  ::madvise(data_, bytes_, MADV_SEQUENTIAL);
  try {
    check(path);
  } catch (...) {
    ::munmap(data_, bytes_);
    throw;
  }
}

MappedLinks::~MappedLinks() {
  ::munmap(data_, bytes_);
}

void MappedLinks::check(const std::filesystem::path& path) {
  Header header;
  std::memcpy(&header, data_, sizeof(header));
  if (std::memcmp(header.magic, magic, sizeof(header.magic)) != 0) fail(path, "no link file");
  if (header.version != link_file_version)
    fail(path, fmt::format("format version {}; this program reads {}", header.version, link_file_version));
  const std::uint64_t room = (bytes_ - sizeof(Header)) / 8;
  if (header.rows > room || header.links > room || header.rows + header.links + 1 != room ||
      (bytes_ - sizeof(Header)) % 8 != 0)
    fail(path, fmt::format("{} rows and {} links do not make {} bytes", header.rows, header.links, bytes_));

  const auto* links = reinterpret_cast<const Link*>(static_cast<const std::byte*>(data_) + sizeof(Header));
  const auto* first = reinterpret_cast<const std::uint64_t*>(links + header.links);
  if (header.patches == 0) fail(path, "its rows have no patch");
  rows_.rows.resize(header.rows);
  rows_.patches = header.patches;
  for (std::uint64_t i = 0; i < header.rows; ++i) {
    if (first[0] != 0 || first[i + 1] < first[i] || first[i + 1] > header.links)
      fail(path, fmt::format("row {} lies outside of the links", i));
    rows_.rows[i].fixed = {links + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
    for (const Link& link : rows_.rows[i].fixed) {
      if (link.patch / header.patches >= header.rows || !std::isfinite(link.weight) || link.weight < 0)
        fail(path, fmt::format("row {} links to patch {} with weight {}", i, link.patch, link.weight));
    }
  }
}

}  // namespace ssphh::transport
