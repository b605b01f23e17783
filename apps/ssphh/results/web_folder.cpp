#include "results/web_folder.h"

#include <algorithm>
#include <random>
#include <set>

#include <fmt/format.h>
#include <unistd.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>

namespace ssphh::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_below(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) names.push_back(entry.path().lexically_relative(folder).generic_string());
  std::ranges::sort(names);
  return names;
}

/// The files that an earlier run wrote; empty for a folder of somebody else.
std::set<std::string> written_before(const fs::path& folder) {
  std::set<std::string> names;
  try {
    const std::string where = web_manifest;
    const json::Value manifest = json::parse(read_text_file(folder / web_manifest), where);
    const json::Cursor in(manifest, where);
    if (in["format"].text() != "ssphh-web") return {};
    for (const json::Cursor& file : json::elements(in["files"])) names.insert(file["name"].text());
    names.insert(web_manifest);
  } catch (const Error&) {
    return {};
  }
  return names;
}

/// The folder without a slash at its end: its parent and its name are asked for.
fs::path without_slash(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

fs::path unused_name(const fs::path& folder) {
  std::random_device random;
  return fmt::format("{}.{:08x}.part", folder.string(), random());
}

}  // namespace

std::vector<FolderFile> read_page(const fs::path& page) {
  if (!fs::is_regular_file(page / "index.html"))
    throw Error(page.string(), "does not hold the page that shows scenes",
                "with nodejs and npm (scripts/install-deps) and the package registry in reach, "
                "`cmake --build BUILD --target web_page` makes it; --page names another folder");
  std::vector<FolderFile> files;
  for (const std::string& name : names_below(page)) files.push_back({name, read_file(page / name)});
  return files;
}

void check_folder(const fs::path& folder, bool replace) {
  const std::string where = "--output " + folder.string();
  const fs::path path = without_slash(folder), parent = path.parent_path();
  if (!fs::is_directory(parent))
    throw Error(where, fmt::format("{} is not a folder", parent.string()), "make it first");
  if (::access(parent.c_str(), W_OK | X_OK) != 0)
    throw Error(where, fmt::format("{} cannot be written to", parent.string()), "choose another place");
  if (!fs::exists(path)) return;
  if (!fs::is_directory(path)) throw Error(where, "is a file", "name a folder");
  if (replace) return;
  const std::set<std::string> ours = written_before(path);
  for (const std::string& name : names_below(path)) {
    if (!ours.contains(name))
      throw Error(where, fmt::format("holds {}, which `ssphh web` did not write", name),
                  "name another folder, or add --replace to remove all that is in it");
  }
}

void write_folder(const fs::path& folder, const std::vector<FolderFile>& files, bool replace) {
  check_folder(folder, replace);  // much may have come into it meanwhile
  const fs::path path = without_slash(folder), fresh = unused_name(path), old = unused_name(path);
  std::error_code ignored;
  try {
    for (const FolderFile& file : files) {
      fs::create_directories((fresh / file.name).parent_path());
      write_file(fresh / file.name, file.data);
    }
    const bool there = fs::exists(path);
    if (there) fs::rename(path, old);
    try {
      fs::rename(fresh, path);
    } catch (...) {
      if (there) fs::rename(old, path);
      throw;
    }
  } catch (const fs::filesystem_error& error) {
    fs::remove_all(fresh, ignored);
    throw Error(folder.string(), "cannot be written: " + error.code().message());
  } catch (...) {
    fs::remove_all(fresh, ignored);
    throw;
  }
  fs::remove_all(old, ignored);
}

}  // namespace ssphh::app
