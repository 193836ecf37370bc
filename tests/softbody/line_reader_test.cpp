#include "softbody/line_reader.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/temporary_folder.h"

namespace {

using softbody::LineReader;

/// Lengths about those at which more is read at once, up to the longest line.
class LineLengths : public testing::TestWithParam<std::size_t> {};

TEST_P(LineLengths, ComeWholeBetweenOthers) {
  const std::string long_line(GetParam(), 'x');
  const tests::TemporaryFolder folder;
  LineReader lines(folder.write("lines", "first\n" + long_line + "\n" + long_line + "\r\nlast"));
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "first");
  for (const std::uint64_t number : {2u, 3u}) {
    ASSERT_TRUE(lines.next(line));
    EXPECT_TRUE(line == long_line) << line.size();
    EXPECT_EQ(lines.number(), number);
  }
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "last");
  EXPECT_FALSE(lines.next(line));
}

TEST_P(LineLengths, ComeJoined) {
  const std::string half(GetParam() / 2, 'x');
  const tests::TemporaryFolder folder;
  LineReader lines(folder.write("lines", half + "\\\n" + half + "\nlast"));
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_TRUE(line == half + "  " + half) << line.size();
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "last");
  EXPECT_EQ(lines.number(), 3u);
}

INSTANTIATE_TEST_SUITE_P(LineReader, LineLengths,
                         testing::Values(0, 1, 65'529, 65'530, 65'535, 65'536, 65'537, 131'072, 200'000, 524'288,
                                         LineReader::longest_line - 8));

TEST(LineReader, RefusesALineThatIsTooLong) {
  const tests::TemporaryFolder folder;
  LineReader lines(folder.write("lines", "first\n" + std::string(LineReader::longest_line + 1, 'x') + "\n"));
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_THROW(lines.next(line), std::length_error);
  EXPECT_EQ(lines.number(), 2u);
}

}  // namespace
