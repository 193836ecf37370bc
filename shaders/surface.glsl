// Matte rubber: diffuse light with a shadow, light from the sky and the floor, a soft highlight and a faint rim.
#include "colour.glsl"
#include "shadow.glsl"

in vec3 world_position;
in vec3 world_normal;
in vec3 bounce;
in float sky_visibility;
flat in vec3 albedo;

float power4(float x) {
  float square = x * x;
  return square * square;
}

// Colour of this pixel (sRGB).
vec3 surface_colour() {
  vec3 normal = normalize(world_normal) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 to_eye = normalize(frame.eye.xyz - world_position);
  vec3 half_vector = normalize(to_eye + frame.to_light.xyz);
  vec3 base = linear_from_srgb(albedo);

  // Lambert's law, but with a smooth approach to 0: the edge of the light on a sphere is soft.
  float cosine = max(dot(normal, frame.to_light.xyz), 0.0);
  float diffuse = 1.1 * cosine * cosine / (cosine + 0.1);
  float lit = light_visibility(world_position, normal);
  vec3 key = vec3(0.86, 0.83, 0.79) * diffuse * lit;
  vec3 sky = vec3(0.40, 0.43, 0.48) * sky_visibility;
  vec3 floor_light = vec3(0.34, 0.33, 0.32) * bounce * (0.35 + 0.65 * sky_visibility);
  vec3 colour = base * (key + mix(floor_light, sky, 0.5 + 0.5 * normal.y));

  float specular = power4(max(dot(normal, half_vector), 0.0));
  specular = power4(specular) * specular * specular * specular;  // to the 28th power
  float rim = power4(1.0 - max(dot(normal, to_eye), 0.0));
  colour += vec3(0.10) * specular * lit * diffuse +
            vec3(0.09, 0.10, 0.11) * rim * sky_visibility * (0.5 + 0.5 * normal.y);
  return dithered(srgb_from_linear(compress_highlights(colour)));
}
