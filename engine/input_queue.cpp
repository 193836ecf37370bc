#include "engine/input_queue.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace engine {
namespace {

/// Keys whose state gives other keys and characters another meaning.
bool is_control(int key) {
  constexpr int all[]{GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_KEY_LEFT_ALT,
                      GLFW_KEY_RIGHT_ALT,    GLFW_KEY_LEFT_SUPER,    GLFW_KEY_RIGHT_SUPER};
  return std::ranges::find(all, key) != std::end(all);
}

/// Keys that do something by themselves, to what was typed before them and for what is typed after them.
bool is_command(int key) {
  return key >= GLFW_KEY_ESCAPE && !is_control(key) && key != GLFW_KEY_LEFT_SHIFT && key != GLFW_KEY_RIGHT_SHIFT;
}

bool contains(const std::vector<int>& keys, int key) { return std::ranges::find(keys, key) != keys.end(); }

}  // namespace

std::vector<InputEvent> InputQueue::take() {
  if (std::exchange(focus_moves_, false)) return {};
  std::vector<InputEvent> told, later;
  std::vector<int> pressed, released;   // keys
  bool button = false;                  // one's change is told
  bool receiver = true;                 // of keys is known
  bool control = false, typed = false;  // a control, and another key or a character, is told
  auto next = events_.begin();
  for (; next != events_.end(); ++next) {
    if (const auto* b = std::get_if<ButtonEvent>(&*next)) {
      if (std::exchange(button, true)) break;
      if (b->down) receiver = false;
    } else if (!receiver) {
      break;
    }
    typed = typed || std::holds_alternative<CharacterEvent>(*next);
    if (const auto* k = std::get_if<KeyEvent>(&*next)) {
      if (is_control(k->key) && (typed || (control && k->action == GLFW_RELEASE))) break;
      if (k->action == GLFW_PRESS) {
        if (contains(released, k->key) || (is_command(k->key) && typed)) break;
        pressed.push_back(k->key);
        (is_control(k->key) ? control : typed) = true;
        if (is_command(k->key)) receiver = false;
        focus_moves_ = k->key == GLFW_KEY_TAB;
      } else if (k->action == GLFW_RELEASE) {
        if (contains(pressed, k->key)) {
          later.push_back(*next);  // down for one frame; the rest need not wait
          continue;
        }
        released.push_back(k->key);
      }
    }
    told.push_back(*next);
  }
  later.insert(later.end(), next, events_.end());
  events_ = std::move(later);
  return told;
}

}  // namespace engine
