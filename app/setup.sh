# Shared by app/run.sh and tests/run.sh: installs what is missing and builds. Source it; it changes no directory.

root=$(CDPATH='' cd -- "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# What the program is built from and runs on (Debian 12 and 13, Ubuntu 24.04).
program_packages=(g++ cmake ninja-build pkg-config libglfw3-dev libglew-dev libglm-dev libimgui-dev libgl-dev
  libegl-dev libgl1-mesa-dri libdecor-0-plugin-1-cairo libpng-dev libwebp-dev libhwy-dev libgmp-dev
  libeigen3-dev libmeshoptimizer-dev libtomlplusplus-dev libcli11-dev libfmt-dev nlohmann-json3-dev fonts-inter gnuplot-nox)

say() { printf '%s\n' "$*" >&2; }
fail() { say "$*"; exit 2; }

# install_missing PACKAGE...: asks the package manager only for packages that are not there.
install_missing() {
  command -v dpkg-query >/dev/null || { say "This is no Debian or Ubuntu: install these yourself if the build misses them: $*"; return; }
  local missing=() package
  for package in "$@"; do
    # One line an architecture: installed for any of them will do.
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "Missing packages; as root, run: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  say "Installing ${#missing[@]} missing packages: ${missing[*]}"
  local log
  log=$("${as_root[@]}" apt-get update -qq 2>&1) || fail "apt-get update failed: $log"
  log=$("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    "${missing[@]}" 2>&1) || fail "apt-get install failed: $log"
}

# build PRESET TARGET [CMAKE OPTION...]: configures and builds into build/PRESET.
build() {
  local preset=$1 target=$2
  shift 2
  local folder=$root/build/$preset
  mkdir -p "$folder"
  local log=$folder/build.log cache=$folder/CMakeCache.txt
  # CMake refuses a folder that it set up for other sources: those from before a checkout was moved or copied with it.
  [ ! -e "$cache" ] || [ "$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$cache")" -ef "$root" ] || set -- --fresh "$@"
  say "Building into build/$preset (the first time takes some minutes) ..."
  if ! (cd "$root" && cmake --preset "$preset" "$@" && cmake --build "build/$preset" --target "$target") >"$log" 2>&1; then
    tail -n 60 "$log" >&2
    fail "The build failed; the whole log is $log"
  fi
}
