#include "frame.glsl"
#include "surface.glsl"
uniform float opacity;
out vec4 fragment;

void main() { fragment = vec4(surface_colour(), opacity); }
