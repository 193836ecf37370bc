#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests, those with a real window under Xvfb included, and checks
# the sources; says what took how long. What takes longer than a commit should wait is in tests/checks.sh.
# Usage: tests/run.sh [PRESET]   (release by default; any other of CMakePresets.json that builds all)
# The sources are held to one version's verdict, as others format and warn differently. Where that version cannot be had,
# or cannot read the system's C++ library, those checks are left out; the preset ci, for CI, leaves nothing out.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/steps.sh"
preset=${1:-release}

check_format() {
  cd "$root"
  sources "*.cpp" "*.h" | xargs -0 clang-format-14 --dry-run -Werror
}
# As the preset compiles them: most of them many at a time, which reads the headers that they share only once. But
# kernels for one of Highway's targets: their text is the same for each.
check_tidy() {
  cd "$root/build/$preset"
  sed -n 's/^ *"file": "\(.*\)",\?$/\1/p' compile_commands.json | grep -v -e "^$root/tests/" -e "^$PWD/tests/" | tr '\n' '\0' |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 -p . --quiet --extra-arg=-DHWY_COMPILE_ONLY_STATIC 2>clang-tidy.log
}

# sources PATTERN...: files below the folders of code, from the root of the checkout, each ended by a zero byte.
sources() {
  local pattern names=()
  for pattern in "$@"; do names+=(-o -name "$pattern"); done
  find collide softbody engine app tests -type f \( "${names[@]:1}" \) -print0
}

# lint TOOL CHECK TRIAL...: the check, if a trial of the tool goes well.
lint() {
  local tool=$1 check=$2
  shift 2
  if [ "$preset" = ci ] || "$@" >/dev/null 2>&1; then
    step "$tool" "$check" || true
  else
    leave_out "$tool" "$tool-14 cannot be had here, or cannot read this system's C++ library"
  fi
}

install_missing "${test_packages[@]}"
for tool in clang-format-14 clang-tidy-14; do
  if [ "$preset" = ci ] || apt-cache show "$tool" >/dev/null 2>&1; then install_missing "$tool"; fi
done
step "build" build "$preset" all -DBUILD_TESTING=ON || finish
step "tests" run_tests "$preset" || true
step "rooms" "$root/tests/rooms.sh" || true
lint clang-format check_format clang-format-14 --version
lint clang-tidy check_tidy clang-tidy-14 /dev/null -- -x c++ -std=c++20 -include bits/stdc++.h
finish
