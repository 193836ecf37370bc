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

/// Keys that end the typing into a text field.
bool ends_typing(int key) { return key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER || key == GLFW_KEY_ESCAPE; }

}  // namespace

std::vector<InputEvent> InputQueue::take() {
  std::vector<InputEvent> told, later;
  std::vector<int> pressed;  // keys
  bool button = false;       // one's change is told
  bool receiver = true;      // of keys is known
  auto next = events_.begin();
  for (; next != events_.end(); ++next) {
    if (const auto* b = std::get_if<ButtonEvent>(&*next)) {
      if (std::exchange(button, true)) break;
      if (b->down) receiver = false;
    } else if (!receiver) {
      break;
    }
    if (const auto* k = std::get_if<KeyEvent>(&*next)) {
      if (k->action == GLFW_RELEASE && is_control(k->key) && !pressed.empty()) break;
      if (k->action == GLFW_RELEASE && std::ranges::find(pressed, k->key) != pressed.end()) {
        later.push_back(*next);  // down for one frame; the rest need not wait
        continue;
      }
      if (k->action == GLFW_PRESS) pressed.push_back(k->key);
      if (k->action == GLFW_PRESS && ends_typing(k->key)) receiver = false;
    }
    told.push_back(*next);
  }
  later.insert(later.end(), next, events_.end());
  events_ = std::move(later);
  return told;
}

}  // namespace engine
