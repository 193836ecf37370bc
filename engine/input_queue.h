#pragma once
// Mouse and keyboard events of a window, in order, handed out frame by frame. Slow frames make it necessary, because
// many events then happen between two frames:
// - What is typed after a click is meant for the widget that the click selects, which is known only a frame later.
// - Dear ImGui 1.86 reads keys and buttons once a frame and misses what goes down and up between two frames.

#include <glm/vec2.hpp>
#include <variant>
#include <vector>

namespace engine {

struct ButtonEvent {
  int button;
  bool down;
  glm::vec2 position;               // of the cursor, screen coordinates
  double earliest = 0, latest = 0;  // s: the event happened between these times
};
/// What a key means to shortcuts; see key_translator.h.
struct KeyMeaning {
  int key;                 // GLFW_KEY_*; 0: none
  bool prefers_character;  // the typed character counts, and `key` only if that character is no shortcut
};
struct KeyEvent {
  int key;  // GLFW_KEY_*: the position on a US keyboard
  KeyMeaning meaning;
  int scancode, action, mods;  // as in GLFW's key callback
};
struct CharacterEvent {
  unsigned int code;  // Unicode
};
struct ScrollEvent {
  glm::dvec2 steps;
};
using InputEvent = std::variant<ButtonEvent, KeyEvent, CharacterEvent, ScrollEvent>;

class InputQueue {
 public:
  bool empty() const { return events_.empty(); }
  void push(const InputEvent& event) { events_.push_back(event); }
  /// Removes and returns the events of the next frame. At most one mouse button changes in a frame. Keys and characters
  /// follow only while it is known which widget receives them and while their order within the frame does not matter.
  std::vector<InputEvent> take();

 private:
  bool skip_frame_ = false;  // the next frame gets no events, because the focus moves in it
  std::vector<InputEvent> events_;
};

}  // namespace engine
