#pragma once
// Translates keys into shortcuts, in any keyboard layout:
// - A key labelled with a Latin letter or a digit means this letter or digit. A key that types nothing means
//   itself, and so does Space.
// - Every other key means the character that it types, also with Shift or AltGr, because signs are on different keys in
//   different countries.
// - If that character is no shortcut, a digit key means its digit (French keyboards type digits only with Shift). In a
//   layout without Latin letters (Russian), a key then means the same as on a US keyboard.

#include <functional>
#include <optional>
#include <vector>

#include "engine/input_queue.h"

namespace engine {

/// A key that goes down or repeats, or the character that it types. Letters are capitals: 'Q' is GLFW_KEY_Q.
struct KeyPress {
  int key;           // GLFW_KEY_*, or the character
  int fallback_key;  // GLFW_KEY_*: what counts if `key` is no shortcut; 0: nothing
  int mods;          // GLFW_MOD_*, AltGr as GLFW_MOD_ALT; for a character only Shift and Super
  bool repeat;
};

/// Returns what a key types without Shift, as glfwGetKeyName() does: UTF-8, nullptr for nothing.
using KeyNameLookup = std::function<const char*(int key)>;

/// Returns the meaning of the key GLFW_KEY_* in the layout with these names.
KeyMeaning key_meaning(int key, const KeyNameLookup& name_of);

class KeyTranslator {
 public:
  /// Returns the key presses among the events of one frame. The character of a key may come in a later frame, because
  /// an input method can answer late.
  std::vector<KeyPress> translate(const std::vector<InputEvent>& events);

 private:
  std::optional<KeyPress> translate(const KeyEvent& key, const CharacterEvent* next);
  std::optional<KeyPress> translate(const CharacterEvent& character);

  KeyEvent last_{};  // the key that types the next character
  bool alt_gr_ = false;
};

}  // namespace engine
