// How methods are drawn: the built-in ones, and any that join the table.

#include "app/compare/method_style.h"

#include <algorithm>
#include <set>

#include "tests/own_process.h"

namespace app {
namespace THIS_FILE {

using Colour = std::array<float, 3>;

Colour colour_of(const collide::Method& method) {
  const glm::vec3 c = compare::style(method).colour;
  return {c.x, c.y, c.z};
}

TEST(MethodStyle, TellsTheMethodsApart) {
  std::set<Colour> colours;
  std::set<compare::Marker> markers;
  for (const collide::Method& method : collide::method_table()) {
    colours.insert(colour_of(method));
    markers.insert(compare::style(method).marker);
  }
  EXPECT_EQ(colours.size(), collide::method_table().size());
  EXPECT_EQ(markers.size(), collide::method_table().size());
}

TEST(MethodStyle, ShowsFewMethodsAtFirst) {
  const auto shown = std::ranges::count(compare::usual_methods(), true);
  EXPECT_TRUE(shown >= 3 && shown <= 6) << shown;
  for (const std::string_view key : {collide::default_method, collide::paper_method})
    EXPECT_TRUE(compare::style(*collide::find_method(key)).shown) << key;
}

void expect_styles_of_further_methods() {
  for (int number = 0; number < 10; ++number) {
    collide::Method row = *collide::find_method(collide::reference_method);
    row.key += std::to_string(number);
    collide::add_method(row);
    EXPECT_TRUE(compare::style(*collide::find_method(row.key)).shown);
  }
  std::set<std::pair<compare::Marker, Colour>> styles;
  for (const collide::Method& method : collide::method_table())
    styles.insert({compare::style(method).marker, colour_of(method)});
  EXPECT_EQ(styles.size(), collide::method_table().size());
}

TEST(MethodStyle, HasARuleForFurtherMethods) { tests::in_a_process_of_its_own(expect_styles_of_further_methods); }

}  // namespace THIS_FILE
}  // namespace app
