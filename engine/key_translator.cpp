#include "engine/key_translator.h"

#include <GLFW/glfw3.h>

#include <cstddef>
#include <utility>
#include <variant>

namespace engine {
namespace {

// For characters of any script; isalpha() would depend on the locale.
bool is_digit(int c) { return c >= '0' && c <= '9'; }
bool is_latin_capital(int c) { return c >= 'A' && c <= 'Z'; }
int capital(unsigned int code) {
  const int c = static_cast<int>(code);
  return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c;
}

/// Returns the first byte of a key's name, letters as capitals; 0 if the key has no name.
int first_character(const char* name) { return name != nullptr ? capital(static_cast<unsigned char>(name[0])) : 0; }

bool has_latin_letters(const KeyNameLookup& name_of) {
  for (int key = GLFW_KEY_A; key <= GLFW_KEY_Z; ++key)
    if (is_latin_capital(first_character(name_of(key)))) return true;
  return false;
}

}  // namespace

KeyMeaning key_meaning(int key, const KeyNameLookup& name_of) {
  // What a keypad key types depends on Num Lock.
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_EQUAL && key != GLFW_KEY_KP_ENTER) return {0, true};
  if (key <= GLFW_KEY_SPACE || key >= GLFW_KEY_ESCAPE) return {key, false};
  if (const int c = first_character(name_of(key)); is_latin_capital(c) || is_digit(c)) return {c, false};
  return {is_digit(key) || !has_latin_letters(name_of) ? key : 0, true};
}

std::vector<KeyPress> KeyTranslator::translate(const std::vector<InputEvent>& events) {
  std::vector<KeyPress> presses;
  for (std::size_t i = 0; i < events.size(); ++i) {
    std::optional<KeyPress> press;
    if (const auto* key = std::get_if<KeyEvent>(&events[i])) {
      press = translate(*key, i + 1 < events.size() ? std::get_if<CharacterEvent>(&events[i + 1]) : nullptr);
    } else if (const auto* character = std::get_if<CharacterEvent>(&events[i])) {
      press = translate(*character);
    }
    if (press) presses.push_back(*press);
  }
  return presses;
}

std::optional<KeyPress> KeyTranslator::translate(const KeyEvent& key, const CharacterEvent* next) {
  if (key.key == GLFW_KEY_RIGHT_ALT) alt_gr_ = key.action != GLFW_RELEASE;
  if (key.action == GLFW_RELEASE) return {};
  last_ = key;
  if (alt_gr_) last_.mods |= GLFW_MOD_ALT;  // on X11, GLFW does not report AltGr
  const auto& [meant, prefers_character] = key.meaning;
  if (meant == 0 || (prefers_character && !(key.mods & GLFW_MOD_CONTROL))) return {};  // with Ctrl, keys type nothing
  // True for a digit key with Shift, a letter after a dead key, and layouts where other keys act as AltGr.
  const bool types_another = next != nullptr && meant != GLFW_KEY_SPACE && capital(next->code) != meant;
  if (types_another) return {};
  return KeyPress{meant, 0, last_.mods, key.action == GLFW_REPEAT};
}

std::optional<KeyPress> KeyTranslator::translate(const CharacterEvent& character) {
  const int c = capital(character.code);
  const bool alt = (last_.mods & GLFW_MOD_ALT) != 0;
  auto& [meant, prefers_character] = last_.meaning;
  // The event of the key has reported these already.
  if (c == ' ' || (!prefers_character && (is_latin_capital(c) || is_digit(c)))) return {};
  if (alt && is_latin_capital(c)) return {};
  // If one press types several characters, only the first has the fallback.
  const int fallback_key = prefers_character && !alt ? std::exchange(meant, 0) : 0;
  return KeyPress{c, fallback_key, last_.mods & (GLFW_MOD_SHIFT | GLFW_MOD_SUPER), last_.action == GLFW_REPEAT};
}

}  // namespace engine
