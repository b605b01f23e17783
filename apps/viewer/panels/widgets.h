#pragma once
/// Pieces that several panels use.

#include <exception>
#include <filesystem>
#include <string>

namespace ssphh::viewer {

class App;

/// A combo box, tick box or slider for a setting by its name; `label` stands left of it.
void setting_widget(App& app, const char* label, const char* name);

/// A slider for a number setting, over a shorter range than the setting allows.
void setting_slider(App& app, const char* label, const char* name, float low, float high,
                    const char* format = "%.2f");

/// Starts a row: the label on the left, the next item fills the rest; in a narrow panel it stands below.
void row(const char* label);

/// A row with a tick box, which stands beside its label in a narrow panel, too; true when pressed.
bool tick_row(const char* label, bool* on);

/// Heading of a part of a panel.
void heading(const char* text);

/// A grey note that wraps at so many pixels of the window, or where its content ends.
void note(const std::string& text, float width = 0);

/// A button over the panel's full width; true when pressed.
bool wide_button(const char* label);

/// The button of this label, which comes next, stands in the line of the item before if it ends within `room`
/// pixels of the window; 0: those that its content has.
void beside(const char* label, float room = 0);

/// Explains the item before when the mouse rests on it.
void tip(const char* text);

/// Ends the undo step of a gesture once the item before is let go.
void seal_after_edit(App& app);

/// A row with a file's name to type.
void file_row(const char* label, char (&file)[256]);

/// A button that writes a file, `width` pixels wide as ImGui has it; true: write it now. While a press has
/// found one that is there it is called `replace`, and replaces that once it is pressed again.
bool save_button(App& app, const char* label, const char* replace, const std::filesystem::path& file,
                 float width = 0);

void complain(App& app, const char* what);

/// Runs an action; what it throws becomes a message.
template <class Action>
void attempt(App& app, const Action& action) {
  try {
    action();
  } catch (const std::exception& e) {
    complain(app, e.what());
  }
}

}  // namespace ssphh::viewer
