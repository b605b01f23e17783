#pragma once
/// The scene that is open, what was changed in it, and when it is shown.

#include <filesystem>
#include <memory>

#include "edits.h"
#include "history.h"
#include "view_camera.h"

namespace ssphh::viewer {

struct Document {
  std::string source;                         ///< as the user named it
  std::shared_ptr<const scene::Scene> scene;  ///< as loaded
  History<Edits> history;
  std::string file;         ///< its own, where it was saved last; empty: it has none yet
  std::uint64_t saved = 0;  ///< History::serial() of what the file has
  float time = 0;           ///< pose of the animations [s]
  float duration = 0;       ///< of the animations [s]
  scene::Bounds bounds;

  const Edits& edits() const { return history.now(); }
  /// Whether there are edits that no file has.
  bool dirty() const { return history.serial() != saved; }
  /// What lights the scene now, edits and time included.
  scene::LightingState lighting() const { return edited_lighting(*scene, edits(), time); }
  /// One edit, by name for undo. See History::change for what counts as one step.
  template <class Change>
  void edit(const std::string& what, const Change& change) {
    Edits next = history.now();
    change(next);
    history.change(std::move(next), what);
  }
  /// The same as a step of its own.
  template <class Change>
  void edit_at_once(const std::string& what, const Change& change) {
    history.seal();
    edit(what, change);
    history.seal();
  }
};

Document make_document(std::string source, scene::Scene scene, float time);

/// From the scene's camera of that name, or its first; none has a view of everything. Focus: the middle of
/// the scene.
View start_view(const Document& document, const std::string& camera);

/// The scene as edited, valid, with lights and SPHLs in the order of their nodes, as files have them.
scene::Scene scene_to_save(const Document& document);

/// scene_to_save() in one GLB file that loads back with the same scene_hash().
void save_document(const Document& document, const std::filesystem::path& file);

}  // namespace ssphh::viewer
