// The parts of documents that follow from the program and from the results in app/report/results, and the programs that
// they show:
//
//   test_documents --write
//
// writes them anew.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "app/base/table.h"
#include "collide/methods.h"
#include "softbody/mechanics/material_keys.h"
#include "softbody/mesh/shortest_text.h"
#include "softbody/scene/scene_keys.h"
#include "tests/csv_fields.h"

namespace softbody::test {
namespace {

std::string read(const char* file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::string head = "| key | unit | left out | limits | meaning |\n|---|---|---|---|---|\n";

std::string shown(const Key& key, double value) {
  if (key.options.is_switch) return value != 0 ? "true" : "false";
  return shortest_text(value);
}

std::string row_of(const Key& key, const std::string& left_out) {
  const auto [least, most] = key.limits;
  const std::string limits =
      least < most ? shown(key, least) + (key.options.is_switch ? " or " : " to ") + shown(key, most) : "";
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.unit, left_out, limits, key.summary);
}

std::string keys_of_materials() {
  std::string text = head;
  for (const Key* key : material_keys())
    text += row_of(*key, std::isnan(key->fallback) ? std::string(key->options.if_missing) : shown(*key, key->fallback));
  text.pop_back();  // the end of the last line
  return text;
}

const std::string scene_head = "<!-- keys of scenes -->\n\n" + head;

std::string keys_of_scenes() {
  std::string text = scene_head;
  const Scene scene;
  const auto add = [&text](const Key& key, const auto& value) {
    std::string left_out(key.options.if_missing);
    for (const double number : numbers_of(value)) {
      const bool whole = number == std::floor(number);
      left_out += left_out.empty() ? "" : ", ";
      left_out += key.options.is_switch ? shown(key, number)
                  : whole               ? shortest_text(std::int64_t(number))
                                        : shortest_text(float(number));
    }
    if constexpr (std::is_convertible_v<decltype(value), std::string>) left_out = "`" + value + "`";
    if constexpr (std::is_same_v<decltype(value), const ContactSurface&>) left_out = "`vertex-vertex`";
    text += row_of(key, left_out);
  };
  for_each_value(scene, add);
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
    if (group.group == collide::MethodGroup::guests) continue;
    text += fmt::format("### {}\n", group.name);
    for (const collide::Method& method : collide::method_table())
      if (method.group == group.group)
        text += '\n' + wrapped(fmt::format("**{}** (`{}`). {}", method.name, method.key, method.description));
    text += '\n';
  }
  return text;
}

/// A part of a page: from `begin` to before the next `end`.
struct Part {
  std::string page, begin, end, text;

  std::string replaced_in(const std::string& whole) const {
    const std::size_t first = whole.find(begin), last = whole.find(end, first + begin.size());
    if (first == std::string::npos || last == std::string::npos) return {};
    return whole.substr(0, first) + text + whole.substr(last);
  }
};

/// Returns the part of a page that shows a program of app/package/examples.
Part example(const char* page, const std::string& file) {
  const std::string begin = "](../app/package/examples/" + file + "):\n\n```cpp\n";
  return {page, begin, "```\n", begin + read((SBCOLLIDE_SOURCES "/app/package/examples/" + file).c_str())};
}

const std::filesystem::path results = SBCOLLIDE_SOURCES "/app/report/results";

/// Returns the table of a file of results as the pages show it. Lines that begin with # say where it comes from.
std::string table_of_results(const std::filesystem::path& file, std::size_t text_columns) {
  std::istringstream lines(read(file.c_str()));
  std::vector<std::string> names;
  app::Table table;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    const std::vector<std::string> fields = csv_fields(line);
    if (names.empty()) {
      names = fields;
      continue;
    }
    if (fields.size() != names.size()) throw std::runtime_error(file.string() + ": " + line);
    app::TableRow row;
    for (std::size_t i = 0; i < fields.size(); ++i) row.push_back({names[i], fields[i]});
    table.add(row);
  }
  if (names.empty()) throw std::runtime_error(file.string() + ": no such results");
  return table.markdown(text_columns);
}

/// Returns the tables of a page that follow from results. Before each stands "<!-- FILE, TEXT COLUMNS -->".
std::vector<Part> tables_of_results(const std::string& page) {
  static const std::regex mark("<!-- ([a-z0-9_-]+\\.csv), ([0-9]) -->\n\n");
  const std::string text = read(page.c_str());
  std::vector<Part> tables;
  for (std::sregex_iterator at(text.begin(), text.end(), mark), end; at != end; ++at) {
    const std::string begin = at->str();
    tables.push_back({page, begin, "\n\n", begin + table_of_results(results / at->str(1), std::stoul(at->str(2)))});
    tables.back().text.pop_back();  // the end of the last line
  }
  return tables;
}

std::vector<Part> parts() {
  std::vector<Part> all{{SBCOLLIDE_SOURCES "/assets/scenes/README.md", head, "\n\n", keys_of_materials()},
                        {SBCOLLIDE_SOURCES "/assets/scenes/README.md", scene_head, "\n\n", keys_of_scenes()},
                        {SBCOLLIDE_SOURCES "/collide/README.md", "### The paper's rivals\n",
                         "## How the paper's method works\n", descriptions_of_methods()},
                        example(SBCOLLIDE_SOURCES "/collide/README.md", "find_contacts.cpp"),
                        example(SBCOLLIDE_SOURCES "/softbody/README.md", "drop_ball.cpp")};
  for (const char* page : {"README.md", "app/report/README.md", "collide/oracle/README.md", "tests/README.md"}) {
    const std::vector<Part> tables = tables_of_results(std::string(SBCOLLIDE_SOURCES "/") + page);
    all.insert(all.end(), tables.begin(), tables.end());
  }
  return all;
}

TEST(Documents, HaveTheTextOfTheProgram) {
  for (const Part& part : parts()) {
    const std::string page = read(part.page.c_str());
    EXPECT_TRUE(part.replaced_in(page) == page) << part.page << ": write it anew: test_documents --write";
  }
}

TEST(Results, SayWhereTheyComeFrom) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(results)) {
    const std::string text = read(entry.path().c_str());
    for (const char* line : {"# command: ", "# processor: ", "# compiler: ", "# date: "})
      EXPECT_NE(text.find(line), std::string::npos) << entry.path() << ": " << line;
    EXPECT_EQ(text.find("not recorded"), std::string::npos) << entry.path() << ": see app/report/results.sh";
    ++files;
  }
  EXPECT_GT(files, 0u);
}

int write() {
  for (const Part& part : parts()) {
    const std::string page = part.replaced_in(read(part.page.c_str()));
    if (page.empty() || !(std::ofstream(part.page) << page)) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace softbody::test

int main(int count, char** arguments) try {
  testing::InitGoogleTest(&count, arguments);
  if (count == 2 && std::string(arguments[1]) == "--write") return softbody::test::write();
  return RUN_ALL_TESTS();
} catch (const std::exception& error) {
  std::fprintf(stderr, "test_documents: %s\n", error.what());
  return 1;
}
