#pragma once
/// What the user is asked, and what may be answered.

#include <string>

#include "autosave.h"

namespace ssphh::viewer {

/// What the user is asked before edits or a bake are lost, where an earlier session left some, and of files
/// that are doubtful.
struct Question {
  enum class Then { nothing, close, open, recover, reload, take_probes } then = Then::nothing;
  std::string source;     ///< to open
  Kept kept;              ///< to recover
  std::string problem{};  ///< of the probes of `source`, which are of another scene
};
enum class Answer { save, discard, stay, recover };

}  // namespace ssphh::viewer
