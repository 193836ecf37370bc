// Materials and the keys of their values, in memory and in the document.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "softbody/forces/material_keys.h"
#include "softbody/mesh/shortest_text.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace {

TEST(Material, HasTheFallbackOfEachKeyThatIsNotSet) {
  const Material m;
  for (const Key* key : material_keys()) {
    EXPECT_EQ(m.given(*key), !std::isnan(key->fallback)) << key->name;
    EXPECT_TRUE(m[*key] == key->fallback || !m.given(*key)) << key->name;
  }
}

TEST(Material, EqualsOneWithTheSameValuesHoweverTheyWereSet) {
  const Material unset;
  for (const Key* key : material_keys()) {
    Material m;
    m[*key] = key->fallback;
    EXPECT_EQ(m, unset) << key->name;
    m[*key] = key->fallback == key->limits.least ? key->limits.most : key->limits.least;
    EXPECT_NE(m, unset) << key->name;
    EXPECT_NE(unset, m) << key->name;
    m[*key] = key->fallback;
    EXPECT_EQ(unset, m) << key->name;
  }
}

TEST(Material, SetsTheFirstKeysOfAList) {
  Material m;
  m.set(BendSprings::keys, {7});
  EXPECT_EQ(m[BendSprings::stiffness], 7);
  EXPECT_EQ(m[BendSprings::damping_ratio], BendSprings::damping_ratio.fallback);
  m.set(BendSprings::keys, {8, 9});
  EXPECT_EQ(m[BendSprings::stiffness], 8);
  EXPECT_EQ(m[BendSprings::damping_ratio], 9);
}

TEST(MaterialKeys, AreSoundAndHaveDifferentNames) {
  std::set<std::string_view> names;
  for (const Key* key : material_keys()) {
    SCOPED_TRACE(key->name);
    EXPECT_TRUE(names.insert(key->name).second);
    EXPECT_FALSE(key->summary.empty());
    EXPECT_LT(key->limits.least, key->limits.most);
    if (std::isnan(key->fallback)) {
      EXPECT_FALSE(key->options.if_missing.empty());
    } else {
      EXPECT_GE(key->fallback, key->limits.least);
      EXPECT_LE(key->fallback, key->limits.most);
    }
    if (const Slider& s = key->slider; s.text) {
      EXPECT_FALSE(std::isnan(key->fallback)) << "a slider shows a number";
      EXPECT_GE(double{s.least} * s.unit, key->limits.least);
      EXPECT_LE(double{s.most} * s.unit, key->limits.most);
      EXPECT_LT(s.least, s.most);
    }
  }
}

TEST(MaterialKeys, OfOneInlineTableStandTogether) {
  std::set<std::string_view> closed;
  std::string_view open;
  for (const Key* key : material_keys()) {
    if (key->table() == open) continue;
    closed.insert(open);
    open = key->table();
    EXPECT_TRUE(open.empty() || !closed.contains(open)) << open;
  }
}

/// Returns the table of keys as assets/scenes/README.md shows it.
std::string table_of_keys() {
  std::string text = "| key | unit | left out | limits | meaning |\n|---|---|---|---|---|\n";
  for (const Key* key : material_keys()) {
    const auto shown = [key](double value) {
      return key->options.is_switch ? std::string(value != 0 ? "true" : "false") : shortest_text(value);
    };
    const std::string left_out =
        std::isnan(key->fallback) ? std::string(key->options.if_missing) : shown(key->fallback);
    const char* between = key->options.is_switch ? " or " : " to ";
    text.append("| `").append(key->name).append("` | ").append(key->unit).append(" | ").append(left_out);
    text.append(" | ").append(shown(key->limits.least) + between + shown(key->limits.most));
    text.append(" | ").append(key->summary).append(" |\n");
  }
  return text;
}

TEST(MaterialKeys, StandInTheDocumentOfTheSceneFormat) {
  std::ifstream file(SBCOLLIDE_SCENES "/README.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(page.find("\n" + table_of_keys() + "\n"), std::string::npos) << "its table has to be\n\n"
                                                                         << table_of_keys();
}

}  // namespace
}  // namespace softbody::test
