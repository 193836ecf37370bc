#!/usr/bin/env bash
# Checks that each folder of the sources includes only itself and the folders that the first table allows it, and that
# app includes only the public headers of softbody, which the second table lists.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The public headers include no other header of the project.
allowed="
collide/api/sbcollide:
collide/core: collide/api/sbcollide
collide/trees: collide/core
collide/methods: collide/core collide/trees
collide/exact: collide/core collide/trees
collide/surface: collide/core collide/trees
collide/oracle: collide/core collide/surface
collide: collide/core collide/methods collide/exact
collide/api: collide/api/sbcollide collide
softbody/mesh: collide/core collide/surface collide/oracle
softbody/model: collide/surface softbody/mesh
softbody/state: softbody/mesh softbody/model
softbody/contact: collide/core collide/surface softbody/mesh softbody/state softbody/model
softbody/forces: collide/core softbody/mesh softbody/state softbody/model softbody/contact
softbody/mechanics: softbody/state softbody/model softbody/contact softbody/forces
softbody/scene: collide softbody/mesh softbody/model softbody/contact softbody/mechanics
softbody/integrate/implicit: softbody/state softbody/model softbody/contact softbody/forces softbody/mechanics
softbody/integrate: collide/core softbody/state softbody/contact softbody/forces softbody/mechanics softbody/scene softbody/integrate/implicit
softbody/integrate/methods: softbody/integrate
softbody/world: collide softbody/mesh softbody/state softbody/model softbody/contact softbody/forces softbody/mechanics softbody/scene softbody/integrate
softbody/api/sbcollide:
softbody/api: collide/api softbody/api/sbcollide softbody/mesh softbody/model softbody/mechanics softbody/scene softbody/world
engine:
engine/render: engine
app/base: softbody
app/guest: app/base collide
app/files: app/base collide softbody engine
app/compare: app/base collide softbody
app/reference: softbody
app/session/stability: app/base app/compare softbody
app/session/live: app/base app/compare app/guest app/session/stability collide softbody
app/session: app/base app/files app/compare app/guest app/session/stability app/session/live collide softbody engine
app/render: app/base app/files app/compare collide softbody engine
app/report: app/base app/files app/compare app/reference collide softbody engine
app/cli: app/base app/files app/compare app/report app/render collide softbody
app/ui/tour: app/base app/compare app/session app/render collide softbody
app/ui/state: app/session app/render app/ui/tour
app/ui/widgets: app/base app/compare app/render app/ui/state
app/ui/views: app/base app/compare app/session app/render app/ui/state app/ui/widgets softbody engine
app/ui/panel: app/base app/session app/render app/ui/state app/ui/widgets app/ui/views collide softbody
app/ui: app/session app/ui/state app/ui/widgets app/ui/views app/ui/panel
app/window: app/base app/files app/compare app/guest app/session app/render app/ui softbody engine
app/web: app/base app/render app/session engine
app: app/base app/files app/guest app/cli app/report app/window
"

# They include only each other of softbody, so that no change of the solver reaches app.
public="
mesh/coarse_mesh mesh/embedding mesh/file_mesh mesh/mesh mesh/mesh_import
mesh/points mesh/polygon mesh/read_number mesh/shortest_text mesh/surface
state/best_rotation state/body state/energy_ledger state/lanes
model/key model/material model/body_model model/scene_error
contact/contacts contact/keys contact/solid contact/solid_surface
forces/air_drag forces/coordinates forces/gas forces/grab forces/shape_matching forces/springs
mechanics/body_measures mechanics/bound mechanics/material_keys
scene/scene scene/scene_keys scene/toml_table scene/toml_text
integrate/integrators integrate/work integrate/plan
world/bodies_in_motion world/energy_watch world/measures world/body_model_set world/snapshot world/world
"

# A folder without a row belongs to the row of the folder above it. In rows of app, an entry allows the folders below it,
# too. The rooms of softbody stand in order: each may use only what stands above it.
grep -r --include='*.h' --include='*.cpp' '^#include "' collide softbody engine app |
  awk -v allowed="$allowed" -v public="$public" '
    function room(path) {
      while (sub(/\/[^\/]*$/, "", path)) if (path in known) return path
      return path
    }
    function below(from, path) {
      while (sub(/\/[^\/]*$/, "", path)) if ((from, path) in may) return 1
      return 0
    }
    BEGIN {
      rows = split(allowed, row, "\n")
      for (i = 1; i <= rows; ++i) if (split(row[i], side, ":") == 2) {
        known[side[1]]
        count = split(side[2], target, " ")
        for (k = 1; k <= count; ++k) may[side[1], target[k]]
      }
      count = split(public, name, " ")
      for (k = 1; k <= count; ++k) shown["softbody/" name[k] ".h"]
    }
    {
      file = target_file = $0
      sub(/:.*/, "", file)
      gsub(/^[^"]*"|".*/, "", target_file)
      if (target_file !~ /\//) next
      from = room(file); to = room(target_file)
      if (to ~ /^softbody/ && !(target_file in shown) && (from ~ /^app/ || file in shown)) {
        printf "%s includes %s, which is not a public header of softbody\n", file, target_file
        wrong = 1
      }
      if (from == to || (from, to) in may || (from ~ /^app/ && below(from, to))) next
      printf "%s includes %s: %s may not use %s\n", file, target_file, from, to
      wrong = 1
    }
    END { exit wrong }'
