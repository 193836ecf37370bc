#!/usr/bin/env bash
# What takes longer than a commit should wait: other compilers and builds, sanitizers, coverage, long soaks and fuzzing.
# Usage: tests/checks.sh NAME...     with names of the list below, or all
#   debug      Debug, with g++ and with clang++: the tests of collide/ and of the libraries' interfaces, and two frames of
#              every scene but drop-3000 by every integrator. The solver's tests would take a hundred times as long as
#              with -O3
#   ci-clang   clang++, each file and header on its own (what one lacks shows only here), warnings are errors, all tests
#   headless   without any graphics package, all tests
#   asan       address and undefined-behaviour sanitizers, all tests
#   tsan       thread sanitizer, all tests
#   coverage   lines of collide/ and softbody/ that their tests run: at least 95 %, what is missing by file and line
#   soak       600 simulated seconds of every scene, or SOAK_SECONDS of the environment, changed at random every second;
#              a bounded one is among the tests of every preset with graphics, those with sanitizers included
#   fuzz       300 seconds of every fuzz target, or FUZZ_SECONDS of the environment
#   debian-12  README's two commands in a new root of that Debian below build/, without a display; needs to be root
#   debian-13  the same
#   install    the program and the static libraries, installed and moved, the shared ones, and those of Debug; examples of
#              their use
#   package-12 Debian packages, made in an empty system of that Debian; installed, used and removed in another; as root
#   package-13 the same
#   bundle     one tar.gz for any Linux, made in an empty system of Debian 12; used in empty ones of Debian 12 and 13 and of
#              Ubuntu 22.04; as root
#   web        the page, made into build/web in a system of Debian 13 below build/, which is kept; tried there in Chromium
#              and compared with the release; as root
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/steps.sh"
all=(debug ci-clang headless asan tsan coverage soak fuzz debian-12 debian-13 install package-12 package-13 bundle web)

usage() { fail "Usage: tests/checks.sh NAME...   with names of: ${all[*]}, or all"; }

# From nothing: of files that are joined otherwise now, old notes would count all lines as not run.
build_for_coverage() {
  rm -rf "$root/build/coverage"
  build coverage test_collide -DBUILD_TESTING=ON && build coverage test_softbody
}

run_for_coverage() {
  cd "$root/build/coverage"
  bin/test_collide --gtest_brief=1 && bin/test_softbody --gtest_brief=1
}

report_coverage() {
  cd "$root"
  gcovr --root . --object-directory build/coverage --filter collide/ --filter softbody/ --exclude-throw-branches \
    --fail-under-line 95 --sort-percentage build/coverage
}

coverage() {
  install_missing gcovr
  step "coverage: build" build_for_coverage && step "coverage: tests" run_for_coverage && step "coverage" report_coverage
}

# A process for each scene, each of two threads: more at once than processors bear would wait for one another's.
run_soak() {
  cd "$root/build/release"
  for scene in "$root"/assets/scenes/*.toml; do basename "$scene" .toml; done |
    LP_NUM_THREADS=0 xargs --max-args=1 --max-procs="$((($(nproc) + 1) / 2))" bin/soak "${SOAK_SECONDS:-600}"
}

soak() { step "soak: build" build release soak -DBUILD_TESTING=ON && step "soak" run_soak; }

# run_fuzzer NAME: from its corpus on; what it finds goes into the folder of the build. For many inputs
# a second: the file that readers are given anew for each stays in memory, quick inputs are tried more often than slow
# ones, allocations are noted without who asked for them, which a find that is run again shows, and leaks are looked for
# at the end, not by running all that leaves something behind a second time.
run_fuzzer() {
  cd "$root/build/fuzz"
  mkdir -p "found/$1"
  TMPDIR=/dev/shm ASAN_OPTIONS=malloc_context_size=1 "bin/fuzz_$1" -max_total_time="${FUZZ_SECONDS:-300}" -timeout=60 -rss_limit_mb=4096 \
    -detect_leaks=0 -entropic_scale_per_exec_time=1 -artifact_prefix="found/$1/" -print_final_stats=1 \
    "found/$1" "$root/tests/fuzz/corpus/$1"
}

fuzz() {
  install_missing clang
  step "fuzz: build" build fuzz all -DBUILD_TESTING=ON || return
  local target
  for target in "$root"/tests/fuzz/corpus/*/; do
    target=$(basename "$target")
    step "fuzz: $target" run_fuzzer "$target" || true
  done
}

# make_root SUITE FOLDER [MIRROR [DEBOOTSTRAP OPTION...]]: a system of that Debian with nothing but these sources, from
# where apt gets this one's packages, or from that mirror.
make_root() {
  [ "$(id -u)" -eq 0 ] || fail "Only root can make a root folder: run this as root"
  install_missing debootstrap
  command -v debootstrap >/dev/null || fail "debootstrap is missing: install it"
  rm -rf --one-file-system "$2"
  mkdir -p "$2/sbcollide"
  local mirror=${3:-}
  [ -n "$mirror" ] || mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' 'Created-By: Packages' | head -n 1)
  # Apart, so that nothing that it mounts stays if it is stopped.
  unshare --mount debootstrap --variant=minbase "${@:4}" "$1" "$2" ${mirror:+"$mirror"} >"$2.log" ||
    fail "debootstrap failed; the whole log is $2.log"
  apt-config dump | grep '^Acquire::' >"$2/etc/apt/apt.conf.d/90host"
  copy_sources "$2"
}

# copy_sources FOLDER: into a root folder, in place of those there; what is built there stays.
copy_sources() {
  find "$1/sbcollide" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  tar -C "$root" --exclude=./build --exclude=./out --exclude=./.git -c . | tar -C "$1/sbcollide" -x
}

# in_root FOLDER COMMAND...: with its own processes, which end with it, and of the environment only the way to packages:
# so without a display.
in_root() {
  local folder=$1
  shift
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin $(env | grep -i '^https\?_proxy=') \
    unshare --mount --pid --fork --kill-child --root="$folder" --mount-proc "$@"
}

# debian NAME SUITE
debian() {
  local folder=$root/build/$1
  step "$1: root" make_root "$2" "$folder" && step "$1: app" in_root "$folder" /sbcollide/app/run.sh &&
    step "$1: tests" in_root "$folder" /sbcollide/tests/run.sh
}

# install_and_use PRESET: by somebody who keeps new files for himself, into a folder that is then moved, and that nobody
# may write to.
install_and_use() {
  local closed folder=$root/build/$1/installed
  chmod -R u+w "$folder" 2>/dev/null || true
  rm -rf "$folder" && mkdir "$folder"
  (umask 077 && cmake --install "$root/build/$1" --prefix "$folder/first") >"$folder.log"
  closed=$(find "$folder/first" -type d ! -perm 755)
  [ -z "$closed" ] || fail "not everybody may enter $closed"
  mv "$folder/first" "$folder/another place"
  chmod -R a-w "$folder/another place"
  # Assertions and notes for debuggers name the sources.
  [ "$1" = debug ] || ! grep -qF "$root" "$folder/another place/bin/sbcollide" || fail "the program knows where its sources are"
  "$root/tests/install.sh" "$folder/another place"
}

install_all() {
  install_missing desktop-file-utils appstream
  local preset
  for preset in release shared debug; do
    step "$preset: build" build "$preset" all -DBUILD_TESTING=OFF && step "$preset: install" install_and_use "$preset"
  done
}

make_package() { in_root "$1" bash -c '. /sbcollide/app/setup.sh && install_missing "${program_packages[@]}" dpkg-dev file &&
  umask 077 && build release package -DBUILD_TESTING=OFF'; }

use_package() {
  mkdir "$2/packages"
  cp "$1"/sbcollide/build/release/*.deb "$2"/sbcollide/tests/{install,package}.sh "$2/packages"
  rm -r "$2/sbcollide"
  in_root "$2" bash /packages/package.sh /packages
}

# package NAME SUITE
package() {
  local maker=$root/build/$1 user=$root/build/$1-user
  step "$1: root" make_root "$2" "$maker" && step "$1: build" make_package "$maker" &&
    step "$1: root" make_root "$2" "$user" && step "$1: use" use_package "$maker" "$user"
}

make_bundle() { in_root "$1" bash -c '. /sbcollide/app/setup.sh && install_missing "${program_packages[@]}" &&
  umask 077 && build bundle package'; }

# use_bundle MAKER USER: in the other root.
use_bundle() {
  local file row
  file=$(basename "$1"/sbcollide/build/bundle/sbcollide-*.tar.gz)
  row=$(grep '^shapes vertex-vertex' "$root/tests/hashes/hashes.txt")
  mkdir "$2/bundle"
  cp "$1/sbcollide/build/bundle/$file" "$2/sbcollide/tests/bundle.sh" "$2/bundle"
  rm -r "$2/sbcollide"
  in_root "$2" bash /bundle/bundle.sh "/bundle/$file" $row
}

# try_bundle MAKER SUITE [MIRROR [DEBOOTSTRAP OPTION...]]
try_bundle() {
  local user=$root/build/bundle-user
  step "bundle: $2" make_root "$2" "$user" "${@:3}" && step "bundle: use" use_bundle "$1" "$user" || true
}

bundle() {
  local maker=$root/build/bundle-root ubuntu=http://archive.ubuntu.com/ubuntu
  step "bundle: root" make_root bookworm "$maker" && step "bundle: build" make_bundle "$maker" || return
  try_bundle "$maker" bookworm
  try_bundle "$maker" trixie
  if wget -q --spider "$ubuntu/dists/jammy/Release"; then
    try_bundle "$maker" jammy "$ubuntu" --components=main,universe
  else
    leave_out "bundle: jammy" "$ubuntu cannot be reached"
  fi
}

make_libraries() {
  in_root "$1" /sbcollide/app/web/libraries.sh >"$1.log" 2>&1 || fail "libraries.sh failed; the whole log is $1.log"
  cp "$root/app/web/libraries.sh" "$1/libraries/made-by"
}

make_page() {
  copy_sources "$1"
  in_root "$1" bash -c '. /sbcollide/app/setup.sh && build web sbcollide' || return
  rm -rf "$root/build/web" && mkdir "$root/build/web"
  find "$1/sbcollide/build/web/bin" -maxdepth 1 -type f -exec cp -t "$root/build/web" {} +
}

# try_page FOLDER: against what the release writes.
try_page() {
  local there=$1/desktop program=$root/build/release/bin/sbcollide
  rm -rf "$there" && mkdir "$there"
  "$program" simulate --scene drop --frames 310 --capture 290,300,310 --size 1280x720 --obj-every 138 --out "$there" &&
    "$program" simulate --scene drop --frames 300 --oracle --json >"$there/simulate.json" &&
    "$program" simulate --scene D --frames 300 --threads 1 --json >"$there/D.json" &&
    "$program" detect --method all --tolerance 0.1 --cell-size 0.2 --json "$there/frame_0138.obj" >"$there/detect.json" &&
    in_root "$1" /sbcollide/tests/web/page.mjs /sbcollide/build/web/bin /desktop /sbcollide/build/web
}

# The system and its libraries are kept as long as the script that made them is the same.
web() {
  local folder=$root/build/web-root
  if ! cmp -s "$root/app/web/libraries.sh" "$folder/libraries/made-by"; then
    (make_root trixie "$folder") || { leave_out "web" "no system of Debian 13 can be made here" && return; }
    step "web: libraries" make_libraries "$folder" || return
  fi
  step "web: build" make_page "$folder" || return
  step "web: hashes" in_root "$folder" /sbcollide/tests/web/hashes.sh /sbcollide/build/web/bin/sbcollide.js || true
  step "web: release" build release sbcollide && step "web: page" try_page "$folder"
}

# pass_registers PRESET: no file that was compiled has a function that passes registers as if its target had none. What
# is not forced inline shows it, with g++, which tells of the first function of a file only.
pass_registers() { ! grep -B 2 'note: the ABI for passing parameters' "$root/build/$1/build.log"; }

# run_debug PRESET
run_debug() {
  cd "$root/build/$1"
  bin/test_api --gtest_brief=1 && bin/test_collide --gtest_brief=1 || return
  local scene integrator
  for scene in $(bin/sbcollide list scenes | awk '$1 != "drop-3000" {print $1}'); do
    for integrator in $(bin/sbcollide list integrators | awk '{print $1}'); do
      bin/sbcollide simulate --scene "$scene" --integrator "$integrator" --frames 2 >/dev/null || [ $? -eq 2 ] ||
        fail "simulate --scene $scene --integrator $integrator failed"  # 2: it refuses them together
    done
  done
}

debug() { step "$1: build" build "$1" all -DBUILD_TESTING=ON && step "$1: run" run_debug "$1"; }

check() {
  case $1 in
    debug)
      debug debug && step "debug: registers" pass_registers debug || true
      install_missing clang && debug debug-clang
      ;;
    ci-clang) install_missing clang && build_and_test ci-clang ;;
    headless | asan | tsan) build_and_test "$1" ;;
    coverage | soak | fuzz) "$1" ;;
    debian-12) debian "$1" bookworm ;;
    debian-13) debian "$1" trixie ;;
    install) install_all ;;
    package-12) package "$1" bookworm ;;
    package-13) package "$1" trixie ;;
    bundle | web) "$1" ;;
    *) usage ;;
  esac
}

[ $# -gt 0 ] || usage
[ "$*" != all ] || set -- "${all[@]}"
install_missing "${test_packages[@]}"
for name in "$@"; do check "$name" || true; done
finish
