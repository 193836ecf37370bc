#pragma once
// Arbitrary bytes as a scene: values within what a scene file may hold, most of them usual ones, in small worlds.

#include "bytes.h"
#include "softbody/scene/scene.h"

namespace fuzz {

/// Its key is the given one.
softbody::Scene read_scene(Bytes& bytes, const std::string& key);

softbody::Material read_material(Bytes& bytes, const std::string& name);
softbody::BodySource read_body(Bytes& bytes, int materials);
/// Its mesh is made here, not in a scene file, and rides on a coarse one.
softbody::BodySource read_fine_body(Bytes& bytes, int materials);
glm::dvec3 read_vector(Bytes& bytes, double size);

}  // namespace fuzz
