#pragma once
/// What the window system tells of keys and mouse, on its way to ImGui. All that happened during a slow frame
/// comes at once: it is kept in its order and given to as many frames as its presses need to be seen.

#include <array>
#include <deque>
#include <vector>

struct ImGuiIO;

namespace ssphh::viewer {

class InputQueue {
 public:
  InputQueue();

  /// GLFW's number of a key, pressed or let go; unknown ones count for nothing. ImGui itself repeats keys
  /// that are held.
  void key(int number, bool down);
  /// 0 left, 1 right, 2 middle; others count for nothing.
  void button(int number, bool down);
  /// Pixels from the upper left.
  void mouse(float x, float y);
  /// Notches to the right and forward.
  void wheel(float x, float y);
  /// Unicode.
  void character(unsigned code);

  /// Whether nothing waits for a frame.
  bool empty() const { return events_.empty(); }

  /// Gives the next frame what it can show without losing a press or its order: each key and button changes
  /// at most once, one shortcut is pressed, the mouse stays where a button changed, modifiers are those of
  /// the press. Call before ImGui::NewFrame(), after what sets the mouse as it is now.
  void give(ImGuiIO& io);

 private:
  struct Event {
    enum class What { key, button, mouse, wheel, character } what;
    unsigned number;  ///< of key or button; code of a character
    bool down;
    float x, y;
  };
  /// What the frame was given so far.
  struct Given {
    std::vector<unsigned> keys, buttons;
    bool press = false;   ///< of a key that is no modifier
    bool edited = false;  ///< such a press of a key without a character
    bool typed = false;   ///< a character
    bool moved = false;   ///< the mouse
  };
  static bool fits(const Event& event, const Given& given, const ImGuiIO& io);
  static void note(const Event& event, Given& given);
  void give(const Event& event, ImGuiIO& io);

  std::deque<Event> events_;
  // As given so far.
  std::array<float, 2> mouse_;
  std::array<bool, 3> buttons_{};
};

}  // namespace ssphh::viewer
