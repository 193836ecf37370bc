#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests, those with a real window under Xvfb included.
# Usage: tests/run.sh [PRESET]   (release by default; ci, ci-clang, asan, tsan, debug, headless: see CMakePresets.json)
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../app/setup.sh"
preset=${1:-release}

packages=("${program_packages[@]}" libgtest-dev xvfb xauth xdotool)
[ "$preset" != ci-clang ] || packages+=(clang)
install_missing "${packages[@]}"
build "$preset" all -DBUILD_TESTING=ON
cd "$root"
# A display of its own for the tests with a window, whether there is a screen or not.
exec xvfb-run --auto-servernum --server-args="-screen 0 1600x1000x24" ctest --preset "$preset" --parallel "$(nproc)"
