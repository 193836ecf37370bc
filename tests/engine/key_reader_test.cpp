#include "engine/key_reader.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace engine {
namespace {

/// "a" for a press that means A, "&/1" for one that means & or else 1, with C- for Ctrl, A- for Alt, S- for Shift, W-
/// for Super before it and + behind it if it repeats; letters beyond ASCII are #.
std::string text_of(const std::vector<KeyPress>& presses) {
  const auto sign = [](int key) { return std::string(1, key > 0 && key < 128 ? static_cast<char>(key) : '#'); };
  std::string text;
  for (const KeyPress& p : presses) {
    if (!text.empty()) text += ' ';
    for (const auto& [mod, name] : {std::pair{GLFW_MOD_CONTROL, "C-"}, std::pair{GLFW_MOD_ALT, "A-"},
                                    std::pair{GLFW_MOD_SHIFT, "S-"}, std::pair{GLFW_MOD_SUPER, "W-"}})
      if (p.mods & mod) text += name;
    text += sign(p.key) + (p.otherwise ? "/" + sign(p.otherwise) : "") + (p.repeat ? "+" : "");
  }
  return text;
}

constexpr const char* us =
    R"(` 1 2 3 4 5 6 7 8 9 0 - = q w e r t y u i o p [ ] \ a s d f g h j k l ; ' z x c v b n m , . /)";
constexpr const char* french =
    R"(² & é " ' ( - è _ ç à ) = a z e r t y u i o p ^ $ * q s d f g h j k l m ù w x c v b n , ; : !)";
constexpr const char* german =
    R"(^ 1 2 3 4 5 6 7 8 9 0 ß ´ q w e r t z u i o p ü + # a s d f g h j k l ö ä y x c v b n m , . -)";
constexpr const char* dvorak =
    R"(` 1 2 3 4 5 6 7 8 9 0 [ ] ' , . p y f g c r l / = \ a o e u i d h t n s - ; q j k x b m w v z)";
constexpr const char* russian =
    R"(ё 1 2 3 4 5 6 7 8 9 0 - = й ц у к е н г ш щ з х ъ \ ф ы в а п р о л д ж э я ч с м и т ь б ю .)";
constexpr const char* greek =
    R"(` 1 2 3 4 5 6 7 8 9 0 - = ; ς ε ρ τ υ θ ι ο π [ ] \ α σ δ φ γ η ξ κ λ ΄ ' ζ χ ψ ω β ν μ , . /)";

class Keyboard {
 public:
  /// What its keys type without Shift, in the order of a US keyboard's.
  explicit Keyboard(const char* labels) {
    std::istringstream in(labels);
    for (const char place : std::string_view("`1234567890-=QWERTYUIOP[]\\ASDFGHJKL;'ZXCVBNM,./")) in >> labels_[place];
  }

  InputEvent key(int place, int mods = 0, int action = GLFW_PRESS) const {
    const KeyMeaning meaning = meaning_of(place, [this](int k) {
      const auto label = labels_.find(k);
      return label != labels_.end() ? label->second.c_str() : nullptr;
    });
    return KeyEvent{place, meaning, 0, action, mods};
  }
  /// The shortcuts of a key that goes down and types these characters, and goes up in the next frame.
  std::string press(int place, const std::u32string& typed = {}, int mods = 0, int action = GLFW_PRESS) {
    std::vector<InputEvent> told{key(place, mods, action)};
    for (const char32_t c : typed) told.push_back(CharacterEvent{c});
    const std::string meant = read(told);
    EXPECT_EQ(read({key(place, mods, GLFW_RELEASE)}), "");
    return meant;
  }
  std::string with_alt_gr(int place, const std::u32string& typed) {
    read({key(GLFW_KEY_RIGHT_ALT), key(GLFW_KEY_RIGHT_ALT, 0, GLFW_REPEAT)});  // without GLFW_MOD_ALT, as on X11
    const std::string meant = press(place, typed);
    read({key(GLFW_KEY_RIGHT_ALT, 0, GLFW_RELEASE)});
    return meant;
  }
  std::string read(const std::vector<InputEvent>& told) { return text_of(reader_.read(told)); }

 private:
  std::map<int, std::string> labels_;
  KeyReader reader_;
};

TEST(KeyReader, ALetterIsTheOneOnTheKey) {
  Keyboard azerty(french);
  EXPECT_EQ(azerty.press(';', U"m"), "M");
  EXPECT_EQ(azerty.press('M', U","), ",");
  EXPECT_EQ(azerty.press('M', U"", GLFW_MOD_CONTROL), "");
  EXPECT_EQ(azerty.press('A', U"q"), "Q");
  EXPECT_EQ(azerty.press('W', U"", GLFW_MOD_CONTROL), "C-Z");
  EXPECT_EQ(Keyboard(german).press('Y', U"", GLFW_MOD_CONTROL), "C-Z");
  EXPECT_EQ(Keyboard(dvorak).press('X', U"q"), "Q");
  EXPECT_EQ(Keyboard(dvorak).press('Q', U"'"), "'");
}

TEST(KeyReader, ASignIsTheOneThatIsTyped) {
  Keyboard qwertz(german);
  EXPECT_EQ(qwertz.with_alt_gr('8', U"["), "[");
  EXPECT_EQ(qwertz.press('8', U"8"), "8");
  EXPECT_EQ(qwertz.press('-', U"?", GLFW_MOD_SHIFT), "S-?");
  EXPECT_EQ(qwertz.press('[', U"ü"), "#");
  EXPECT_EQ(Keyboard(french).with_alt_gr('5', U"["), "[");
  EXPECT_EQ(Keyboard(french).press(',', U".", GLFW_MOD_SHIFT), "S-.");
  EXPECT_EQ(Keyboard(us).press('1', U"!", GLFW_MOD_SHIFT), "S-!");
  EXPECT_EQ(Keyboard(us).press(GLFW_KEY_UNKNOWN, U"?"), "?") << "of keys that no US keyboard has";
  const int option = GLFW_MOD_ALT, windows_alt_gr = GLFW_MOD_ALT | GLFW_MOD_CONTROL;
  EXPECT_EQ(Keyboard(german).press('5', U"[", option), "[");
  EXPECT_EQ(Keyboard(german).press('8', U"[", windows_alt_gr), "[");
}

TEST(KeyReader, FrenchDigitKeysAreDigitsWithAndWithoutShift) {
  Keyboard azerty(french);
  EXPECT_EQ(azerty.press('1', U"&"), "&/1");
  EXPECT_EQ(azerty.press('2', U"é"), "#/2");
  EXPECT_EQ(azerty.press('1', U"1", GLFW_MOD_SHIFT), "S-1/1");
  EXPECT_EQ(azerty.with_alt_gr('2', U"~"), "~");
}

TEST(KeyReader, WithoutLatinLettersAKeyIsWhatItIsOnAUSKeyboard) {
  Keyboard keys(russian);
  EXPECT_EQ(keys.press('S', U"ы"), "#/S");
  EXPECT_EQ(keys.press('D', U"В", GLFW_MOD_SHIFT), "S-#/D");
  EXPECT_EQ(keys.press('[', U"х"), "#/[");
  EXPECT_EQ(keys.press('/', U"."), ".//");
  EXPECT_EQ(keys.press('Z', U"", GLFW_MOD_CONTROL), "C-Z");
  EXPECT_EQ(keys.press('1', U"1"), "1");
  EXPECT_EQ(keys.press('2', U"\"", GLFW_MOD_SHIFT), "S-\"");
  EXPECT_EQ(keys.with_alt_gr('S', U"ы"), "#");
  EXPECT_EQ(keys.with_alt_gr('S', U"s"), "");
  EXPECT_EQ(Keyboard(greek).press('Q', U";"), ";/Q");
  EXPECT_EQ(Keyboard(russian).press('[', U"]"), "]/[") << "Hebrew";
  EXPECT_EQ(Keyboard(german).press(';', U"ö"), "#") << "where there are some, one more letter is none of them";
}

TEST(KeyReader, AltAndSuperAreTold) {
  Keyboard keys(us);
  EXPECT_EQ(keys.press('S', U"", GLFW_MOD_ALT), "A-S");
  EXPECT_EQ(keys.press('S', U"s", GLFW_MOD_SUPER), "W-S");
  EXPECT_EQ(keys.press('[', U"[", GLFW_MOD_SUPER), "W-[");
  EXPECT_EQ(keys.with_alt_gr('S', U"s"), "A-S");
  EXPECT_EQ(keys.press('S', U"s"), "S") << "AltGr is up again";
}

TEST(KeyReader, CapsLockAndShiftChangeNoLetter) {
  Keyboard keys(us);
  EXPECT_EQ(keys.press('M', U"M"), "M");
  EXPECT_EQ(keys.press('D', U"d", GLFW_MOD_SHIFT), "S-D");
}

TEST(KeyReader, ALetterKeyThatTypesASignMeansThat) {
  EXPECT_EQ(Keyboard(us).press('S', U"?"), "?") << "Neo, where Caps Lock does what AltGr does elsewhere";
  EXPECT_EQ(Keyboard(us).press('E', U"ê"), "#") << "after a dead key";
}

TEST(KeyReader, KeysThatTypeNothingAndSpaceAreThemselves) {
  Keyboard keys(french);
  EXPECT_EQ(keys.press(GLFW_KEY_SPACE, U" "), " ");
  EXPECT_EQ(keys.press(GLFW_KEY_SPACE, U"^"), "  ^") << "after a dead key";
  EXPECT_EQ(keys.press('['), "") << "a dead key";
  for (const int key : {GLFW_KEY_F1, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER}) EXPECT_EQ(keys.press(key), "#");
}

TEST(KeyReader, TheKeypadTypesByNumLock) {
  Keyboard keys(us);
  EXPECT_EQ(keys.press(GLFW_KEY_KP_1), "");
  EXPECT_EQ(keys.press(GLFW_KEY_KP_1, U"1"), "1");
  EXPECT_EQ(keys.read({keys.key(GLFW_KEY_KP_2)}) + keys.read({CharacterEvent{'2'}}), "2") << "in two frames";
}

TEST(KeyReader, OnePressIsOneShortcut) {
  Keyboard keys(us);
  EXPECT_EQ(keys.read({keys.key('S')}) + keys.read({CharacterEvent{'s'}}), "S") << "an input method answers late";
  EXPECT_EQ(keys.read({keys.key('1'), keys.key('F')}) + keys.read({CharacterEvent{'1'}, CharacterEvent{'f'}}), "1 F");
  EXPECT_EQ(keys.read({keys.key(' '), keys.key('F')}) + keys.read({CharacterEvent{' '}, CharacterEvent{'f'}}), "  F");
  EXPECT_EQ(Keyboard(russian).press('B', U"لا"), "#/B #") << "a ligature";
  EXPECT_EQ(Keyboard(russian).press('N', U"т", 0, GLFW_REPEAT), "#/N+");
  EXPECT_EQ(keys.press('[', U"[", 0, GLFW_REPEAT), "[+");
  EXPECT_EQ(keys.press('N', U"n", 0, GLFW_REPEAT), "N+");
}

TEST(KeyReader, KeysOfOneFrameKeepTheirCharacters) {
  const Keyboard keys(french);
  KeyReader reader;
  EXPECT_EQ(text_of(reader.read({keys.key('1'), CharacterEvent{'&'}, keys.key(';'), CharacterEvent{'m'}, keys.key('5'),
                                 CharacterEvent{'('}})),
            "&/1 M (/5");
}

}  // namespace
}  // namespace engine
