#version 330 core
#include "frame.glsl"
#include "surface.glsl"
uniform float opacity = 1.0;
out vec4 fragment;

void main() { fragment = vec4(surface_colour(), opacity); }
