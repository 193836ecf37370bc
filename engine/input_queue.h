#pragma once
// What mouse and keyboard did in a window, in order, handed on frame by frame. What is typed after a click is for
// whoever the click chose, which shows only once a frame was told of the click; and Dear ImGui 1.86, which looks at
// keys and buttons once a frame, would miss what goes down and up between two frames. Slow frames make both usual.

#include <glm/vec2.hpp>
#include <variant>
#include <vector>

namespace engine {

struct ButtonEvent {
  int button;
  bool down;
  glm::vec2 at;                     // the cursor, screen coordinates
  double earliest = 0, latest = 0;  // s: when it may have happened
};
/// To shortcuts, in the keyboard's layout: see key_reader.h.
struct KeyMeaning {
  int key;           // GLFW_KEY_*; 0: none
  bool typed_first;  // what the key types is meant, and `key` only if that is no shortcut
};
struct KeyEvent {
  int key;  // GLFW_KEY_*, by its place on the keyboard
  KeyMeaning meaning;
  int scancode, action, mods;
};
struct CharacterEvent {
  unsigned int code;
};
struct ScrollEvent {
  glm::dvec2 steps;
};
using InputEvent = std::variant<ButtonEvent, KeyEvent, CharacterEvent, ScrollEvent>;

class InputQueue {
 public:
  bool empty() const { return events_.empty(); }
  void push(const InputEvent& event) { events_.push_back(event); }
  /// What the next frame may be told: one mouse button's change at most, and of keys and characters only those whose
  /// receiver and whose order do not matter to each other: a key that sends no character has its frame to itself.
  std::vector<InputEvent> take();

 private:
  bool focus_moves_ = false;  // in the next frame, which is to be told nothing
  std::vector<InputEvent> events_;
};

}  // namespace engine
