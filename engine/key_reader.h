#pragma once
// Which shortcut a key press means, in any layout of the keyboard:
// - A key that shows a Latin letter or a digit means that. A key that types nothing means itself, and Space does.
// - Any other key means what it types, with Shift or AltGr if need be: signs are on other keys in every country.
// - If what it types is no shortcut, a digit key still means its digit (French keyboards type digits only with Shift),
//   and in a layout without Latin letters (Russian) a key means what it means on a US keyboard.

#include <functional>
#include <optional>
#include <vector>

#include "engine/input_queue.h"

namespace engine {

/// A key that went down (or repeats), or what it typed. Letters are capitals: 'Q' as GLFW_KEY_Q.
struct KeyPress {
  int key;        // GLFW_KEY_*, or the character
  int otherwise;  // GLFW_KEY_*: what is meant if `key` is no shortcut; 0: nothing
  int mods;       // GLFW_MOD_*, AltGr as GLFW_MOD_ALT; of a character, Shift and Super alone
  bool repeat;
};

/// What a key types without Shift, as glfwGetKeyName() says it: UTF-8, nullptr for nothing.
using KeyLabel = std::function<const char*(int key)>;

/// Of the key at this place (GLFW_KEY_*), in the layout that has these labels.
KeyMeaning meaning_of(int key, const KeyLabel& label_of);

class KeyReader {
 public:
  /// The presses among the events that a frame was told of. The character that a key types may come in a later frame:
  /// an input method answers when it likes.
  std::vector<KeyPress> read(const std::vector<InputEvent>& told);

 private:
  std::optional<KeyPress> press_of(const KeyEvent& key, const CharacterEvent* next);
  std::optional<KeyPress> press_of(const CharacterEvent& character);

  KeyEvent last_{};  // the key that types what comes next
  bool alt_gr_ = false;
};

}  // namespace engine
