#!/usr/bin/env bash
# Checks that each folder of the sources includes only itself and the folders that this table allows it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

allowed="
collide/core:
collide/methods: collide/core
collide/exact: collide/core
collide/surface: collide/core
collide/oracle: collide/core collide/surface
collide: collide/core collide/methods collide/exact
softbody: collide collide/core collide/methods collide/surface
engine/render: engine
engine: engine/render
app: app collide softbody engine
"

# An entry without a slash stands for all folders below it where it is no row of its own.
grep -r --include='*.h' --include='*.cpp' '^#include "' collide softbody engine app |
  awk -v allowed="$allowed" '
    function room(path) {
      while (sub(/\/[^\/]*$/, "", path)) if (path in known) return path
      return path
    }
    BEGIN {
      rows = split(allowed, row, "\n")
      for (i = 1; i <= rows; ++i) if (split(row[i], side, ":") == 2) {
        known[side[1]]
        count = split(side[2], target, " ")
        for (k = 1; k <= count; ++k) may[side[1], target[k]]
      }
    }
    {
      file = target_file = $0
      sub(/:.*/, "", file)
      gsub(/^[^"]*"|".*/, "", target_file)
      if (target_file !~ /\//) next
      from = room(file); to = room(target_file)
      top = to; sub(/\/.*/, "", top)
      if (from == to || (from, to) in may || (from == "app" && (from, top) in may)) next
      printf "%s includes %s: %s may not use %s\n", file, target_file, from, to
      wrong = 1
    }
    END { exit wrong }'
