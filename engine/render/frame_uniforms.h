#pragma once
// The uniform block of shaders/frame.glsl, and programs that read it.

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "engine/program.h"

namespace engine::render {

/// Values that all shaders of a frame share. The layout is std140 and equal to that in shaders/frame.glsl.
struct FrameUniforms {
  glm::mat4 clip_from_world, shadow_from_world;
  glm::vec4 eye;            // xyz; w: pixels per unit of width
  glm::vec4 to_light;       // xyz, length 1; w: size of a shadow texel, m
  glm::vec4 viewport;       // origin and size, pixels
  glm::vec4 floor_map;      // centre x, centre z, 1 / extent, height of the floor
  glm::vec4 scene;          // centre x, centre z, radius, distance between grid lines
  glm::vec4 shadow_bounds;  // part of the shadow map that can hold shadows: min x, min y, max x, max y
  glm::vec4 flags;          // x: 1 if there is a floor
};

/// The texture units of the samplers, the same in every program.
enum TextureUnit : int { unit_positions, unit_normals, unit_marks, unit_occluders, unit_floor_map, unit_shadow_map };

/// Bits of the stencil buffer: pixels that show solid bodies; the last set of overlays drawn behind a surface.
enum StencilBits : GLuint { stencil_bodies = 0x80, stencil_overlays = 0x7f };

/// Builds a program, opaque until told otherwise, and assigns its samplers to their texture units. Throws ShaderError.
inline Program scene_program(const std::filesystem::path& shaders, const char* vertex_file, const char* fragment_file) {
  Program program(shaders, vertex_file, fragment_file);
  program.use();
  program.set("positions", unit_positions);
  program.set("normals", unit_normals);
  program.set("marks", unit_marks);
  program.set("occluders", unit_occluders);
  program.set("floor_map", unit_floor_map);
  program.set("shadow_map", unit_shadow_map);
  program.set("opacity", 1.0f);
  return program;
}

}  // namespace engine::render
