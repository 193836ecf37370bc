#include "engine/key_translator.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace engine {
namespace THIS_FILE {

/// Writes key presses: "A" means A, "&/1" means & with the fallback 1. Before it: C- for Ctrl, A- for Alt, S- for
/// Shift, W- for Super. After it: + if the key repeats. Letters beyond ASCII and keys that type nothing are #.
std::string text_of(const std::vector<KeyPress>& presses) {
  const auto sign = [](int key) { return std::string(1, key > 0 && key < 128 ? static_cast<char>(key) : '#'); };
  std::string text;
  for (const KeyPress& p : presses) {
    if (!text.empty()) text += ' ';
    for (const auto& [mod, name] : {std::pair{GLFW_MOD_CONTROL, "C-"}, std::pair{GLFW_MOD_ALT, "A-"},
                                    std::pair{GLFW_MOD_SHIFT, "S-"}, std::pair{GLFW_MOD_SUPER, "W-"}})
      if (p.mods & mod) text += name;
    text += sign(p.key) + (p.fallback_key ? "/" + sign(p.fallback_key) : "") + (p.repeat ? "+" : "");
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
  /// `labels`: what the keys type without Shift, in the order of a US keyboard.
  explicit Keyboard(const char* labels) {
    std::istringstream in(labels);
    for (const char place : std::string_view("`1234567890-=QWERTYUIOP[]\\ASDFGHJKL;'ZXCVBNM,./")) in >> labels_[place];
  }

  InputEvent key(int place, int mods = 0, int action = GLFW_PRESS) const {
    const KeyMeaning meaning = key_meaning(place, [this](int k) {
      const auto label = labels_.find(k);
      return label != labels_.end() ? label->second.c_str() : nullptr;
    });
    return KeyEvent{place, meaning, 0, action, mods};
  }
  /// Returns the shortcuts of a key that goes down, types the characters `typed`, and goes up in the next frame.
  std::string press(int place, const std::u32string& typed = {}, int mods = 0, int action = GLFW_PRESS) {
    std::vector<InputEvent> events{key(place, mods, action)};
    for (const char32_t c : typed) events.push_back(CharacterEvent{c});
    const std::string meant = translate(events);
    EXPECT_EQ(translate({key(place, mods, GLFW_RELEASE)}), "");
    return meant;
  }
  std::string with_alt_gr(int place, const std::u32string& typed) {
    translate({key(GLFW_KEY_RIGHT_ALT), key(GLFW_KEY_RIGHT_ALT, 0, GLFW_REPEAT)});  // without GLFW_MOD_ALT, as on X11
    const std::string meant = press(place, typed);
    translate({key(GLFW_KEY_RIGHT_ALT, 0, GLFW_RELEASE)});
    return meant;
  }
  std::string translate(const std::vector<InputEvent>& events) { return text_of(translator_.translate(events)); }

 private:
  std::map<int, std::string> labels_;
  KeyTranslator translator_;
};

TEST(KeyTranslator, ALetterKeyMeansTheLetterOnIt) {
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

TEST(KeyTranslator, ASignKeyMeansTheSignThatItTypes) {
  Keyboard qwertz(german);
  EXPECT_EQ(qwertz.with_alt_gr('8', U"["), "[");
  EXPECT_EQ(qwertz.press('8', U"8"), "8");
  EXPECT_EQ(qwertz.press('-', U"?", GLFW_MOD_SHIFT), "S-?");
  EXPECT_EQ(qwertz.press('[', U"ü"), "#");
  EXPECT_EQ(Keyboard(french).with_alt_gr('5', U"["), "[");
  EXPECT_EQ(Keyboard(french).press(',', U".", GLFW_MOD_SHIFT), "S-.");
  EXPECT_EQ(Keyboard(us).press('1', U"!", GLFW_MOD_SHIFT), "S-!");
  EXPECT_EQ(Keyboard(us).press(GLFW_KEY_UNKNOWN, U"?"), "?") << "a key that US keyboards lack";
  const int option = GLFW_MOD_ALT, windows_alt_gr = GLFW_MOD_ALT | GLFW_MOD_CONTROL;
  EXPECT_EQ(Keyboard(german).press('5', U"[", option), "[");
  EXPECT_EQ(Keyboard(german).press('8', U"[", windows_alt_gr), "[");
}

TEST(KeyTranslator, FrenchDigitKeysMeanDigitsWithAndWithoutShift) {
  Keyboard azerty(french);
  EXPECT_EQ(azerty.press('1', U"&"), "&/1");
  EXPECT_EQ(azerty.press('2', U"é"), "#/2");
  EXPECT_EQ(azerty.press('1', U"1", GLFW_MOD_SHIFT), "S-1/1");
  EXPECT_EQ(azerty.with_alt_gr('2', U"~"), "~");
}

TEST(KeyTranslator, WithoutLatinLettersAKeyMeansTheSameAsOnAUSKeyboard) {
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
  EXPECT_EQ(Keyboard(german).press(';', U"ö"), "#") << "the layout has Latin letters, so there is no fallback";
}

TEST(KeyTranslator, ReportsAltAndSuper) {
  Keyboard keys(us);
  EXPECT_EQ(keys.press('S', U"", GLFW_MOD_ALT), "A-S");
  EXPECT_EQ(keys.press('S', U"s", GLFW_MOD_SUPER), "W-S");
  EXPECT_EQ(keys.press('[', U"[", GLFW_MOD_SUPER), "W-[");
  EXPECT_EQ(keys.with_alt_gr('S', U"s"), "A-S");
  EXPECT_EQ(keys.press('S', U"s"), "S") << "AltGr is released";
}

TEST(KeyTranslator, CapsLockAndShiftDoNotChangeLetters) {
  Keyboard keys(us);
  EXPECT_EQ(keys.press('M', U"M"), "M");
  EXPECT_EQ(keys.press('D', U"d", GLFW_MOD_SHIFT), "S-D");
}

TEST(KeyTranslator, ALetterKeyThatTypesASignMeansTheSign) {
  EXPECT_EQ(Keyboard(us).press('S', U"?"), "?") << "Neo layout: Caps Lock acts as AltGr";
  EXPECT_EQ(Keyboard(us).press('E', U"ê"), "#") << "after a dead key";
}

TEST(KeyTranslator, SpaceAndKeysThatTypeNothingMeanThemselves) {
  Keyboard keys(french);
  EXPECT_EQ(keys.press(GLFW_KEY_SPACE, U" "), " ");
  EXPECT_EQ(keys.press(GLFW_KEY_SPACE, U"^"), "  ^") << "after a dead key";
  EXPECT_EQ(keys.press('['), "") << "a dead key";
  for (const int key : {GLFW_KEY_F1, GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER}) EXPECT_EQ(keys.press(key), "#");
}

TEST(KeyTranslator, KeypadKeysMeanWhatTheyType) {
  Keyboard keys(us);
  EXPECT_EQ(keys.press(GLFW_KEY_KP_1), "");
  EXPECT_EQ(keys.press(GLFW_KEY_KP_1, U"1"), "1");
  EXPECT_EQ(keys.translate({keys.key(GLFW_KEY_KP_2)}) + keys.translate({CharacterEvent{'2'}}), "2") << "in two frames";
}

TEST(KeyTranslator, OnePressGivesOneShortcut) {
  Keyboard keys(us);
  EXPECT_EQ(keys.translate({keys.key('S')}) + keys.translate({CharacterEvent{'s'}}), "S")
      << "an input method answers late";
  EXPECT_EQ(keys.translate({keys.key('1'), keys.key('F')}) + keys.translate({CharacterEvent{'1'}, CharacterEvent{'f'}}),
            "1 F");
  EXPECT_EQ(keys.translate({keys.key(' '), keys.key('F')}) + keys.translate({CharacterEvent{' '}, CharacterEvent{'f'}}),
            "  F");
  EXPECT_EQ(Keyboard(russian).press('B', U"لا"), "#/B #") << "a ligature";
  EXPECT_EQ(Keyboard(russian).press('N', U"т", 0, GLFW_REPEAT), "#/N+");
  EXPECT_EQ(keys.press('[', U"[", 0, GLFW_REPEAT), "[+");
  EXPECT_EQ(keys.press('N', U"n", 0, GLFW_REPEAT), "N+");
}

TEST(KeyTranslator, KeysOfOneFrameKeepTheirOwnCharacters) {
  const Keyboard keys(french);
  KeyTranslator translator;
  EXPECT_EQ(text_of(translator.translate({keys.key('1'), CharacterEvent{'&'}, keys.key(';'), CharacterEvent{'m'},
                                          keys.key('5'), CharacterEvent{'('}})),
            "&/1 M (/5");
}

}  // namespace THIS_FILE
}  // namespace engine
