#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests, those with a real window under Xvfb included.
# Usage: tests/run.sh [PRESET]   (release by default; ci, ci-clang, asan, tsan, debug, headless: see CMakePresets.json)
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../app/setup.sh"
preset=${1:-release}

packages=("${program_packages[@]}" libgtest-dev xvfb xdotool x11-utils)
[ "$preset" != ci-clang ] || packages+=(clang)
install_missing "${packages[@]}"
build "$preset" all -DBUILD_TESTING=ON
cd "$root"
exec ctest --preset "$preset" --parallel "$(nproc)"
