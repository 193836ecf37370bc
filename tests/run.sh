#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests, those with a real window under Xvfb included, and checks
# the sources; says what took how long. What takes longer than a commit should wait is in tests/checks.sh.
# Usage: tests/run.sh [PRESET]   (release by default; any other of CMakePresets.json that builds all)
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/steps.sh"
preset=${1:-release}

# The tools in the version whose verdict the sources are held to: others format and warn differently.
check_format() { sources "*.cpp" "*.h" | xargs -0 clang-format-14 --dry-run -Werror; }
# As the preset compiles them: most of them many at a time, which reads the headers that they share only once.
check_tidy() {
  cd "$root/build/$preset"
  sed -n 's/^ *"file": "\(.*\)",\?$/\1/p' compile_commands.json | grep -v -e "^$root/tests/" -e "^$PWD/tests/" | tr '\n' '\0' |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 -p . --quiet 2>clang-tidy.log
}

# sources PATTERN...: files below the folders of code, each ended by a zero byte.
sources() {
  cd "$root"
  local pattern names=()
  for pattern in "$@"; do names+=(-o -name "$pattern"); done
  find collide softbody engine app tests -type f \( "${names[@]:1}" \) -print0
}

install_missing "${test_packages[@]}" clang-format-14 clang-tidy-14
step "build" build "$preset" all -DBUILD_TESTING=ON || finish
step "tests" run_tests "$preset" || true
step "clang-format" check_format || true
step "clang-tidy" check_tidy || true
finish
