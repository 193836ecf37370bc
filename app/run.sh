#!/usr/bin/env bash
# Installs what is missing, builds, and runs the demo with the arguments given. Without a display it runs the scene
# without a window and writes the paper's four pictures.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_missing "${program_packages[@]}"
build release sbcollide -DBUILD_TESTING=OFF
program=$root/build/release/bin/sbcollide

case "${1:-}" in
  simulate | detect | report | list | -h | --help | --version) exec "$program" "$@" ;;
esac
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  exec "$program" "$@"
fi

say "There is no display, so there is no window: running the scene without one ..."
"$program" simulate --frames 800 --capture 100,400,600,800 --out "$root/out" "$@"
say ""
say "Pictures of frames 100, 400, 600 and 800: $root/out/frame_0100.png ... frame_0800.png"
say "For the window, start this in a desktop session, or over ssh -X, or as: xvfb-run -s '-screen 0 1600x1000x24' $0"
