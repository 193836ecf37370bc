// The tables of the documents that follow from the program:
//
//   test_documents --write
//
// writes them anew.

#include <gtest/gtest.h>

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

int write() {
  const std::string page = with_table(read(scene_format));
  return std::ofstream(scene_format) << page ? 0 : 1;
}

}  // namespace
}  // namespace softbody::test

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  if (count == 2 && std::string(arguments[1]) == "--write") return softbody::test::write();
  return RUN_ALL_TESTS();
}
