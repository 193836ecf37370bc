#!/usr/bin/env bash
# Builds the libraries of the page in /libraries, with emscripten, from Debian's packages of their sources, and writes
# there what CMake's find_package() reads. For a root folder of Debian 13 of its own, as root: see tests/checks.sh, web.
set -euo pipefail
prefix=/libraries
flags=(-O3 -DNDEBUG -msimd128 -fwasm-exceptions)
mkdir -p "$prefix"/{include,lib/cmake,sources}
cd "$prefix/sources"

# The coarse meshes of Debian 12's meshoptimizer are those of tests/hashes.
mirror=$(awk '$1 == "deb" {print $2; exit}' /etc/apt/sources.list)
printf 'deb-src %s %s main\n' "$mirror" bookworm "$mirror" trixie >/etc/apt/sources.list.d/sources.list
apt-get update -qq
DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends emscripten chromium cmake ninja-build \
  gcc libc6-dev make m4 dpkg-dev fonts-inter libglm-dev libeigen3-dev libfmt-dev libtomlplusplus-dev libcli11-dev \
  nlohmann-json3-dev >apt.log

# unpack NAME[/SUITE]: into the folder NAME. Some mirrors lack Debian's changes to a source, then as its authors wrote it.
unpack() {
  local name=${1%/*}
  [ ! -e "$name" ] || return 0
  apt-get source -qq --download-only "$1" 2>"$name.log" || cat "$name.log"
  dpkg-source -x "$name"_*.dsc "$name" || tar -xf "$name"_*.orig.tar.* --one-top-level="$name" --strip-components=1
}

# archive NAME COMPILER FLAG... -- SOURCE...: makes lib/libNAME.a of the sources.
archive() {
  local name=$1 compiler=("$2" "${flags[@]}") objects=()
  shift 2
  while [ "$1" != -- ]; do compiler+=("$1") && shift; done
  shift
  mkdir -p "objects/$name"
  for source in "$@"; do
    objects+=("objects/$name/$(basename "$source").o")
    "${compiler[@]}" -c "$source" -o "${objects[-1]}"
  done
  rm -f "$prefix/lib/lib$name.a"
  emar rcs "$prefix/lib/lib$name.a" "${objects[@]}"
}

# config PACKAGE TARGETS [COMMAND ARGUMENTS]: what find_package(PACKAGE) reads; each target gets target_COMMAND().
config() {
  local folder=$prefix/lib/cmake/$1 target
  mkdir -p "$folder"
  echo 'set(PACKAGE_VERSION_COMPATIBLE TRUE)' >"$folder/$1ConfigVersion.cmake"
  echo 'include_guard(GLOBAL)' >"$folder/$1Config.cmake"
  for target in $2; do
    echo "add_library($target INTERFACE IMPORTED GLOBAL)"
    echo "target_include_directories($target SYSTEM INTERFACE $prefix/include)"
    [ -z "${3:-}" ] || echo "target_$3($target $4)"
  done >>"$folder/$1Config.cmake"
}

for name in gmp highway imgui libpng1.6 zlib meshoptimizer/bookworm; do unpack "$name"; done

# Without Debian's page for it there is no Makefile for the manual.
make_gmp() {
  cd gmp
  mkdir -p doc && touch doc/Makefile.in
  emconfigure ./configure --host=none --disable-assembly --enable-cxx --disable-shared --prefix="$prefix" \
    CFLAGS=-fwasm-exceptions CXXFLAGS=-fwasm-exceptions CC_FOR_BUILD=gcc
  emmake make install CFLAGS="${flags[*]}" CXXFLAGS="${flags[*]}" SUBDIRS="mpn mpz mpq mpf printf scanf rand cxx"
}
make_gmp >gmp.log 2>&1 &
gmp=$!

for folder in CLI eigen3 fmt glm nlohmann toml++; do ln -sfn "/usr/include/$folder" "$prefix/include/$folder"; done
ln -sfn "$prefix"/sources/{highway/hwy,meshoptimizer/src/meshoptimizer.h,libpng1.6/*.h,zlib/*.h,imgui/*.h,imgui/backends} \
  "$prefix/include"
cp libpng1.6/scripts/pnglibconf.h.prebuilt "$prefix/include/pnglibconf.h"
includes=(-I"$prefix/include")
archive hwy em++ "${includes[@]}" -- highway/hwy/{abort,aligned_allocator,per_target,print,targets}.cc
archive meshoptimizer em++ -- meshoptimizer/src/*.cpp
archive imgui em++ "${includes[@]}" -DIMGUI_IMPL_OPENGL_ES3 -- imgui/imgui{,_draw,_tables,_widgets}.cpp \
  imgui/backends/imgui_impl_{glfw,opengl3}.cpp
archive z emcc -DHAVE_UNISTD_H -- zlib/*.c
archive png emcc "${includes[@]}" -- libpng1.6/png{,error,get,mem,pread,read,rio,rtran,rutil,set,trans,wio,write,wtran,wutil}.c
wait "$gmp" || { tail -n 20 gmp.log && exit 1; }

config CLI11 CLI11::CLI11
config Eigen3 Eigen3::Eigen include_directories "SYSTEM INTERFACE $prefix/include/eigen3"
config fmt fmt::fmt compile_definitions 'INTERFACE FMT_HEADER_ONLY'
config glm glm::glm
config hwy hwy::hwy link_libraries "INTERFACE $prefix/lib/libhwy.a"
config imgui imgui::imgui link_libraries "INTERFACE $prefix/lib/libimgui.a"
config meshoptimizer meshoptimizer::meshoptimizer link_libraries "INTERFACE $prefix/lib/libmeshoptimizer.a"
config nlohmann_json nlohmann_json::nlohmann_json
config PNG PNG::PNG link_libraries "INTERFACE $prefix/lib/libpng.a $prefix/lib/libz.a"
config tomlplusplus tomlplusplus::tomlplusplus
# What emscripten itself has, and what a page has not.
config glfw3 glfw link_options 'INTERFACE -sUSE_GLFW=3'
config GLEW GLEW::GLEW link_options 'INTERFACE -sMIN_WEBGL_VERSION=2 -sMAX_WEBGL_VERSION=2'
config OpenGL 'OpenGL::GL OpenGL::EGL'
config WebP 'WebP::webp WebP::libwebpmux'
