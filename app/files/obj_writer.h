#pragma once
// Bodies as OBJ text that `detect` reads back: the same bodies, the same positions to the bit, the same edges.

#include <string>
#include <vector>

#include "softbody/world.h"

namespace app {

/// All of a world's bodies that does not move.
class ObjWriter {
 public:
  explicit ObjWriter(const softbody::World& world);

  /// Whether these are still the bodies of the world.
  bool matches(const softbody::World& world) const;

  /// A file of one frame: each body an object, body_0 and so on. x, y, z: of all vertices, metres.
  std::string frame(std::span<const float> x, std::span<const float> y, std::span<const float> z) const;
  /// The bodies at rest, each round its own origin: for --rest, which compares distances inside one body only.
  std::string at_rest() const;

 private:
  std::vector<const softbody::Prototype*> prototypes_;  // only to be compared: the world may be gone
  std::vector<std::size_t> first_;                      // vertex of each body; one more at the end
  std::vector<std::string> faces_;                      // of each body
  std::vector<float> x_, y_, z_;                        // at rest
};

}  // namespace app
