#!/usr/bin/env bash
# Checks an installed program and its libraries as their users have them; knows nothing of the checkout.
# Usage: tests/install.sh PREFIX
set -euo pipefail
prefix=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "install: $1" >&2; exit 1; }

# Through a symbolic link, from another folder, by a user who may not write where the program is.
as_user=()
if [ "$(id -u)" -eq 0 ]; then as_user=(setpriv --reuid 65534 --regid 65534 --clear-groups env HOME="$work/home"); fi
mkdir "$work/home" "$work/out"
chmod 777 "$work" "$work/home" "$work/out"
ln -s "$prefix/bin/sbcollide" "$work/program"
program() { (cd / && "${as_user[@]}" "$work/program" "$@"); }

share=$prefix/share
program --version
program list scenes | grep -q '^drop' || fail "the program does not find its scenes"
program simulate --scene D --frames 90 --obj-every 90 --capture 90 --size 320x180 --out "$work/out" >/dev/null
[ -s "$work/out/frame_0090.png" ] || fail "there is no picture"
program report detection --quick --out "$work/out/report" >/dev/null
[ "$(find "$work/out/report" -name '*.png' -o -name '*.svg' | wc -l)" -gt 0 ] || fail "the report has no plot"
program new-method "$work/out/mine.c" >/dev/null
for guest in "$work/out/mine.c" "$share/doc/sbcollide/app/package/examples/guests/hash_grid.c"; do
  program detect "$work/out/frame_0090.obj" --tolerance 0.1 --method all --guest "$guest" >"$work/guest"
  grep -Eq '^guest:my-[a-z]+ +[1-9][0-9]* +1 +1 ' "$work/guest" || fail "$guest is compared wrongly"
done
if command -v xvfb-run >/dev/null; then
  command=$(sed -n 's/^Exec=//p' "$share/applications/sbcollide.desktop")
  status=0
  (cd / && PATH=$prefix/bin:$PATH timeout 10 "${as_user[@]}" xvfb-run --auto-servernum "$command") || status=$?
  [ "$status" -eq 124 ] || fail "the demo ended by itself, status $status"
fi
gzip -cd "$share/man/man1/sbcollide.1.gz" | grep -q '^\.B .*tolerance' || fail "the man page names no option"
if command -v desktop-file-validate >/dev/null; then desktop-file-validate "$share"/applications/sbcollide.desktop; fi
# Errors only: some versions also fail for want of a home page.
if command -v appstreamcli >/dev/null; then
  { appstreamcli validate --no-net "$share"/metainfo/org.sbcollide.*.xml || true; } | { ! grep '^ *E:'; } || fail "metadata of AppStream"
fi

# The examples, with nothing but what is installed.
[ -d "$prefix/include/sbcollide" ] || exit 0
cp -r "$share/doc/libsbcollide-dev/examples" "$work/examples"
cmake -S "$work/examples" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" >"$work/log" && cmake --build "$work/build" >>"$work/log" ||
  { cat "$work/log"; fail "the examples cannot be built"; }
"$work/build/find_contacts" "$work/out/frame_0090.obj" 0.1 >"$work/found"
program detect "$work/out/frame_0090.obj" --tolerance 0.1 --contacts "$work/out/contacts.csv" >/dev/null
awk -F, 'NR > 1 {print $2 " of body " $4 ", " $3 " of body " $5}' "$work/out/contacts.csv" | cmp - "$work/found" ||
  fail "find_contacts and the program find other contacts"
[ -s "$work/found" ] || fail "there are no contacts"
"$work/build/drop_ball" | grep -q ' contacts' || fail "drop_ball"
"$work/build/two_triangles" | grep -qx 'vertices 0 and 3' || fail "two_triangles"
if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
  private=(--static)
  if [ -e "$prefix/lib/libsbcollide-softbody.so" ]; then private=() && export PKG_CONFIG_LIBDIR=; fi  # no other packages
  flags=$(pkg-config "${private[@]}" --cflags --libs sbcollide) || fail "pkg-config"
  eval cc \"\$work/examples/two_triangles.c\" -o \"\$work/by_pkg_config\" "$flags"
  LD_LIBRARY_PATH=$prefix/lib "$work/by_pkg_config" | grep -qx 'vertices 0 and 3' || fail "two_triangles by pkg-config"
fi
if [ -e "$prefix/lib/libsbcollide-softbody.so" ] && command -v python3 >/dev/null; then
  python3 "$work/examples/falling.py" "$prefix" | grep -q '^1.00 s: ' || fail "falling.py"
fi
echo "install: all is well"
