#pragma once
/// A walk through folders to a file: what a dialog that opens or saves knows, without its drawing.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ssphh::viewer {

class FileBrowser {
 public:
  struct Entry {
    std::string name;
    bool folder = false;
  };

  /// Begins in `folder`, or where it cannot be read in the nearest one above it that can. `endings` as
  /// ".glb": other files are left out. `name`: what is typed at first, of a file that is to be written.
  FileBrowser(const std::filesystem::path& folder, std::vector<std::string> endings, std::string name = {});

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<std::string>& endings() const { return endings_; }
  /// Folders, then files, each by name; hidden ones are left out.
  const std::vector<Entry>& entries() const { return entries_; }
  /// Index of the entry that is marked; −1: none.
  int selected() const { return selected_; }
  const std::string& typed() const { return typed_; }

  /// Marks the entry that many places further down, stopping at the ends; the first where none is marked.
  void move(int by);
  void select(int index);
  /// As the user types it: a name or a path from here, from / or from ~/. Marks the first entry that begins
  /// so.
  void type(const std::string& text);
  /// Extends what is typed as far as all that could be meant agree; a slash follows a whole folder.
  void complete();
  /// To the folder above, which marks the one that it comes from.
  void up();
  /// Goes into a folder, and says so with nothing; else the path of the file that is marked or typed,
  /// whichever was touched last, whether or not there is such a file; where one is opened, its name's
  /// beginning will do. Throws Error where nothing is, or for a folder that cannot be read.
  std::optional<std::filesystem::path> choose();

 private:
  struct Listing {
    std::vector<Entry> entries;
    bool readable = false;
  };
  Listing list(const std::filesystem::path& folder) const;
  std::filesystem::path whole(const std::string& text) const;
  void enter(const std::filesystem::path& folder);

  std::filesystem::path folder_;
  std::vector<std::string> endings_;
  std::vector<Entry> entries_;
  std::string name_, typed_;
  int selected_ = -1;
  bool typed_last_ = false;
};

}  // namespace ssphh::viewer
