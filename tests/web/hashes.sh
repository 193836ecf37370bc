#!/usr/bin/env bash
# The program of the page, run by node: it comes to the states of tests/hashes, bit for bit.
# Usage: hashes.sh SBCOLLIDE.JS
set -euo pipefail
hashes=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../hashes/hashes.txt")
cd "$(dirname "$1")"  # where it finds its data

# compare SCENE CONTACT-SURFACE INTEGRATOR FRAMES HASH
compare() {
  local hash
  hash=$(node sbcollide.js simulate --scene "$1" --contact-surface "$2" --integrator "$3" --frames "$4" --json |
    grep -oP '"state_hash": *"\K[0-9a-f]*') || true
  [ "$hash" = "$5" ] || { echo "hashes: $1 $2 $3: $hash, not $5" >&2; return 1; }
}
export -f compare
tail -n +2 "$hashes" | xargs --max-lines=1 --max-procs="$(nproc)" bash -c 'compare "$@"' _
