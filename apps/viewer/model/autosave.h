#pragma once
/// Work that no file of the user's has, kept beside for the case that the session ends without its question:
/// by a crash, a cut of power or a signal.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/probes/probe_file.h>

#include "document.h"

namespace ssphh::viewer {

/// What is kept of a session: a manifest NAME.json, and beside it NAME.glb, the scene as edited, NAME.sphl,
/// the probes of a bake, or both.
struct Kept {
  std::filesystem::path name;  ///< without an ending
  std::string source;          ///< the document's, by lasting_name()
  std::string file;            ///< Document::file
  std::string when;            ///< local time, "2026-03-01 17:05"
  bool scene = false, probes = false;

  std::filesystem::path with_ending(const char* ending) const { return name.string() + ending; }
};

/// Throws Error where the manifest is broken.
Kept read_kept(const std::filesystem::path& manifest);
/// Writes both files, then the manifest, each whole or not at all. Null: that file is taken away.
void write_kept(const Kept& kept, const Document* scene, const probes::ProbeSet* probes);

/// One session's names in the folder. A lock that ends with the process tells what belongs to a session that
/// is still there.
class Autosave {
 public:
  /// An empty path: nothing is kept, and nothing was.
  explicit Autosave(std::filesystem::path folder);
  ~Autosave();
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  bool keeps() const { return !folder_.empty(); }
  /// What sessions that are gone left, the newest first; of this scene alone where a source is given. What
  /// cannot be read is left out.
  std::vector<Kept> left(const std::string& source = {}) const;
  /// The name under which this document's work is kept; taken at the first call. Throws Error where the
  /// folder cannot be made or written to.
  const std::filesystem::path& name_for(const std::string& source);
  /// Goes on under the name of what an earlier session left: it stays until drop(). False: another session
  /// has it meanwhile.
  bool adopt(const Kept& kept);
  /// Whether there is a name, and perhaps files.
  bool has_name() const { return lock_ != nullptr; }
  /// The work is saved, or the user does not want it: its files go, and the name.
  void drop();
  /// Takes away what an earlier session left.
  void remove(const Kept& kept);

 private:
  class Lock;
  std::filesystem::path folder_, name_;
  std::unique_ptr<Lock> lock_;
};

}  // namespace ssphh::viewer
