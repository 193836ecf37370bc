// The tables of the documents that follow from the program, and the programs that they show:
//
//   test_documents --write
//
// writes them anew.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "softbody/forces/material_keys.h"
#include "softbody/mesh/shortest_text.h"

namespace softbody::test {
namespace {

constexpr const char* scene_format = SBCOLLIDE_SCENES "/README.md";

std::string read(const char* file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::string head = "| key | unit | left out | limits | meaning |\n|---|---|---|---|---|\n";

std::string table_of_keys() {
  std::string text = head;
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

/// Returns the page with the table of keys in place of the one that it has.
std::string with_table(const std::string& page) {
  const std::size_t begin = page.find(head), end = page.find("\n\n", begin);
  if (begin == std::string::npos || end == std::string::npos) return page;
  return page.substr(0, begin) + table_of_keys() + page.substr(end + 1);
}

TEST(SceneFormat, HasTheTableOfAllKeysOfMaterials) {
  const std::string page = read(scene_format);
  EXPECT_TRUE(page.find("\n" + table_of_keys() + "\n") != std::string::npos) << "write it anew: test_documents --write";
  EXPECT_TRUE(with_table(page) == page);
}

/// A page that shows a program of app/package/examples.
struct Example {
  std::string page, file;
};
const std::array<Example, 2> examples{
    {{"collide/README.md", "find_contacts.cpp"}, {"softbody/README.md", "drop_ball.cpp"}}};

std::string source(const std::string& file) { return SBCOLLIDE_SCENES "/../../" + file; }

/// Returns the page with the example in place of the one that it has.
std::string with_example(const std::string& page, const std::string& file) {
  const std::string start = "](../app/package/examples/" + file + "):\n\n```cpp\n";
  const std::size_t begin = page.find(start), end = page.find("```\n", begin + start.size());
  if (begin == std::string::npos || end == std::string::npos) return {};
  return page.substr(0, begin + start.size()) + read(source("app/package/examples/" + file).c_str()) + page.substr(end);
}

TEST(Pages, ShowTheExamplesThatAreInstalled) {
  for (const Example& e : examples) {
    const std::string page = read(source(e.page).c_str());
    EXPECT_TRUE(with_example(page, e.file) == page) << e.page << ": write it anew: test_documents --write";
  }
}

int write() {
  bool written = bool(std::ofstream(scene_format) << with_table(read(scene_format)));
  for (const Example& e : examples) {
    const std::string file = source(e.page), page = with_example(read(file.c_str()), e.file);
    written = !page.empty() && std::ofstream(file) << page && written;
  }
  return written ? 0 : 1;
}

}  // namespace
}  // namespace softbody::test

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  if (count == 2 && std::string(arguments[1]) == "--write") return softbody::test::write();
  return RUN_ALL_TESTS();
}
