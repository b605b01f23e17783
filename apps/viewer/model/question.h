#pragma once
/// What the user is asked, and what may be answered.

#include <string>

#include "autosave.h"

namespace ssphh::viewer {

/// What the user is asked before edits or a bake are lost, or where an earlier session left some.
struct Question {
  enum class Then { nothing, close, open, recover, reload } then = Then::nothing;
  std::string source;  ///< to open
  Kept kept;           ///< to recover
};
enum class Answer { save, discard, stay, recover };

}  // namespace ssphh::viewer
