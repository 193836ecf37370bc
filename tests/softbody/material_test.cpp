// Materials and the keys of their values.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "softbody/mechanics/material_keys.h"
#include "tests/softbody/helpers.h"

namespace softbody::test {
namespace THIS_FILE {

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

}  // namespace THIS_FILE
}  // namespace softbody::test
