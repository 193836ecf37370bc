#!/usr/bin/env bash
# Checks a bundle as its users have it, on a system of Debian or Ubuntu. Changes the system: for a root folder of its own,
# see tests/checks.sh.
# Usage: tests/bundle.sh FILE.tar.gz SCENE CONTACT-SURFACE INTEGRATOR FRAMES HASH    the latter as in tests/hashes
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive
fail() { echo "bundle: $1" >&2; exit 1; }
# What every desktop has, and a display.
apt-get update -qq
apt-get install -y -qq --no-install-recommends libegl1 libgl1 libgl1-mesa-dri libx11-6 xvfb xauth >/dev/null

folder="/srv/some folder"
mkdir -p "$folder" /srv/out
tar -C "$folder" -xf "$1"
home=$folder/$(basename "$1" .tar.gz)
closed=$(find "$home" ! -type l ! -perm -o=r)
[ -z "$closed" ] || fail "not everybody may read $closed"
chmod -R a-w "$folder"
chmod 777 /srv/out
for file in LICENSE licences/README licences/libgmp10 licences/LGPL-3 licences/fonts-inter; do
  [ -s "$home/share/doc/sbcollide/$file" ] || fail "$file is missing"
done
[ ! -e "$home/share/doc/sbcollide/README.md" ] || fail "it has pages"

# Through a symbolic link, from another folder, by a user who may write neither there nor in a home.
ln -s "$home/bin/sbcollide" /usr/local/bin/sbcollide
export PATH=/usr/local/bin:$PATH
as_user=(setpriv --reuid 65534 --regid 65534 --clear-groups env HOME=/nowhere)
program() { (cd / && "${as_user[@]}" sbcollide "$@"); }
program --version
carried=$(LD_TRACE_LOADED_OBJECTS=1 "$home/bin/sbcollide")
! grep 'not found' <<<"$carried" || fail "a library is missing"
for library in libgmp libglfw libGLEW libpng16; do
  grep -qF "$library" <<<"$(grep -F "$folder" <<<"$carried")" || fail "$library is the system's"
done
for library in libstdc++ libGL libX11 libz; do
  ! grep -qF "$library.so" <<<"$(grep -F "$folder" <<<"$carried")" || fail "$library is not the system's"
done
newest=$(cat "$home"/bin/* "$home"/lib/* | grep -aoE 'GLIBC_2\.[0-9]+' | sort -Vu | tail -n 1)
[ "$newest" = "$(printf '%s\n' "$newest" GLIBC_2.35 | sort -V | head -n 1)" ] || fail "it needs $newest: make it on Debian 12"
program simulate --scene "$2" --contact-surface "$3" --integrator "$4" --frames "$5" --capture "$5" --size 320x180 \
  --out /srv/out --json >/srv/out/state.json
hash=$(grep -oP '"state_hash": *"\K[0-9a-f]*' /srv/out/state.json)
[ "$hash" = "$6" ] || fail "the state of $2 is $hash, not $6"
[ "$(tail -c +2 "$(printf '/srv/out/frame_%04d.png' "$5")" | head -c 3)" = PNG ] || fail "there is no picture"
status=0
(cd / && timeout 15 "${as_user[@]}" HOME=/srv/out xvfb-run --auto-servernum sbcollide) || status=$?
[ "$status" -eq 124 ] || fail "the demo ended by itself, status $status"
echo "bundle: all is well"
