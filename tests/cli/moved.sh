#!/bin/bash
# A checkout that is moved or copied together with its build folder builds and runs where it is now.
# Usage: moved.sh PROGRAM SOURCES
set -eu
program=$(realpath "$1")
sources=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "moved: $1" >&2; exit 1; }

# A project that is made in no time, built as the scripts build the program.
mkdir -p "$work/first/app/package" "$work/first/assets/scenes"
cp "$sources/app/setup.sh" "$work/first/app"
cp "$sources/app/package/link_data.cmake" "$work/first/app/package"
cp "$sources/CMakePresets.json" "$work/first"
cat >"$work/first/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(small NONE)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
include(app/package/link_data.cmake)
file(WRITE ${CMAKE_BINARY_DIR}/built_for ${CMAKE_SOURCE_DIR})
add_custom_target(small)
END
build_in() {
  (. "$1/app/setup.sh"; build release small)
  [ "$(cat "$1/build/release/built_for")" = "$1" ] || fail "$1 is not what was built"
}
# The program reads the scenes of its own checkout.
lists() {
  [ "$("$1/build/release/bin/sbcollide" list scenes | cut -f 1)" = "$2" ] || fail "$1 has another's scenes"
}

build_in "$work/first"
cp "$program" "$work/first/build/release/bin/sbcollide"
cp "$sources/assets/scenes/A.toml" "$work/first/assets/scenes/scene-of-first.toml"
lists "$work/first" scene-of-first
cp -r "$work/first" "$work/the copy"
mv "$work/the copy/assets/scenes/scene-of-first.toml" "$work/the copy/assets/scenes/scene-of-copy.toml"
lists "$work/the copy" scene-of-copy
build_in "$work/the copy"
mv "$work/first" "$work/moved"
build_in "$work/moved"
lists "$work/moved" scene-of-first
# By another name it is the same checkout: nothing begins anew.
ln -s moved "$work/link"
touch "$work/moved/build/release/CMakeFiles/kept"
(. "$work/link/app/setup.sh"; build release small)
[ -e "$work/moved/build/release/CMakeFiles/kept" ] || fail "a link to the checkout was taken for another one"
