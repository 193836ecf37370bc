#!/bin/bash
# The real program in a real window under Xvfb: keys, a click, resizing, closing, a driver that is reset.
# Usage: window.sh PROGRAM LOST_CONTEXT   (the second is the library of lost_context.cpp)
# Exits 77 (skipped) if the X tools are missing.
set -u
program=$(realpath "$1")
lost_context=$(realpath "$2")
sources=$(realpath "$(dirname "$0")/../..")
work=$(mktemp -d)
pids=()
finish() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null; done
  wait 2>/dev/null
  rm -rf "$work"
}
trap finish EXIT

fail() {
  echo "window: $1" >&2
  sed 's/^/program: /' "$work/err" >&2
  exit 1
}

# Waits until a command succeeds, for up to a minute, as machines may be slow.
until_true() {
  local what=$1
  shift
  for _ in $(seq 600); do
    "$@" && return
    sleep 0.1
  done
  fail "waited in vain: $what"
}

for tool in Xvfb xdotool setxkbmap; do
  command -v $tool >/dev/null || { echo "window: $tool is missing, skipped"; exit 77; }
done

# Xvfb chooses a free display and writes its number. With -noreset it keeps its state when its last client leaves.
Xvfb -displayfd 3 -screen 0 1600x1000x24 -noreset -nolisten tcp 3>"$work/display" >/dev/null 2>&1 &
pids+=($!)
until_true "the X server" test -s "$work/display"
DISPLAY=:$(cat "$work/display")
export XDG_CONFIG_HOME=$work/config  # preferences of its own, not the user's
# For builds with sanitizers: leaks and threads of the driver are not the program's.
export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=0 ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0"

start() {
  "$program" "$@" >"$work/out" 2>"$work/err" &
  demo=$!
  pids+=("$demo")
  until_true "the window" has_window
  sleep 1
  xdotool windowfocus "$window" 2>/dev/null
}
has_window() {
  kill -0 "$demo" 2>/dev/null || fail "the program ended before it had a window"
  window=$(xdotool search --onlyvisible --name "Multi-Level SB Collide" 2>/dev/null | head -1)
  [ -n "$window" ]
}
# The window's queue keeps keys and clicks, with their places, for as many frames as they need.
keys() { xdotool key --delay 50 "$@"; }
click() {
  xdotool mousemove "$1" "$2"
  sleep 0.1
  xdotool click 1
  sleep 0.1
}
has_ended() { ! kill -0 "$demo" 2>/dev/null; }
# Ends the program by the key Q after what is named.
quit() {
  keys q
  until_true "the end of the program after $1" has_ended
  wait "$demo"
  local status=$?
  [ $status -eq 0 ] || fail "exit status $status after $1"
  [ ! -s "$work/err" ] || fail "output on standard error after $1"
}
has_size() { [ "$(xdotool getwindowgeometry --shell "$window" | grep -E 'WIDTH|HEIGHT' | tr '\n' ' ')" = "$1" ]; }

start
keys d 1 2 3 4 5 6 m m m m m m space n s s space bracketleft bracketright t t v v e e F1 Escape h h c shift+d b
keys Delete r ctrl+z ctrl+y r
click 24 377              # a checkbox of the panel
click 700 400             # the scene
sleep 2                   # now the first body is above the middle of the scene
xdotool mousemove 800 160; sleep 0.3; xdotool mousedown 1; sleep 0.3
for _ in $(seq 10); do xdotool mousemove_relative 15 10; sleep 0.05; done
xdotool mouseup 1
keys Delete              # the pulled body, if the mouse has hit it
xdotool mousemove 700 400 mousedown 1 mousemove_relative 120 40; sleep 0.3; xdotool mouseup 1
xdotool click 4 click 5
for size in "700 500" "1500 950" "320 240" "1280 720"; do
  xdotool windowsize "$window" ${size% *} ${size#* }
  until_true "the size $size" has_size "WIDTH=${size% *} HEIGHT=${size#* } "
  sleep 0.3
done
xdotool windowminimize "$window" windowunmap "$window"
sleep 1
xdotool windowmap "$window"
until_true "the window shows again" has_window
kill -0 "$demo" 2>/dev/null || fail "the program died"
xdotool windowfocus "$window" 2>/dev/null
quit "keys and a mouse"

# A mesh named by keyboard is loaded, the saved scene and the picture exist, and the window keeps its size.
folder=$work/a\ \ folder
mkdir "$folder"
cd "$folder" || exit 1
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' >mesh.obj
preferences=$XDG_CONFIG_HOME/sbcollide/preferences.toml
grep -q '^width = 1280$' "$preferences" || fail "the window's size was not kept"
# Folds all sections of the panel but one, so that its fields stand below the headings above it, 25 pixels each.
mapfile -t sections < <(sed -n 's/^    {"\([^"]*\)", [a-z]*, draw_.*/\1/p' "$sources/app/ui/panel/panel.cpp")
open_only() {
  local i open
  printf 'width = 1280\nheight = 950\n[[section]]\nname = "More"\nopen = true\n' >"$preferences"
  for i in "${!sections[@]}"; do
    open=false
    [ "${sections[i]}" = "$1" ] && open=true && field=$((627 + 25 * i)) && save=$((field + 4 * 29))
    printf '[[section]]\nname = "%s"\nopen = %s\n' "${sections[i]}" $open
  done >>"$preferences"
}
open_only Files
start
# Types into the field of the file to open, faster than slow frames: no key may be lost or be taken for a shortcut.
xdotool mousemove 150 "$field"; sleep 0.3
xdotool click 1 type --delay 20 mesh.obj
xdotool key Return
sleep 3  # a slow machine loads it meanwhile
click 150 "$save"  # the field of the scene to save
keys ctrl+a
xdotool type --delay 300 kept.toml
keys Return
until_true "the saved scene" test -s kept.toml
grep -q 'path = "mesh.obj"' kept.toml || fail "the mesh is not in the saved scene"
click 1100 400  # the scene: keys are shortcuts again
keys p
until_true "the picture" test -s picture_0001.png
xdotool windowsize "$window" 1100 700
until_true "the size" has_size "WIDTH=1100 HEIGHT=700 "
sleep 0.5
quit "a mesh named by keyboard"
grep -q '^width = 1100$' "$preferences" || fail "the window's size was not kept"

# Keyboard layouts, changed while the program runs. Keys are given by keycodes: by name, xdotool would look for a key of
# that name in the new layout.
keys_with() {
  xdotool keydown "$1"
  keys "$2"
  xdotool keyup "$1"
}
# A slow machine needs time for the keys before a change, which it would read by the new layout.
layout() {
  sleep 0.5
  setxkbmap "$1"
}
open_only Files
start
layout fr
keys 47            # m: the next method
keys 58            # a comma: nothing
keys 10            # the digit key 1, which types &: body boxes
keys 34 26         # a dead key and e, which type ê: nothing
layout de
keys_with 108 17   # AltGr+8 is [: fewer boxes, and no surface contacts
keys_with 64 41    # Alt+F: nothing
layout ru
keys 58            # the key of M on a US keyboard: the next method
keys 28            # that of T: the hash table is hidden
keys_with 50 40    # that of D, with Shift: twenty bodies
keys_with 37 52    # that of Z, with Ctrl: undoes them
layout fr
click 150 "$save"  # the field of the scene to save
keys End
keys_with 37 24    # Ctrl+A, the key of Q on a US keyboard: the next text replaces all
layout us
sleep 0.5  # a slow machine needs time for the change
xdotool type --delay 100 keys.toml
keys Return
until_true "the scene of other keyboards" test -s keys.toml
click 1100 400
quit "other keyboards"
kept() { grep -qx "$2" "$1" || fail "$2 was not kept: a key of another keyboard was taken for something else"; }
for line in 'method = "aabb-tree"' 'contact_surface = "vertex-vertex"' 'levels = 2'; do kept keys.toml "$line"; done
for line in 'body-boxes = true' 'touches = false' 'below = "none"' 'hash_table = false'; do
  kept "$preferences" "$line"
done

# A button starts and stops a recording. A script that stands in for ffmpeg writes the pictures to the video's file.
mkdir "$work/bin"
printf '#!/bin/sh\nfor last; do :; done\ncat >"$last"\n' >"$work/bin/ffmpeg"
chmod +x "$work/bin/ffmpeg"
open_only "Export"
PATH=$work/bin:$PATH start
click 270 $((field + 58))
sleep 1
click 270 $((field + 58))
until_true "the video" test -s video_0001.mp4
click 1100 400
quit "a video"

# Recorded frames play. The keys of what needs a solver do nothing but say so.
for frame in 1 2 3; do sed "s/^v 0 0 0/v 0 0 -0.$frame/" mesh.obj >"frame_$frame.obj"; done
start --play frame_1.obj frame_2.obj frame_3.obj
keys d b Delete f 1 2 4 5 6 8 9 m v e space n s r ctrl+z g Escape w
click 700 400
quit "recorded frames"

# The driver is reset: a new context shows the same world, with the bodies added before.
contexts=$work/contexts
has_another_context() { [ "$(wc -l <"$contexts")" = 2 ] && has_window; }
export ASAN_OPTIONS="$ASAN_OPTIONS:verify_asan_link_order=0"
rm -f scene.toml
open_only Files
LOST_CONTEXT_LOG=$contexts LD_PRELOAD=$lost_context start --scene drop --mesh mesh.obj --view 0,1,0,2,0,0
keys d
until_true "another context after a reset of the driver" has_another_context
xdotool windowfocus "$window" 2>/dev/null
sleep 1
click 290 "$save"  # Save
until_true "the scene after a reset of the driver" test -s scene.toml
[ "$(grep -c '^\[\[body\]\]' scene.toml)" -gt "$(grep -c '^\[\[body\]\]' "$sources/assets/scenes/drop.toml")" ] ||
  fail "the dropped body was lost with the context"
grep -q 'path = "mesh.obj"' scene.toml || fail "the mesh of the command line is not in the scene"
awk '$1 == "distance" && $3 > 2.5 {far = 1} END {exit !far}' scene.toml || fail "the camera does not show the mesh"
click 1100 400
keys p
until_true "a picture after a reset of the driver" test -s picture_0002.png
quit "a reset of the driver"

# The driver is reset again at once: the program ends and says why.
LOST_CONTEXT_AGAIN=1 LOST_CONTEXT_LOG=$contexts LD_PRELOAD=$lost_context "$program" >"$work/out" 2>"$work/err"
[ $? -eq 2 ] || fail "the exit status after two resets of the driver"
[ "$(wc -l <"$work/err")" = 1 ] && grep -q "again and again" "$work/err" || fail "one line about two resets"
