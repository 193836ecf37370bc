// Methods of the user's own on the command line.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/detect_rig.h"
#include "tests/cli/report_rig.h"
#include "tests/guest/wrongs.h"

namespace cli::test {
namespace THIS_FILE {

using nlohmann::json;
using tests::Wrong;

const std::string guest = SBCOLLIDE_HOSTILE_GUEST;

class DetectGuest : public DetectFolder {
 protected:
  static std::string metres(Wrong wrong) { return std::to_string(static_cast<int>(wrong)); }
  const State state = random_state(8);
  const std::string mesh = file("a.obj", state);
};

TEST_F(DetectGuest, FindsTheContactsAndPrintsNothing) {
  EXPECT_EQ(contacts({"--guest", guest, mesh, "--tolerance", "0.07", "--method", "guest:hostile"}),
            oracle(0, state, {.tolerance = 0.07f}));
  const json printing =
      detect({mesh, "--guest", guest, "--tolerance", metres(Wrong::reads_input), "--method", "guest:hostile"});
  EXPECT_GT(printing["frames"][0]["contacts"], 0);
}

TEST_F(DetectGuest, RunsAloneUnlessAMethodIsNamed) {
  const Words one{"detect", mesh, "--tolerance", "0.07", "--guest", guest};
  EXPECT_EQ(json::parse(run(with(one, {"--json"})).out)["method"], "guest:hostile");
  const std::string table = run(one).out;
  EXPECT_NE(table.find("  -            -          -\n"), std::string::npos) << "counts that nobody knows: " << table;
  expect_refused(with(one, {"--guest", guest}), {"--guest: ", "name one by --method"});
}

TEST_F(DetectGuest, IsComparedWithAllOthers) {
  const json right = detect({mesh, "--guest", guest, "--guest", guest, "--tolerance", "0.07", "--method", "all"});
  for (const char* key : {"guest:hostile", "guest:hostile-2"}) {
    const auto row = std::ranges::find_if(right, [&](const json& each) { return each["method"] == key; });
    ASSERT_NE(row, right.end()) << key;
    EXPECT_EQ((*row)["recall"], 1.0);
    EXPECT_EQ((*row)["precision"], 1.0);
    EXPECT_FALSE(row->contains("not_run"));
  }
  const json wrong = detect({mesh, "--guest", guest, "--tolerance", metres(Wrong::abort), "--method", "all"});
  EXPECT_EQ(wrong.back()["not_run"], "hostile_guest.so: ended by signal SIGABRT (Aborted)");
  EXPECT_EQ(wrong.back()["frames"], json::array());
  EXPECT_FALSE(wrong.front().contains("not_run"));
}

TEST_F(DetectGuest, EndsWithOneLineWhereItsMethodFails) {
  for (const auto& [wrong, said] : {std::pair(Wrong::abort, "SIGABRT"), {Wrong::out_of_range, "hands over vertex"}})
    expect_refused({"detect", mesh, "--guest", guest, "--tolerance", metres(wrong), "--method", "guest:hostile"},
                   {"hostile_guest.so: ", said});
}

TEST_F(DetectGuest, IsRefusedWhereItIsNoneOrWouldDriveBodies) {
  const Words detects{"detect", mesh, "--tolerance", "0.07"};
  expect_refused(with(detects, {"--guest", "method.py"}), {"--guest method.py", ".cpp"});
  expect_refused(with(detects, {"--guest", "/none/loop.c"}), {"--guest loop.c: cannot be read"});
  expect_refused(with(detects, {"--guest", folder.write("empty.so", "")}), {"--guest empty.so: "});
  expect_refused({"--guest", guest, "simulate"}, {"--guest", "detect"});
  expect_refused({"report", "contact", "--out", folder.path(), "--guest", guest}, {"--guest", "report detection"});
  expect_refused({"--guest", guest, "--method", "guest:hostile"}, {"guest:hostile", "drives no bodies"});
  expect_refused(with(detects, {"--guest", guest, "--method", "guest:host"}), {"octree, guest:hostile"});
  const std::string none = folder.write("none.c", "int none;\n");
  expect_refused(with(detects, {"--guest", none}), {"--guest none.c: undefined symbol: sbcollide_guest"});

  const std::string broken =
      folder.write("broken.cpp", "#include <sbcollide/method.h>\nint twice = 1;\nint twice = 2;\n");
  const Outcome o = run(with(detects, {"--guest", broken, "--json"}));
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.out, "");
  EXPECT_NE(o.err.find(broken + ":3:5: error: "), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("int twice = 2;\n"), std::string::npos) << "all that the compiler says";
  EXPECT_NE(o.err.find("\nsbcollide: --guest broken.cpp: does not compile: broken.cpp:3:5: error: "), std::string::npos)
      << o.err;
  expect_refused(with(detects, {"--guest", broken}), {"nowhere"}, {"CXX=/nowhere/c++ -Wall"});
}

TEST_F(DetectGuest, HasRowsInTheReport) {
  const std::string out = folder.path() / "out";
  const Outcome report =
      run({"report", "detection", mesh, "--tolerance", "0.07", "--guest", guest, "--quick", "--out", out});
  ASSERT_EQ(report.status, 0) << report.err;
  std::size_t rows = 0;
  for (Row& row : read_csv(out + "/detection.csv")) {
    if (row["method"] != "guest:hostile") continue;
    ++rows;
    EXPECT_EQ(row["recall"], "1");
    EXPECT_EQ(row["coverage"], "unknown");
  }
  EXPECT_EQ(rows, 1u);
}

}  // namespace THIS_FILE
}  // namespace cli::test
