#pragma once
// A key of a material or of a scene: all that scene files, the panel and the documents say about one value. A key of a
// material is declared beside what it acts on; material_keys() lists all of them. Those of scenes: scene/scene_keys.h.

#include <limits>
#include <string_view>

namespace softbody {

/// The value of a key that has no plain fallback, until it is given.
inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// How the panel shows a key.
struct Slider {
  const char* text = nullptr;    // on the screen; nullptr: the panel does not show the key
  const char* format = nullptr;  // as for printf, with the unit
  float least = 0, most = 0;
  bool logarithmic = false;
  double unit = 1;  // the slider's 1 in the key's unit
};

struct KeyOptions {
  int place = 10;                 // files list keys with a smaller one first
  bool is_switch = false;         // 0 or 1: false or true in files
  std::string_view if_missing{};  // what acts until the key is given, if it has no plain fallback
};

/// Materials know a key by its address.
struct Key {
  struct Limits {
    double least, most;
  };
  std::string_view name;  // in files; "a.b" is b in the table a
  std::string_view unit;
  double fallback;
  Limits limits;
  std::string_view summary;
  Slider slider;
  KeyOptions options;

  constexpr Key(std::string_view n, std::string_view u, double value, Limits allowed, std::string_view text,
                Slider shown = {}, KeyOptions more = {})
      : name(n), unit(u), fallback(value), limits(allowed), summary(text), slider(shown), options(more) {}
  /// A key whose fallback is not stated here.
  constexpr Key(std::string_view n, std::string_view u, Limits allowed, std::string_view text, Slider shown = {},
                KeyOptions more = {})
      : Key(n, u, not_given, allowed, text, shown, more) {}
  Key(const Key&) = delete;

  /// Returns the name of the table in files that holds the key; empty if none does.
  constexpr std::string_view table() const { return name.substr(0, last_part() > 0 ? last_part() - 1 : 0); }
  /// Returns the key's name in its table.
  constexpr std::string_view own_name() const { return name.substr(last_part()); }

 private:
  constexpr std::size_t last_part() const { return name.find('.') + 1; }  // 0 if there is no dot: npos + 1
};

}  // namespace softbody
