# Shared by tests/run.sh and tests/checks.sh: parts that all run though one fails, and a table of what they took at the
# end. Source it.

. "$(dirname "${BASH_SOURCE[0]}")/../app/setup.sh"

test_packages=("${program_packages[@]}" libgtest-dev xvfb xauth xdotool x11-xkb-utils)
step_table=""
failed_steps=0

# step NAME COMMAND...: runs it and notes how long it took and whether it went well; its status is the command's.
step() {
  local name=$1 begin=$SECONDS status=0
  shift
  say "== $name"
  ("$@") || status=$?
  local verdict=passed
  [ $status -eq 0 ] || verdict=FAILED
  failed_steps=$((failed_steps + (status != 0)))
  step_table+=$(printf '%-18s %5d s  %s' "$name" $((SECONDS - begin)) "$verdict")$'\n'
  return $status
}

# leave_out NAME WHY: notes that a part cannot run here.
leave_out() {
  say "== $1: left out: $2"
  step_table+=$(printf '%-18s %7s  left out: %s' "$1" "" "$2")$'\n'
}

# The table, and the script's exit status.
finish() {
  printf '\n%s%-18s %5d s\n' "$step_table" "all" $SECONDS
  [ $failed_steps -eq 0 ] || exit 1
}

# run_tests PRESET [CTEST OPTION...]: what is built there, with a display of its own for the tests with a window, whether
# there is a screen or not.
run_tests() {
  local preset=$1
  shift
  cd "$root"
  # Without -noreset the server starts over when its last client leaves, and turns away who comes just then. One test
  # more at a time than processors: that of the window, the longest, mostly waits.
  xvfb-run --auto-servernum --server-args="-screen 0 1600x1000x24 -noreset" ctest --preset "$preset" --parallel "$(($(nproc) + 1))" "$@"
}

# build_and_test PRESET: two steps.
build_and_test() {
  step "$1: build" build "$1" all -DBUILD_TESTING=ON && step "$1: tests" run_tests "$1"
}
