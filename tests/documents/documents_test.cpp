// The parts of documents that follow from the program, and the programs that they show:
//
//   test_documents --write
//
// writes them anew.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "collide/methods.h"
#include "softbody/forces/material_keys.h"
#include "softbody/mesh/shortest_text.h"

namespace softbody::test {
namespace {

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
  text.pop_back();  // the end of the last line
  return text;
}

/// Returns the text in lines of at most 120 characters. A byte counts as one, so that some lines are shorter.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines, word;
  std::size_t length = 0;
  while (words >> word) {
    if (length > 0) {
      const bool fits = length + 1 + word.size() <= 120;
      lines += fits ? ' ' : '\n';
      length = fits ? length + 1 : 0;
    }
    lines += word;
    length += word.size();
  }
  return lines + "\n";
}

std::string descriptions_of_methods() {
  std::string text;
  for (const collide::MethodGroupName& group : collide::method_groups) {
    text.append("### ").append(group.name).append("\n");
    for (const collide::Method& method : collide::method_table()) {
      if (method.group != group.group) continue;
      std::string paragraph("**");
      paragraph.append(method.name).append("** (`").append(method.key).append("`). ").append(method.description);
      text.append("\n").append(wrapped(paragraph));
    }
    text.append("\n");
  }
  return text;
}

/// A part of a page: from `begin` to before the next `end`.
struct Part {
  const char* page;
  std::string begin, end, text;

  std::string replaced_in(const std::string& whole) const {
    const std::size_t first = whole.find(begin), last = whole.find(end, first);
    if (first == std::string::npos || last == std::string::npos) return {};
    return whole.substr(0, first) + text + whole.substr(last);
  }
};

/// Returns the part of a page that shows a program of app/package/examples.
Part example(const char* page, const std::string& file) {
  const std::string begin = "](../app/package/examples/" + file + "):\n\n```cpp\n";
  return {page, begin, "```\n", begin + read((SBCOLLIDE_SOURCES "/app/package/examples/" + file).c_str())};
}

std::vector<Part> parts() {
  return {{SBCOLLIDE_SOURCES "/assets/scenes/README.md", head, "\n\n", table_of_keys()},
          {SBCOLLIDE_SOURCES "/collide/README.md", "### The paper's rivals\n", "## How the paper's method works\n",
           descriptions_of_methods()},
          example(SBCOLLIDE_SOURCES "/collide/README.md", "find_contacts.cpp"),
          example(SBCOLLIDE_SOURCES "/softbody/README.md", "drop_ball.cpp")};
}

TEST(Documents, HaveTheTextOfTheProgram) {
  for (const Part& part : parts()) {
    const std::string page = read(part.page);
    EXPECT_TRUE(part.replaced_in(page) == page) << part.page << ": write it anew: test_documents --write";
  }
}

int write() {
  for (const Part& part : parts()) {
    const std::string page = part.replaced_in(read(part.page));
    if (page.empty() || !(std::ofstream(part.page) << page)) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace softbody::test

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  if (count == 2 && std::string(arguments[1]) == "--write") return softbody::test::write();
  return RUN_ALL_TESTS();
}
