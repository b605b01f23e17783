#include "autosave.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>
#include <ssphh/core/log.h>

#include "preferences.h"

namespace ssphh::viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kept_format = "ssphh-autosave";
constexpr int kept_version = 1;

void take_away(const fs::path& name) {
  std::error_code ignored;
  // The manifest first: without it the others are nothing.
  for (const char* ending : {".json", ".glb", ".sphl"}) fs::remove(name.string() + ending, ignored);
}

/// "rooms-1f2e3d4c5b6a": no two scenes share it.
std::string stem_of(const std::string& source) {
  const std::string whole = lasting_name(source);
  std::string stem = fs::path(whole.substr(whole.rfind(':') + 1)).stem().string();
  return fmt::format("{}-{}", stem.substr(0, 100), Hasher().text(whole).finish().hex().substr(0, 12));
}

}  // namespace

/// An exclusive lock on NAME.lock, which the system gives back when the process ends.
class Autosave::Lock {
 public:
  /// Null: another session has it.
  static std::unique_ptr<Lock> take(const fs::path& name) {
    const fs::path path = name.string() + ".lock";
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0) throw Error(path.string(), "cannot be written, so that nothing is kept of this session");
    struct stat held {
    }, there{};
    // Another one may have removed it since open().
    if (::flock(file, LOCK_EX | LOCK_NB) == 0 && ::fstat(file, &held) == 0 &&
        ::stat(path.c_str(), &there) == 0 && held.st_ino == there.st_ino)
      return std::unique_ptr<Lock>(new Lock(path, file));
    ::close(file);
    return nullptr;
  }
  ~Lock() {
    ::unlink(path_.c_str());
    ::close(file_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  Lock(fs::path path, int file) : path_(std::move(path)), file_(file) {}
  fs::path path_;
  int file_;
};

Kept read_kept(const fs::path& manifest) {
  const std::string where = manifest.string();
  const json::Value value = json::parse(read_text_file(manifest, 1 << 20), where);
  const json::Cursor in(value, where);
  in.expect_format(kept_format, kept_version);
  in.members({"format", "version", "source", "when", "scene", "probes"}, {"file"});
  Kept kept;
  kept.name = manifest.parent_path() / manifest.stem();
  kept.source = in["source"].text(4096);
  kept.file = in.text_or("file");
  kept.when = in["when"].text(100);
  kept.scene = in["scene"].boolean(), kept.probes = in["probes"].boolean();
  return kept;
}

void write_kept(const Kept& kept, const Document* scene, const probes::ProbeSet* probes) {
  std::error_code ignored;
  const fs::path scene_file = kept.with_ending(".glb"), probe_file = kept.with_ending(".sphl");
  if (scene) save_document(*scene, scene_file);
  if (probes) probes::write_probe_file(*probes, probe_file.string());
  const json::Value out = {{"format", kept_format},
                           {"version", kept_version},
                           {"source", kept.source},
                           {"file", kept.file},
                           {"when", fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time(nullptr)))},
                           {"scene", scene != nullptr},
                           {"probes", probes != nullptr}};
  write_file(kept.with_ending(".json"), json::print(out, 2) + "\n");
  if (!scene) fs::remove(scene_file, ignored);
  if (!probes) fs::remove(probe_file, ignored);
}

Autosave::Autosave(fs::path folder) : folder_(std::move(folder)) {}

Autosave::~Autosave() = default;

std::vector<Kept> Autosave::left(const std::string& source) const {
  std::vector<std::pair<fs::file_time_type, Kept>> found;
  std::error_code error;
  const std::string wanted = source.empty() ? "" : lasting_name(source);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    if (entry.path().extension() != ".json") continue;
    try {
      Kept kept = read_kept(entry.path());
      if (!wanted.empty() && kept.source != wanted) continue;
      if (kept.name == name_ || !Lock::take(kept.name)) continue;
      found.emplace_back(entry.last_write_time(), std::move(kept));
    } catch (const std::exception& e) {
      log_warning("{}: it cannot be recovered: {}", entry.path().string(), e.what());
    }
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Kept> out;
  for (auto& [time, kept] : found) out.push_back(std::move(kept));
  return out;
}

const fs::path& Autosave::name_for(const std::string& source) {
  if (lock_) return name_;
  std::error_code ignored;
  fs::create_directories(folder_, ignored);
  const std::string stem = stem_of(source);
  for (int n = 1; !lock_; ++n) {
    name_ = folder_ / fmt::format("{}-{}", stem, n);
    if (!fs::exists(name_.string() + ".json", ignored)) lock_ = Lock::take(name_);
  }
  return name_;
}

bool Autosave::adopt(const Kept& kept) {
  std::unique_ptr<Lock> lock = Lock::take(kept.name);
  if (!lock) return false;
  drop();
  lock_ = std::move(lock);
  name_ = kept.name;
  return true;
}

void Autosave::drop() {
  if (!lock_) return;
  take_away(name_);
  lock_.reset();
  name_.clear();
}

void Autosave::remove(const Kept& kept) {
  if (const std::unique_ptr<Lock> lock = Lock::take(kept.name)) take_away(kept.name);
}

}  // namespace ssphh::viewer
