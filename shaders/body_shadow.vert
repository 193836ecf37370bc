#include "table.glsl"
#include "body.glsl"
uniform mat4 light_clip_from_world;

// Shadows are drawn at the coarsest level of detail, where each vertex is one of the mesh.
void main() { gl_Position = light_clip_from_world * vec4(fetch(positions, corners.x), 1.0); }
