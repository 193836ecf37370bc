#include "tests/cli/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>
#include <utility>

namespace cli::test {
namespace {

/// Returns the test's own environment with these changes.
Words environment_with(const Words& changes) {
  Words all = changes;
  for (char** entry = environ; *entry; ++entry) {
    const std::string line = *entry, name = line.substr(0, line.find('=') + 1);
    if (std::ranges::none_of(changes, [&](const std::string& change) { return change.starts_with(name); }))
      all.push_back(line);
  }
  return all;
}

/// Returns pointers to the strings, and a null pointer, as C requires. The strings must outlive them.
std::vector<char*> pointers(Words& strings) {
  std::vector<char*> list;
  for (std::string& string : strings) list.push_back(string.data());
  list.push_back(nullptr);
  return list;
}

}  // namespace

Process::Process(const Words& arguments, const std::filesystem::path& where, const Words& environment,
                 const std::filesystem::path& out, const std::filesystem::path& err)
    : out_(out.empty() ? folder_.path() / "out" : out), err_(err.empty() ? folder_.path() / "err" : err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const auto& [file, descriptor] : {std::pair(&out_, STDOUT_FILENO), std::pair(&err_, STDERR_FILENO)})
    posix_spawn_file_actions_addopen(&actions, descriptor, file->c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, where.c_str());
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t all;
  sigfillset(&all);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  Words words = with({SBCOLLIDE_PROGRAM}, arguments), variables = environment_with(environment);
  const int error =
      posix_spawn(&id_, SBCOLLIDE_PROGRAM, &actions, &attributes, pointers(words).data(), pointers(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot start " SBCOLLIDE_PROGRAM);
}

bool Process::running() {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

void Process::send(int signal) const { kill(id_, signal); }

Outcome Process::wait() {
  const auto written = [](const std::filesystem::path& file) {
    return std::filesystem::is_regular_file(file) ? read_file(file) : "";
  };
  int status = 0;
  waitpid(id_, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, written(out_), written(err_),
          WIFSIGNALED(status) ? WTERMSIG(status) : 0};
}

Outcome run(const Words& arguments, const std::filesystem::path& where, const Words& environment) {
  return Process(arguments, where, environment).wait();
}

nlohmann::json document(const std::string& command, const Words& arguments, const std::string& err) {
  const Outcome o = run(with({command, "--json"}, arguments));
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, err);
  nlohmann::json parsed = nlohmann::json::parse(o.out, nullptr, false);  // trailing text is an error, too
  EXPECT_FALSE(parsed.is_discarded()) << o.out.substr(0, 200);
  return parsed;
}

void expect_refused(const Words& arguments, const Words& words, const Words& environment) {
  SCOPED_TRACE(testing::PrintToString(arguments));
  const Outcome o = run(arguments, "/", environment);
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(o.out, "");
  EXPECT_TRUE(o.err.ends_with('\n'));
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  for (const std::string& word : words) EXPECT_NE(o.err.find(word), std::string::npos) << word << " in: " << o.err;
}

std::string read_file(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::set<std::string> file_names(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

}  // namespace cli::test
