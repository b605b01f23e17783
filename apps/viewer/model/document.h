#pragma once
/// The scene that is open, what was changed in it, and when it is shown.

#include <filesystem>
#include <memory>

#include "edits.h"
#include "history.h"
#include "view_camera.h"

namespace ssphh::viewer {

struct Document {
  std::string source;                          ///< as the user named it
  std::shared_ptr<const scene::Scene> opened;  ///< without edits
  /// The same with the lamps that there are now, as with_lamps(); another one whenever they are others.
  std::shared_ptr<const scene::Scene> scene;
  History<Edits> history;
  std::string overlay;      ///< file that was named to lie on the source; empty: none
  bool recovered = false;   ///< `opened` holds edits of an earlier session, which no file but this scene has
  std::string file;         ///< its own, where it was saved last; empty: it has none yet
  std::uint64_t saved = 0;  ///< History::serial() of what the file has
  float time = 0;           ///< pose of the animations [s]
  float duration = 0;       ///< of the animations [s]
  scene::Bounds bounds;

  const Edits& edits() const { return history.now(); }
  /// Whether there are edits that no file has.
  bool dirty() const { return history.serial() != saved; }
  /// Whether a scene has the lamps and the surroundings of now.
  bool lamps_are_of(const scene::Scene& other) const { return has_lamps(other, *opened, edits()); }
  /// What lights the scene now, edits and time included.
  scene::LightingState lighting() const { return edited_lighting(*scene, edits(), time); }
  /// The scene with all edits done.
  scene::Scene edited() const { return edited_scene(*opened, edits(), time); }
  /// Where its SPHLs stand now; those that are switched off are left out.
  std::vector<scene::ProbePlace> places() const;
  /// As those of the history.
  bool undo() { return history.undo() && follow_lamps(); }
  bool redo() { return history.redo() && follow_lamps(); }
  /// One edit, by name for undo. See History::change for what counts as one step.
  template <class Change>
  void edit(const std::string& what, const Change& change) {
    Edits next = history.now();
    change(next);
    history.change(std::move(next), what);
    follow_lamps();
  }
  /// The same as a step of its own.
  template <class Change>
  void edit_at_once(const std::string& what, const Change& change) {
    history.seal();
    edit(what, change);
    history.seal();
  }

 private:
  /// Makes `scene` anew where lamps came, went or changed their shape; true.
  bool follow_lamps();
};

Document make_document(std::string source, scene::Scene scene, float time);

/// From the camera of that name, or the first; none has a view of everything. Focus: the middle of the scene.
/// Throws Error that lists the names there are.
View start_view(const Document& document, const std::string& camera);

/// The scene as edited, valid, with lights and SPHLs in the order of their nodes, as files have them.
scene::Scene scene_to_save(const Document& document);

/// As the file's ending says: scene_to_save() in one GLB file that loads back with the same scene_hash(), or
/// the edits alone as an overlay (model/overlay_file.h). Throws Error for other endings, and for an overlay
/// of a scene that was recovered.
void save_document(const Document& document, const std::filesystem::path& file);

}  // namespace ssphh::viewer
