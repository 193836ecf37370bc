#include "engine/key_reader.h"

#include <GLFW/glfw3.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

namespace engine {
namespace {

// Of characters of whatever script; isalpha() asks the locale.
bool is_digit(int c) { return c >= '0' && c <= '9'; }
bool is_latin_capital(int c) { return c >= 'A' && c <= 'Z'; }
int capital(unsigned int code) {
  const int c = static_cast<int>(code);
  return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c;
}

/// The ASCII character that a key shows, letters as capitals; no such character: 0, or the first byte of another.
int shown(const char* label) { return label != nullptr ? capital(static_cast<unsigned char>(label[0])) : 0; }

bool has_latin_letters(const KeyLabel& label_of) {
  for (int key = GLFW_KEY_A; key <= GLFW_KEY_Z; ++key)
    if (is_latin_capital(shown(label_of(key)))) return true;
  return false;
}

}  // namespace

KeyMeaning meaning_of(int key, const KeyLabel& label_of) {
  // The keypad types by Num Lock.
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_EQUAL && key != GLFW_KEY_KP_ENTER) return {0, true};
  if (key <= GLFW_KEY_SPACE || key >= GLFW_KEY_ESCAPE) return {key, false};
  if (const int c = shown(label_of(key)); is_latin_capital(c) || is_digit(c)) return {c, false};
  return {is_digit(key) || !has_latin_letters(label_of) ? key : 0, true};
}

std::vector<KeyPress> KeyReader::read(const std::vector<InputEvent>& told) {
  std::vector<KeyPress> presses;
  for (std::size_t i = 0; i < told.size(); ++i) {
    std::optional<KeyPress> press;
    if (const auto* key = std::get_if<KeyEvent>(&told[i])) {
      press = press_of(*key, i + 1 < told.size() ? std::get_if<CharacterEvent>(&told[i + 1]) : nullptr);
    } else if (const auto* character = std::get_if<CharacterEvent>(&told[i])) {
      press = press_of(*character);
    }
    if (press) presses.push_back(*press);
  }
  return presses;
}

std::optional<KeyPress> KeyReader::press_of(const KeyEvent& key, const CharacterEvent* next) {
  if (key.key == GLFW_KEY_RIGHT_ALT) alt_gr_ = key.action != GLFW_RELEASE;
  if (key.action == GLFW_RELEASE) return {};
  last_ = key;
  if (alt_gr_) last_.mods |= GLFW_MOD_ALT;  // GLFW does not count AltGr on X11
  const auto& [meant, typed_first] = key.meaning;
  if (meant == 0 || (typed_first && !(key.mods & GLFW_MOD_CONTROL))) return {};  // with Ctrl nothing is typed
  // A digit key with Shift, a letter after a dead key, or one of a layout where other keys do what AltGr does.
  const bool types_other = next != nullptr && meant != GLFW_KEY_SPACE && capital(next->code) != meant;
  if (types_other) return {};
  return KeyPress{meant, 0, last_.mods, key.action == GLFW_REPEAT};
}

std::optional<KeyPress> KeyReader::press_of(const CharacterEvent& character) {
  const int c = capital(character.code);
  const bool alt = (last_.mods & GLFW_MOD_ALT) != 0;
  auto& [meant, typed_first] = last_.meaning;
  if (c == ' ' || (!typed_first && (is_latin_capital(c) || is_digit(c)))) return {};  // their keys are told already
  if (alt && is_latin_capital(c)) return {};
  const int otherwise = typed_first && !alt ? std::exchange(meant, 0) : 0;  // once, whatever else one press types
  return KeyPress{c, otherwise, last_.mods & (GLFW_MOD_SHIFT | GLFW_MOD_SUPER), last_.action == GLFW_REPEAT};
}

}  // namespace engine
