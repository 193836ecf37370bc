#include "softbody/mesh/line_reader.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace THIS_FILE {

using softbody::LineReader;

/// Lengths about those at which more is read at once, up to the longest line.
constexpr std::size_t lengths[]{
    0, 1, 65'529, 65'530, 65'535, 65'536, 65'537, 131'072, 200'000, 524'288, LineReader::max_line_length - 8};

std::vector<std::string> lines_of(const std::string& text) {
  const tests::TemporaryFolder folder;
  LineReader reader(folder.write("lines", text));
  std::vector<std::string> lines;
  for (std::string_view line; reader.next(line);) lines.emplace_back(line);
  return lines;
}

TEST(LineReader, ReadsWholeLinesOfAnyLengthAndEnd) {
  for (const std::size_t length : lengths)
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      const std::string line(length, 'x');
      EXPECT_TRUE(lines_of("first" + end + line + end + line + end + "last") ==
                  (std::vector<std::string>{"first", line, line, "last"}))
          << length;
    }
}

TEST(LineReader, JoinsLinesOfAnyLengthAndEnd) {
  for (const std::size_t length : lengths)
    for (const std::string end : {"\n", "\r\n", "\r", " \t\n"}) {
      const std::string half(length / 2, '1');
      const tests::TemporaryFolder folder;
      LineReader lines(folder.write("lines", half + "\\" + end + half + "1\nlast"));
      std::string_view line;
      ASSERT_TRUE(lines.next(line));
      EXPECT_TRUE(line == half + std::string(1 + end.size(), ' ') + half + '1') << line.size();
      ASSERT_TRUE(lines.next(line));
      EXPECT_EQ(line, "last");
      EXPECT_EQ(lines.number(), 3u);
    }
}

using Lines = std::vector<std::string>;

TEST(LineReader, TakesMixedEndsOfLines) {
  EXPECT_EQ(lines_of("a\rb\r\nc\n\r\r\n\n\rd"), (Lines{"a", "b", "c", "", "", "", "", "d"}));
  EXPECT_EQ(lines_of("a\r"), Lines{"a"});
}

TEST(LineReader, DoesNotJoinAStatementToTheLineBefore) {
  EXPECT_EQ(lines_of("g C:\\\nf 1 2 3\n"), (Lines{"g C:\\", "f 1 2 3"}));
  EXPECT_EQ(lines_of("g C:\\\r\tf 1 \\\r2 3\r"), (Lines{"g C:\\", "\tf 1   2 3"}));
  EXPECT_EQ(lines_of("# C:\\\n# D:\\\n\nv"), (Lines{"# C:\\", "# D:  ", "v"}));
  EXPECT_EQ(lines_of("v 1 2 \\\n-.5\n\\"), (Lines{"v 1 2   -.5", "\\"}));
}

TEST(LineReader, LeavesOutPaddingAtTheEndOnly) {
  const std::string zero(1, '\0'), zeros(100'000, '\0');
  for (const std::string& padding : Lines{"\x1a", zero, zeros, "\n\x1a\r\n\x1a\x1a\n", "\n" + zeros, "\r" + zero}) {
    const Lines lines = lines_of("a\nb" + padding);
    ASSERT_GE(lines.size(), 2u);
    EXPECT_EQ(lines[0], "a");
    EXPECT_EQ(lines[1], "b");
    for (std::size_t i = 2; i < lines.size(); ++i) EXPECT_EQ(lines[i], "");
  }
  EXPECT_EQ(lines_of("a\x1a\nb"), (Lines{"a\x1a", "b"}));
}

TEST(LineReader, ReadsBytesBetweenLinesAsTheyAre) {
  const tests::TemporaryFolder folder;
  const std::string odd("\n\r\x1a\0\\\n", 6), many(200'000, '\n');
  LineReader lines(folder.write("lines", "first\n" + odd + many + "last\nx"));
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(lines.bytes(0), "");
  EXPECT_EQ(lines.bytes(odd.size()), odd);
  for (std::size_t i = 0; i < many.size(); i += 8) ASSERT_EQ(lines.bytes(8), "\n\n\n\n\n\n\n\n");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "last");
  EXPECT_EQ(lines.bytes(2), "") << "there is one only";
  EXPECT_EQ(lines.bytes(1), "x");
  EXPECT_EQ(lines.bytes(1), "");
}

TEST(LineReader, RefusesALineThatIsTooLong) {
  const tests::TemporaryFolder folder;
  LineReader lines(folder.write("lines", "first\n" + std::string(LineReader::max_line_length + 1, 'x') + "\n"));
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_THROW(lines.next(line), std::length_error);
  EXPECT_EQ(lines.number(), 2u);
}

}  // namespace THIS_FILE
