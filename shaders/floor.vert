#version 330 core
// One corner of a grid of cells on the floor, counted row by row by gl_VertexID. Cells side by side compute their
// common corners in the same way, so that no pixel falls between them.
#include "frame.glsl"
uniform vec4 cells;        // least x and z; size of a cell
uniform int corners;  // a row
out vec2 ground;

void main() {
  ground = cells.xy + cells.zw * vec2(gl_VertexID % corners, gl_VertexID / corners);
  gl_Position = frame.clip_from_world * vec4(ground.x, frame.floor_map.w, ground.y, 1.0);
}
