#pragma once
// Makes an even triangle mesh of a shape that is given as a signed distance.

#include "softbody/mesh/mesh.h"
#include "tests/shapes/distance.h"

namespace shapes {

/// Returns a closed mesh of about `vertices` vertices (to within some per cent), all on the surface. Only its vertices
/// and triangles are set. The shape lies within 2 m of the origin along each axis, is smooth, and is nowhere thinner
/// than a few edges of the mesh: elsewhere edges may have more than two faces.
softbody::Mesh make_mesh(const Distance& shape, int vertices);

}  // namespace shapes
