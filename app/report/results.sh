#!/usr/bin/env bash
# Measures what the pages say, and writes it into app/report/results as CSV files. Then `test_documents --write` makes
# the tables of the pages from them.
#
#   app/report/results.sh [PART...]      parts are the functions below; all if none is named
#
# SBCOLLIDE is the program (default: build/release/bin/sbcollide); BENCH is the folder of the benchmarks (default:
# build/bench/bin), CCD_DATA that of the public queries of bench_ccd. A part whose binary or data are missing is left
# out. Run it on a quiet machine.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
program=${SBCOLLIDE:-build/release/bin/sbcollide}
bench=${BENCH:-build/bench/bin}
results=app/report/results
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# publish FILE BINARY COMMAND: writes the CSV on standard input to a file, below lines that say where it comes from.
publish() {
  local compiler
  cat >"$work/figures"
  compiler=$(grep -aoE 'clang version [0-9.]+' "$2" || grep -aoE 'GCC: \([^)]*\) [0-9.]+' "$2" || echo unknown)
  {
    echo "# command: $3"
    echo "# processor: $(sed -n '/^model name/{s/^[^:]*: //p;q}' /proc/cpuinfo), $(nproc) threads"
    echo "# compiler: ${compiler%%$'\n'*}"
    echo "# date: $(date +%F), after $SECONDS s"
    cat "$work/figures"
  } >"$work/published"
  mv "$work/published" "$results/$1"
  echo "$results/$1"
}

# table PAGE HEADING [NUMBER]: prints a table of a Markdown page as CSV: the first below that heading, or another one.
table() {
  awk -v heading="$2" -v wanted="${3:-1}" '
    /^#+ / { inside = index($0, heading) > 0; tables = 0 }
    !/^\|/ { rows = 0; next }
    inside && ++rows == 1 { ++tables }
    inside && tables == wanted && rows != 2 {
      gsub(/"/, "\"\"")
      count = split(substr($0, 2, length($0) - 2), cells, "|")
      for (i = 1; i <= count; ++i) {
        gsub(/^ +| +$/, "", cells[i])
        printf "%s%s", cells[i] ~ /[",]/ ? "\"" cells[i] "\"" : cells[i], i < count ? "," : "\n"
      }
    }' "$1" >"$work/table"
  [ -s "$work/table" ] || { echo "$1 has no such table: $2" >&2; return 1; }
  cat "$work/table"
}

# report NAME [OPTION...]: makes a report; its files are then in $work/NAME.
report() {
  command="sbcollide report $* --out DIR"
  "$program" report "$@" --out "$work/$1" >/dev/null
}

# picture PLOT FILE: puts a plot of a report among the pictures of the pages, if gnuplot has drawn it.
picture() {
  if [ -f "$work/$1" ]; then cp "$work/$1" "assets/screenshots/$2"; else echo "$2: left as it is, without gnuplot"; fi
}

# Of detection.csv only the paper's level on its scenes and on the cloth, and the studies; of stability.csv the integrators
# that are stable at any step: the pages need no more.
detection() {
  report detection
  awk -F, 'NR == 1 || $1 != "sweep" || ($2 ~ /^([A-D]|cloth)$/ && $8 ~ /^3?$/)' "$work/detection/detection.csv" |
    publish detection.csv "$program" "$command"
  table "$work/detection/report.md" "Table 1" | publish detection-table-1.csv "$program" "$command"
  local study
  for study in Growth Density Sizes Order; do
    table "$work/detection/report.md" "$study" | publish "detection-${study,,}.csv" "$program" "$command"
  done
  publish misses.csv "$program" "$command" <"$work/detection/misses.csv"
  table "$work/detection/report.md" "What misses cost" | publish misses-left.csv "$program" "$command"
  picture detection/error-time-D.png error-time-D.png
  picture detection/misses-D.png misses-D.png
  picture detection/cost-bodies.png cost-bodies.png
}
contact() {
  report contact --threads "${THREADS:-1}"
  publish contact.csv "$program" "$command" <"$work/contact/contact.csv"
  table "$work/contact/contact.md" "All scenes" 2 | publish contact-scenes.csv "$program" "$command"
}
solver() {
  report solver
  publish solver.csv "$program" "$command" <"$work/solver/solver.csv"
  table "$work/solver/solver.md" "All scenes" | publish solver-costs.csv "$program" "$command"
  table "$work/solver/solver.md" "promises" | publish solver-promise.csv "$program" "$command"
  table "$work/solver/solver.md" "Stiffness against resolution" | publish solver-stiffness.csv "$program" "$command"
  table "$work/solver/solver.md" "Coarse against fine" | publish solver-coarse.csv "$program" "$command"
  picture solver/solver-free-1e3.png error-time-free-flight.png
}
stability() {
  report stability --threads "${THREADS:-1}"
  awk -F, 'NR == 1 || $3 == "auto" || $3 == "implicit"' "$work/stability/stability.csv" |
    publish stability.csv "$program" "$command"
  table "$work/stability/stability.md" "Cells that pass" | publish stability-cells.csv "$program" "$command"
}

theory() {
  report theory --threads "${THREADS:-1}"
  publish theory.csv "$program" "$command" <"$work/theory/theory.csv"
  table "$work/theory/theory.md" "All cases" | publish theory-cases.csv "$program" "$command"
}

# has_bench NAME: whether a benchmark was built.
has_bench() {
  [ -x "$bench/$1" ] || { echo "$1: left out, $bench has none (cmake --preset bench)"; return 1; }
}
bench_detection() {
  has_bench bench_detection || return 0
  "$bench/bench_detection" record "$work/piles" >/dev/null
  "$bench/bench_detection" run "$work/piles" --csv |
    publish bench-detection.csv "$bench/bench_detection" "bench_detection run piles --csv"
}
bench_step() {
  has_bench bench_step || return 0
  "$bench/bench_step" --repeat 2 --csv | publish bench-step.csv "$bench/bench_step" "bench_step --repeat 2 --csv"
}
bench_stages() {
  has_bench bench_stages || return 0
  "$bench/bench_stages" 9 2 | sed 's/^Heap/# Heap/' >"$work/stages.md"
  table "$work/stages.md" "Heap" | publish bench-stages.csv "$bench/bench_stages" "bench_stages 9 2"
}
bench_ccd() {
  has_bench bench_ccd || return 0
  [ -d "${CCD_DATA:-}" ] || { echo "bench_ccd: left out, CCD_DATA is no folder of public queries"; return 0; }
  { echo "# Queries"; "$bench/bench_ccd" "$CCD_DATA"/*.csv; } >"$work/ccd.md"
  table "$work/ccd.md" "Queries" | publish bench-ccd.csv "$bench/bench_ccd" "bench_ccd FILE..."
}

all=(detection contact solver stability theory bench_detection bench_step bench_stages bench_ccd)
for part in "${@:-"${all[@]}"}"; do
  case " ${all[*]} " in
    *" $part "*) SECONDS=0; $part ;;
    *) echo "results.sh: $part: unknown; use some of: ${all[*]}" >&2; exit 2 ;;
  esac
done
