#include "engine/input_queue.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <string>

namespace engine {
namespace {

/// Keys in capitals, their characters in small letters, keys without one as #, their release as '-'; a mouse button as
/// ( and ), the wheel as *.
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

struct Hands {
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
  void button(bool down) { queue.push(ButtonEvent{.button = 0, .down = down, .at = {1, 2}}); }
  void click() {
    button(true);
    button(false);
  }
  std::string told() { return text_of(queue.take()); }
};

TEST(InputQueue, WhatIsTypedAfterAClickWaitsForItsFrame) {
  Hands hands;
  hands.type('A');
  hands.click();
  hands.type('B');
  EXPECT_EQ(hands.told(), "Aa(");
  EXPECT_EQ(hands.told(), "-)Bb");
  EXPECT_EQ(hands.told(), "-");
  EXPECT_TRUE(hands.queue.empty());
  EXPECT_EQ(hands.told(), "");
}

TEST(InputQueue, NoClickOfADoubleClickIsMissed) {
  Hands hands;
  hands.click();
  hands.click();
  hands.queue.push(ScrollEvent{{0, 1}});
  for (const char* frame : {"(", ")", "(", ")*", ""}) EXPECT_EQ(hands.told(), frame);
}

TEST(InputQueue, AKeyIsDownForAFrameAndTheRestDoNotWait) {
  Hands hands;
  for (const char c : std::string("EVEN")) hands.type(c);
  EXPECT_EQ(hands.told(), "EeVvEeNn");
  EXPECT_EQ(hands.told(), "----");
}

TEST(InputQueue, WhatFollowsEnterOrControlWaits) {
  Hands hands;
  hands.type('A');
  hands.tap(GLFW_KEY_ENTER);
  hands.key(GLFW_KEY_LEFT_CONTROL, GLFW_PRESS);
  hands.key('Z', GLFW_PRESS);
  hands.key('Z', GLFW_RELEASE);
  hands.key(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE);
  hands.type('B');
  EXPECT_EQ(hands.told(), "Aa");
  EXPECT_EQ(hands.told(), "-\n");
  EXPECT_EQ(hands.told(), "-^Z");
  EXPECT_EQ(hands.told(), "--Bb");
}

TEST(InputQueue, WhatIsTypedBeforeAControlKeyIsToldBeforeIt) {
  Hands hands;
  hands.type('A');
  hands.key(GLFW_KEY_LEFT_CONTROL, GLFW_PRESS);
  hands.key('V', GLFW_PRESS);
  hands.key('V', GLFW_RELEASE);
  hands.key(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE);
  for (const char* frame : {"Aa", "-^V", "--", ""}) EXPECT_EQ(hands.told(), frame);
}

TEST(InputQueue, EachBackspaceHasItsFrame) {
  Hands hands;
  hands.type('A');
  hands.tap(GLFW_KEY_BACKSPACE);
  hands.tap(GLFW_KEY_BACKSPACE);
  hands.type('B');
  for (const char* frame : {"Aa", "-<", "-", "<", "-Bb", "-", ""}) EXPECT_EQ(hands.told(), frame);
}

TEST(InputQueue, WhatMovesTheCaretStandsBetweenWhatIsTypedBeforeAndAfter) {
  for (const int key : {GLFW_KEY_HOME, GLFW_KEY_END, GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_DELETE}) {
    Hands hands;
    hands.type('A');
    hands.tap(key);
    hands.type('B');
    for (const char* frame : {"Aa", "-#", "-Bb", "-", ""}) EXPECT_EQ(hands.told(), frame) << key;
  }
}

TEST(InputQueue, ATabHasTwoFrames) {
  Hands hands;
  hands.tap(GLFW_KEY_TAB);
  hands.type('B');
  for (const char* frame : {">", "", "-Bb", "-", ""}) EXPECT_EQ(hands.told(), frame);
}

}  // namespace
}  // namespace engine
