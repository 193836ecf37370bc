uniform float opacity;
flat in vec4 face_colour;
out vec4 fragment;

void main() { fragment = vec4(face_colour.rgb, face_colour.a * opacity); }
