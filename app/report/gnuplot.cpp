#include "app/report/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>

extern char** environ;

namespace app::report {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Returns a file without a name, for input or output of the child. It holds any amount, so that neither side waits.
File temporary() {
  File file(std::tmpfile(), &std::fclose);
  if (!file) throw std::runtime_error("gnuplot: no temporary file can be made; is the disk full?");
  return file;
}

File holding(const std::string& text) {
  File file = temporary();
  std::fwrite(text.data(), 1, text.size(), file.get());
  std::rewind(file.get());  // for the child, which shares the position; flushes, too
  return file;
}

std::string contents(std::FILE* file) {
  std::string text;
  std::array<char, 4096> part;
  std::rewind(file);
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), file)) text.append(part.data(), size);
  return text;
}

const char* terminal(Picture kind) {
  return kind == Picture::svg ? "set terminal svg size 960,720 font 'sans-serif,14' background 'white' noenhanced\n"
                              : "set terminal pngcairo size 960,720 font 'sans,11' background 'white' noenhanced\n";
}

}  // namespace

std::string draw(const std::string& script, Picture kind) {
  const File in = holding(terminal(kind) + script), out = temporary();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(in.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::array<std::string, 2> words{"gnuplot", "-"};
  char* const argv[] = {words[0].data(), words[1].data(), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("gnuplot cannot be started; install gnuplot-nox");
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  std::string picture = contents(out.get());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || picture.empty())
    throw std::runtime_error("gnuplot could not draw a plot; it needs version 5.2 or later");
  return picture;
}

}  // namespace app::report
