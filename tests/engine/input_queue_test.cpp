#include "engine/input_queue.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <string>

namespace engine {
namespace THIS_FILE {

/// Writes one sign per event: a letter key as a capital, its character as a small letter, ^ for Ctrl, < for Backspace,
/// > for Tab, a line break for Enter, # for other function keys, - for the release of any key, ( and ) for press and
/// release of a mouse button, * for the wheel.
std::string text_of(const std::vector<InputEvent>& events) {
  std::string text;
  for (const InputEvent& event : events) {
    if (const auto* key = std::get_if<KeyEvent>(&event)) {
      text += key->action == GLFW_RELEASE         ? '-'
              : key->key == GLFW_KEY_ENTER        ? '\n'
              : key->key == GLFW_KEY_LEFT_CONTROL ? '^'
              : key->key == GLFW_KEY_BACKSPACE    ? '<'
              : key->key == GLFW_KEY_TAB          ? '>'
              : key->key >= GLFW_KEY_ESCAPE       ? '#'
                                                  : static_cast<char>(key->key);
    } else if (const auto* character = std::get_if<CharacterEvent>(&event)) {
      text += static_cast<char>(character->code);
    } else if (const auto* button = std::get_if<ButtonEvent>(&event)) {
      text += button->down ? '(' : ')';
    } else {
      text += '*';
    }
  }
  return text;
}

/// Sends mouse and keyboard events to a queue.
struct User {
  InputQueue queue;

  void key(int code, int action) { queue.push(KeyEvent{code, {code, false}, 0, action, 0}); }
  void type(char capital) {
    key(capital, GLFW_PRESS);
    queue.push(CharacterEvent{static_cast<unsigned int>(capital - 'A' + 'a')});
    key(capital, GLFW_RELEASE);
  }
  void tap(int code) {
    key(code, GLFW_PRESS);
    key(code, GLFW_RELEASE);
  }
  void button(bool down) { queue.push(ButtonEvent{.button = 0, .down = down, .position = {1, 2}}); }
  void click() {
    button(true);
    button(false);
  }
  void expect_frames(std::initializer_list<const char*> frames) {
    for (const char* frame : frames) EXPECT_EQ(text_of(queue.take()), frame);
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(text_of(queue.take()), "");
  }
};

TEST(InputQueue, CharactersAfterAClickWaitForTheNextFrame) {
  User user;
  user.type('A');
  user.click();
  user.type('B');
  user.expect_frames({"Aa(", "-)Bb", "-"});
}

TEST(InputQueue, BothClicksOfADoubleClickArrive) {
  User user;
  user.click();
  user.click();
  user.queue.push(ScrollEvent{{0, 1}});
  user.expect_frames({"(", ")", "(", ")*"});
}

TEST(InputQueue, AKeyStaysDownForOneFrameAndOthersDoNotWait) {
  User user;
  for (const char c : std::string("EVEN")) user.type(c);
  user.expect_frames({"EeVvEeNn", "----"});
}

TEST(InputQueue, EventsAfterEnterOrControlWait) {
  User user;
  user.type('A');
  user.tap(GLFW_KEY_ENTER);
  user.key(GLFW_KEY_LEFT_CONTROL, GLFW_PRESS);
  user.tap('Z');
  user.key(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE);
  user.type('B');
  user.expect_frames({"Aa", "-\n", "-^Z", "--Bb", "-"});
}

TEST(InputQueue, CharactersBeforeControlComeBeforeIt) {
  User user;
  user.type('A');
  user.key(GLFW_KEY_LEFT_CONTROL, GLFW_PRESS);
  user.tap('V');
  user.key(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE);
  user.expect_frames({"Aa", "-^V", "--"});
}

TEST(InputQueue, EachBackspaceHasAFrameOfItsOwn) {
  User user;
  user.type('A');
  user.tap(GLFW_KEY_BACKSPACE);
  user.tap(GLFW_KEY_BACKSPACE);
  user.type('B');
  user.expect_frames({"Aa", "-<", "-", "<", "-Bb", "-"});
}

TEST(InputQueue, KeysThatMoveTheCursorKeepTheirPlaceBetweenCharacters) {
  for (const int key : {GLFW_KEY_HOME, GLFW_KEY_END, GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_DELETE}) {
    User user;
    user.type('A');
    user.tap(key);
    user.type('B');
    SCOPED_TRACE(key);
    user.expect_frames({"Aa", "-#", "-Bb", "-"});
  }
}

TEST(InputQueue, NoEventsFollowInTheFrameAfterTab) {
  User user;
  user.tap(GLFW_KEY_TAB);
  user.type('B');
  user.expect_frames({">", "", "-Bb", "-"});
}

}  // namespace THIS_FILE
}  // namespace engine
