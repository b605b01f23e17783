#include "read_profile.h"

#include <ssphh/core/error.h>
#include <ssphh/scene_io/ies.h>

namespace ssphh::scene_io {

scene::LampProfile read_profile(const json::Cursor& object, const FileOf& file_of) {
  object.only({"file", "ies", "name"});
  const auto file = object.find("file"), text = object.find("ies");
  if (file.has_value() == text.has_value()) object.fail("needs either \"file\" or \"ies\"");
  scene::LampProfile profile;
  if (file) {
    profile = read_ies(file_of(*file));
  } else {
    profile.table =
        std::make_shared<const scene::PhotometricTable>(ies_from_text(text->text(), text->place()));
  }
  profile.name = object.text_or("name", profile.name);
  return profile;
}

}  // namespace ssphh::scene_io
