#include "engine/input_queue.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace engine {
namespace {

/// True for keys that change the meaning of other keys while they are down. Shift is not among them, because characters
/// come with Shift applied.
bool is_modifier(int key) {
  constexpr int all[]{GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_KEY_LEFT_ALT,
                      GLFW_KEY_RIGHT_ALT,    GLFW_KEY_LEFT_SUPER,    GLFW_KEY_RIGHT_SUPER};
  return std::ranges::find(all, key) != std::end(all);
}

/// True for keys that type no character, such as Enter, Backspace and the arrows. They act on the characters before
/// them and can change where later characters go.
bool is_function_key(int key) {
  return key >= GLFW_KEY_ESCAPE && !is_modifier(key) && key != GLFW_KEY_LEFT_SHIFT && key != GLFW_KEY_RIGHT_SHIFT;
}

bool contains(const std::vector<int>& keys, int key) { return std::ranges::find(keys, key) != keys.end(); }

}  // namespace

std::vector<InputEvent> InputQueue::take() {
  if (std::exchange(skip_frame_, false)) return {};
  std::vector<InputEvent> taken, later;
  std::vector<int> pressed, released;  // keys taken
  bool button_taken = false, modifier_taken = false;
  bool typed = false;          // a character, or a key that is no modifier, is taken
  bool receiver_known = true;  // of the next key or character
  auto next = events_.begin();
  for (; next != events_.end(); ++next) {
    if (const auto* b = std::get_if<ButtonEvent>(&*next)) {
      if (std::exchange(button_taken, true)) break;
      if (b->down) receiver_known = false;
    } else if (!receiver_known) {
      break;
    }
    typed = typed || std::holds_alternative<CharacterEvent>(*next);
    if (const auto* k = std::get_if<KeyEvent>(&*next)) {
      if (is_modifier(k->key) && (typed || (modifier_taken && k->action == GLFW_RELEASE))) break;
      if (k->action == GLFW_PRESS) {
        if (contains(released, k->key) || (is_function_key(k->key) && typed)) break;
        pressed.push_back(k->key);
        (is_modifier(k->key) ? modifier_taken : typed) = true;
        if (is_function_key(k->key)) receiver_known = false;
        skip_frame_ = k->key == GLFW_KEY_TAB;
      } else if (k->action == GLFW_RELEASE) {
        if (contains(pressed, k->key)) {
          later.push_back(*next);  // the key stays down for one frame; later events need not wait for it
          continue;
        }
        released.push_back(k->key);
      }
    }
    taken.push_back(*next);
  }
  later.insert(later.end(), next, events_.end());
  events_ = std::move(later);
  return taken;
}

}  // namespace engine
