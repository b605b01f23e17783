#include "file_browser.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::viewer {
namespace fs = std::filesystem;
namespace {

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

bool begins(const std::string& name, const std::string& text) {
  return lower(name).starts_with(lower(text));
}

/// What is typed up to its last slash, and the rest.
std::pair<std::string, std::string> parts(const std::string& typed) {
  const std::size_t slash = typed.rfind('/');
  if (slash == std::string::npos) return {"", typed};
  return {typed.substr(0, slash + 1), typed.substr(slash + 1)};
}

}  // namespace

FileBrowser::FileBrowser(const fs::path& folder, std::vector<std::string> endings, std::string name)
    : endings_(std::move(endings)), name_(name), typed_(std::move(name)), typed_last_(!typed_.empty()) {
  std::error_code ignored;
  fs::path at = fs::absolute(folder, ignored).lexically_normal();
  while (!list(at).readable && at != at.parent_path()) at = at.parent_path();
  folder_ = at;
  entries_ = list(at).entries;
}

FileBrowser::Listing FileBrowser::list(const fs::path& folder) const {
  Listing out;
  std::error_code error;
  fs::directory_iterator at(folder, error);
  out.readable = !error;
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    Entry entry{at->path().filename().string()};
    if (entry.name.starts_with('.')) continue;
    std::error_code ignored;
    entry.folder = at->is_directory(ignored);
    const std::string name = lower(entry.name);
    if (entry.folder ||
        std::ranges::any_of(endings_, [&](const std::string& end) { return name.ends_with(end); }))
      out.entries.push_back(std::move(entry));
  }
  std::ranges::sort(out.entries, [](const Entry& a, const Entry& b) {
    if (a.folder != b.folder) return a.folder;
    const std::string x = lower(a.name), y = lower(b.name);
    return x != y ? x < y : a.name < b.name;
  });
  return out;
}

fs::path FileBrowser::whole(const std::string& text) const {
  const char* home = std::getenv("HOME");
  if (home && (text == "~" || text.starts_with("~/")))
    return (fs::path(home) / text.substr(std::min<std::size_t>(2, text.size()))).lexically_normal();
  return (folder_ / text).lexically_normal();
}

void FileBrowser::enter(const fs::path& folder) {
  Listing listing = list(folder);
  if (!listing.readable) throw Error(folder.string(), "this folder cannot be read");
  folder_ = folder;
  // "/rooms/" of what was typed has no name after its last slash.
  if (!folder_.has_filename() && folder_.has_parent_path()) folder_ = folder_.parent_path();
  entries_ = std::move(listing.entries);
  selected_ = -1;
  typed_ = name_;
  typed_last_ = !name_.empty();
}

void FileBrowser::move(int by) {
  const int last = static_cast<int>(entries_.size()) - 1;
  if (last >= 0) select(selected_ < 0 ? 0 : std::clamp(selected_ + by, 0, last));
}

void FileBrowser::select(int index) {
  selected_ = index;
  typed_last_ = false;
  const Entry& entry = entries_.at(static_cast<std::size_t>(index));
  // Whoever saves may take another file's name; whoever opens sees the mark.
  if (!name_.empty() && !entry.folder) typed_ = name_ = entry.name;
}

void FileBrowser::type(const std::string& text) {
  typed_ = text;
  typed_last_ = true;
  const auto found =
      std::ranges::find_if(entries_, [&](const Entry& entry) { return begins(entry.name, text); });
  selected_ = text.empty() || found == entries_.end() ? -1 : static_cast<int>(found - entries_.begin());
}

void FileBrowser::complete() {
  const auto [before, rest] = parts(typed_);
  const std::vector<Entry> entries = list(before.empty() ? folder_ : whole(before)).entries;
  std::string agreed;
  int count = 0;
  bool folder = false;
  for (const Entry& entry : entries) {
    if (!begins(entry.name, rest)) continue;
    if (count++ == 0) {
      agreed = entry.name;
    } else {
      std::size_t same = 0;
      while (same < agreed.size() && same < entry.name.size() && agreed[same] == entry.name[same]) ++same;
      agreed.resize(same);
    }
    folder = entry.folder;
  }
  if (agreed.size() >= rest.size() && count > 0) type(before + agreed + (count == 1 && folder ? "/" : ""));
}

void FileBrowser::up() {
  const fs::path from = folder_;
  if (from == from.parent_path()) return;
  enter(from.parent_path());
  const std::string name = from.filename().string();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].folder && entries_[i].name == name) selected_ = static_cast<int>(i), typed_last_ = false;
  }
}

std::optional<fs::path> FileBrowser::choose() {
  std::error_code ignored;
  // Whoever opens need not type the whole name.
  const bool begun = name_.empty() && !fs::exists(whole(typed_), ignored);
  const bool marked = selected_ >= 0 && (!typed_last_ || typed_.empty() || begun);
  if (!marked && typed_.empty())
    throw Error("file", "none is chosen", "choose one in the list, or type its name");
  const fs::path path = whole(marked ? entries_[selected_].name : typed_);
  if (!fs::is_directory(path, ignored)) return path;
  enter(path);
  return {};
}

}  // namespace ssphh::viewer
