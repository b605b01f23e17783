#include "input_queue.h"

#include <algorithm>
#include <cfloat>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace ssphh::viewer {
namespace {

bool is_modifier(unsigned key) {
  return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

/// Keys that come with a character; others, as Enter and Backspace, act on text themselves.
bool types(unsigned key) {
  return key < GLFW_KEY_ESCAPE;
}

bool holds(const std::vector<unsigned>& list, unsigned number) {
  return std::ranges::find(list, number) != list.end();
}

}  // namespace

InputQueue::InputQueue() : mouse_{-FLT_MAX, -FLT_MAX} {}

void InputQueue::key(int number, bool down) {
  if (number >= 0 && number < 512)
    events_.push_back({Event::What::key, static_cast<unsigned>(number), down, 0, 0});
}

void InputQueue::button(int number, bool down) {
  if (number >= 0 && number < static_cast<int>(buttons_.size()))
    events_.push_back({Event::What::button, static_cast<unsigned>(number), down, 0, 0});
}

void InputQueue::mouse(float x, float y) {
  events_.push_back({Event::What::mouse, 0, false, x, y});
}

void InputQueue::wheel(float x, float y) {
  events_.push_back({Event::What::wheel, 0, false, x, y});
}

void InputQueue::character(unsigned code) {
  events_.push_back({Event::What::character, code, false, 0, 0});
}

bool InputQueue::fits(const Event& event, const Given& given, const ImGuiIO& io) {
  // Letters count by their characters; with Ctrl they are shortcuts there, too.
  const bool text = io.WantTextInput && !io.KeyCtrl && types(event.number);
  switch (event.what) {
    case Event::What::key:
      if (holds(given.keys, event.number)) return text;
      if (is_modifier(event.number)) return !given.press && given.buttons.empty();
      if (!event.down) return true;
      if (!given.buttons.empty()) return false;
      return text || (!given.press && !(io.WantTextInput && given.typed));
    case Event::What::button:
      return !given.moved && !holds(given.buttons, event.number);
    case Event::What::mouse:
      return given.buttons.empty();
    case Event::What::wheel:
      return true;
    case Event::What::character:
      return !given.edited;
  }
  return true;
}

void InputQueue::note(const Event& event, Given& given) {
  if (event.what == Event::What::key) {
    given.keys.push_back(event.number);
    if (event.down && !is_modifier(event.number)) given.press = true;
    if (event.down && !is_modifier(event.number) && !types(event.number)) given.edited = true;
  }
  if (event.what == Event::What::button) given.buttons.push_back(event.number);
  if (event.what == Event::What::mouse) given.moved = true;
  if (event.what == Event::What::character) given.typed = true;
}

void InputQueue::give(const Event& event, ImGuiIO& io) {
  switch (event.what) {
    case Event::What::key:
      io.KeysDown[event.number] = event.down;
      io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
      io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
      io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
      io.KeySuper = io.KeysDown[GLFW_KEY_LEFT_SUPER] || io.KeysDown[GLFW_KEY_RIGHT_SUPER];
      break;
    case Event::What::button:
      io.MouseDown[event.number] = buttons_[event.number] = event.down;
      break;
    case Event::What::mouse:
      mouse_ = {event.x, event.y};
      io.MousePos = {event.x, event.y};
      break;
    case Event::What::wheel:
      io.MouseWheelH += event.x;
      io.MouseWheel += event.y;
      break;
    case Event::What::character:
      io.AddInputCharacter(event.number);
      break;
  }
}

void InputQueue::give(ImGuiIO& io) {
  Given given;
  while (!events_.empty() && fits(events_.front(), given, io)) {
    note(events_.front(), given);
    give(events_.front(), io);
    events_.pop_front();
  }
  if (events_.empty()) return;
  // The window system's own state is already that of the end.
  io.MousePos = {mouse_[0], mouse_[1]};
  std::ranges::copy(buttons_, io.MouseDown);
}

}  // namespace ssphh::viewer
